#pragma once

#include <engine/graph/execute.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <engine/render/compute_buffers.hpp>
#include <nearfield/resident.hpp>

/// Images and buffers of the host that take the place of the library's own.
namespace nearfield::render {

/// An image for the render graph: the host's, or else the library's own.
[[nodiscard]] graph::ImportedImage imported_image(const ResidentImageTarget& target, VkImage own);

/// Where records or samples lie: in the host's buffer, or else in `own`.
[[nodiscard]] BufferPart range_of_target(const ResidentBufferTarget& target, const BufferPart& own);
/// The same for the render graph. The pass that writes the headers reads the host's buffer, too.
[[nodiscard]] graph::ImportedBuffer imported_buffer(const ResidentBufferTarget& target,
                                                    const BufferPart& range);

/// The stages in which the host uses its buffers after the batch.
[[nodiscard]] VkPipelineStageFlags readers_of_targets(const plan::ResidentOutputs& resident);

}  // namespace nearfield::render
