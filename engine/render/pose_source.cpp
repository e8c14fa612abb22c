#include <engine/base/unique_numbers.hpp>
#include <engine/device_input/check_target.hpp>
#include <engine/render/pose_source.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nearfield::render {
namespace {

constexpr std::uint64_t bytes_of_pose = sizeof(std::array<float, 4>);

/// A float that is not above the value.
float rounded_down(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded > value ? std::nextafter(rounded, 0.0F) : rounded;
}

}  // namespace

PoseSource::PoseSource(const gpu::Device& device, const graph::ComputeLayout& layout)
    : layout_(&layout),
      taken_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             gpu::Direction::readback, "nearfield pair poses"),
      updates_(device) {}

void PoseSource::set(const passes::PairPoses& passes, const DevicePoses& poses,
                     std::uint32_t elements, double farthest) {
    const std::uint64_t bytes = device_input::bytes_of_poses(poses, elements);
    if (passes_ == &passes && poses == poses_ && bytes == bytes_) {
        return;
    }
    ++revision_;
    passes_ = &passes;
    poses_ = poses;
    bytes_ = bytes;
    const double origin = std::max(std::abs(poses.origin.x), std::abs(poses.origin.y));
    push_.stride = poses.stride / sizeof(float);
    push_.largest = rounded_down(largest_coordinate - origin);
    push_.origin = std::nextafter(static_cast<float>(origin), INFINITY);
    push_.farthest = rounded_down(farthest);
}

void PoseSource::bind(const SearchInput& input) {
    const std::uint64_t bytes = bytes_of_pose * (1 + std::uint64_t{input.instance_count});
    taken_.reserve(bytes);
    if (passes_of_resources_ != passes_) {
        resources_.emplace(passes_->graph.make_resources(*layout_));
        passes_of_resources_ = passes_;
    }
    // Another buffer of the host's may have the handle of one that is gone.
    resources_->set(passes_->poses,
                    {poses_.buffer, poses_.offset, bytes_, VK_NULL_HANDLE, next_revision()},
                    graph::ExternalUses{{poses_.before.stages, poses_.before.access}, {}});
    resources_->set(passes_->shapes, input.shapes);
    resources_->set(passes_->instances, input.instances);
    resources_->set(passes_->taken, taken_.part(0, bytes));
    updates_.begin();
    updates_.add(*resources_);
    updates_.end();
    push_.instances = input.instance_count;
}

std::optional<std::uint32_t> PoseSource::unusable() const {
    std::uint32_t first = shaders::no_instance;
    std::memcpy(&first, taken_.data(), sizeof(first));
    return first == shaders::no_instance ? std::nullopt : std::optional(first);
}

std::array<double, 4> PoseSource::pose(std::uint32_t instance) const {
    std::array<float, 4> pose{};
    std::memcpy(pose.data(), taken_.data() + bytes_of_pose * (1 + std::uint64_t{instance}),
                bytes_of_pose);
    return {pose[0], pose[1], pose[2], pose[3]};
}

}  // namespace nearfield::render
