#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/graph/execute.hpp>
#include <nearfield/on_device.hpp>

#include <optional>

/// Images and buffers of the host that take the place of the library's own.
namespace nearfield::render {

/// An image for the render graph: the host's, or else the library's own. `view`: of either;
/// `identity`: of the library's.
[[nodiscard]] graph::ImportedImage imported_image(const ImageTarget& target, VkImage own,
                                                  VkImageView view, std::uint64_t identity);

/// Where records or samples lie: in the host's buffer, or else in `own`.
[[nodiscard]] gpu::BufferPart range_of_target(const BufferTarget& target,
                                              const gpu::BufferPart& own);
/// The host's uses of its buffer.
[[nodiscard]] std::optional<graph::ExternalUses> uses_of(const BufferTarget& target);

}  // namespace nearfield::render
