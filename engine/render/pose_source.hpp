#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/search_memory.hpp>
#include <nearfield/device_poses.hpp>
#include <passes/pair_poses.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace nearfield::render {

/// Where the search for all pairs of a world takes the poses of its instances from, if the host's
/// commands write them, and what it has taken.
class PoseSource {
public:
    PoseSource(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Where the searches that follow take poses from: so many elements. `farthest`: coordinates
    /// beyond it are too coarse for the tolerance.
    void set(const passes::PairPoses& passes, const DevicePoses& poses, std::uint32_t elements,
             double farthest);
    void clear() { passes_ = nullptr; }
    [[nodiscard]] bool is_set() const { return passes_ != nullptr; }
    /// Differs if commands recorded before take other poses. 0: none.
    [[nodiscard]] std::uint32_t revision() const { return is_set() ? revision_ : 0; }

    /// Says for which search the passes are recorded. The device must not be working at what was
    /// recorded before.
    void bind(const SearchInput& input);
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
        passes_->graph.execute(commands, timestamps, *resources_, push_);
    }
    [[nodiscard]] std::size_t count_passes() const {
        return is_set() ? passes_->graph.passes().size() : 0;
    }
    /// Call once the device is done.
    void finish() const { taken_.invalidate(); }

    /// The first instance whose pose cannot be used.
    [[nodiscard]] std::optional<std::uint32_t> unusable() const;
    /// x, y, cosine and sine, as the host has written them.
    [[nodiscard]] std::array<double, 4> pose(std::uint32_t instance) const;

private:
    const graph::ComputeLayout* layout_;
    gpu::MappedBuffer taken_;
    graph::DescriptorUpdates updates_;
    const passes::PairPoses* passes_ = nullptr;
    std::optional<graph::BoundResources> resources_;  // of the passes set last
    const passes::PairPoses* passes_of_resources_ = nullptr;
    DevicePoses poses_;
    std::uint64_t bytes_ = 0;  // of the host's buffer
    shaders::PosePush push_{};
    std::uint32_t revision_ = 0;
};

}  // namespace nearfield::render
