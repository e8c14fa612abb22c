#include <engine/plan/check_target.hpp>
#include <engine/render/pose_source.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> names_of_pose_sets{"nearfield pair set of poses"};
constexpr std::uint64_t bytes_of_pose = sizeof(std::array<float, 4>);

/// A float that is not above the value.
float rounded_down(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded > value ? std::nextafter(rounded, 0.0F) : rounded;
}

}  // namespace

PoseSource::PoseSource(const gpu::Device& device, const passes::ComputeLayout& layout)
    : layout_(&layout),
      taken_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             gpu::Direction::readback, "nearfield pair poses"),
      sets_(device, layout, names_of_pose_sets) {
    item_.set = sets_[0];
}

void PoseSource::set(const passes::PairPoses& passes, const DevicePoses& poses,
                     std::uint32_t elements, double farthest) {
    const std::uint64_t bytes = plan::bytes_of_poses(poses, elements);
    if (passes_ == &passes && poses == poses_ && bytes == bytes_) {
        return;
    }
    ++revision_;
    passes_ = &passes;
    poses_ = poses;
    bytes_ = bytes;
    const double origin = std::max(std::abs(poses.origin.x), std::abs(poses.origin.y));
    item_.poses = {poses.buffer, poses.offset, bytes_,
                   graph::ExternalUses{{poses.before.stages, poses.before.access}, {}}};
    item_.push.stride = poses.stride / sizeof(float);
    item_.push.largest = rounded_down(largest_coordinate - origin);
    item_.push.origin = std::nextafter(static_cast<float>(origin), INFINITY);
    item_.push.farthest = rounded_down(farthest);
}

void PoseSource::bind(const Part& shapes, VkBufferView texels, const Part& instances,
                      std::uint32_t instance_count) {
    using Layout = passes::ComputeLayout;
    taken_.reserve(bytes_of_pose * (1 + std::uint64_t{instance_count}));
    layout_->begin_updates();
    layout_->write_buffer(item_.set, Layout::tiles, shapes.buffer, 0, shapes.bytes);
    layout_->write_texels(item_.set, Layout::texels, texels);
    layout_->write_host_buffer(item_.set, Layout::geometry, poses_.buffer, poses_.offset, bytes_);
    layout_->write_buffer(item_.set, Layout::points, instances.buffer, 0, instances.bytes);
    layout_->write_buffer(item_.set, Layout::output, taken_.handle(), 0,
                          bytes_of_pose * (1 + std::uint64_t{instance_count}));
    layout_->end_updates();
    item_.shapes = shapes.buffer;
    item_.instances = instances.buffer;
    item_.taken = taken_.handle();
    item_.push.instances = instance_count;
}

std::optional<std::uint32_t> PoseSource::unusable() const {
    std::uint32_t first = plan::no_instance;
    std::memcpy(&first, taken_.data(), sizeof(first));
    return first == plan::no_instance ? std::nullopt : std::optional(first);
}

std::array<double, 4> PoseSource::pose(std::uint32_t instance) const {
    std::array<float, 4> pose{};
    std::memcpy(pose.data(), taken_.data() + bytes_of_pose * (1 + std::uint64_t{instance}),
                bytes_of_pose);
    return {pose[0], pose[1], pose[2], pose[3]};
}

}  // namespace nearfield::render
