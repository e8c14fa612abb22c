#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <nearfield/device_poses.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/pair_poses.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace nearfield::render {

/// Where the search for all pairs of a world takes the poses of its instances from, if the host's
/// commands write them, and what it has taken.
class PoseSource {
public:
    PoseSource(const gpu::Device& device, const passes::ComputeLayout& layout);

    /// Where the searches that follow take poses from: so many elements. `farthest`: coordinates
    /// beyond it are too coarse for the tolerance.
    void set(const passes::PairPoses& passes, const DevicePoses& poses, std::uint32_t elements,
             double farthest);
    void clear() { passes_ = nullptr; }
    [[nodiscard]] bool is_set() const { return passes_ != nullptr; }
    /// Differs if commands recorded before take other poses. 0: none.
    [[nodiscard]] std::uint32_t revision() const { return is_set() ? revision_ : 0; }

    /// A buffer of the search.
    struct Part {
        VkBuffer buffer = VK_NULL_HANDLE;
        std::uint64_t bytes = 0;
    };
    /// Says for which search the passes are recorded. The device must not be working at what was
    /// recorded before.
    void bind(const Part& shapes, VkBufferView texels, const Part& instances,
              std::uint32_t instance_count);
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
        passes_->record(commands, timestamps, item_);
    }
    /// Call once the device is done.
    void finish() const { taken_.invalidate(); }

    /// The first instance whose pose cannot be used.
    [[nodiscard]] std::optional<std::uint32_t> unusable() const;
    /// x, y, cosine and sine, as the host has written them.
    [[nodiscard]] std::array<double, 4> pose(std::uint32_t instance) const;

private:
    const passes::ComputeLayout* layout_;
    gpu::MappedBuffer taken_;
    passes::DescriptorSets sets_;
    const passes::PairPoses* passes_ = nullptr;
    DevicePoses poses_;
    std::uint64_t bytes_ = 0;  // of the host's buffer
    passes::PairPoses::Item item_;
    std::uint32_t revision_ = 0;
};

}  // namespace nearfield::render
