// Where a table of pairs that the device finds has poses that the host's commands write.

#include <engine/context/device_pair_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/check_target.hpp>
#include <engine/plan/pair_search.hpp>
#include <nearfield/portable_math.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace nearfield {

/// All instances are written anew where poses come from elsewhere than before.
void DevicePairTableBase::State::set_poses(const DevicePoses* poses) {
    const bool is_same_source =
        poses == nullptr ? !poses_.has_value() : poses_ && poses->origin == poses_->origin;
    if (!is_same_source) {
        instances_.forget_places();
    }
    poses_ = poses == nullptr ? std::nullopt : std::optional(*poses);
}

void DevicePairTableBase::State::find_poses(const char* call) {
    if (!poses_) {
        buffers_->poses().clear();
        return;
    }
    const VkPhysicalDeviceLimits& limits = context_->device()->limits();
    const Status status =
        plan::check_poses(*poses_, instances_.end_index(), limits.minStorageBufferOffsetAlignment,
                          limits.maxStorageBufferRange);
    if (!status.ok()) {
        refuse(call, status.message());
    }
    if (instances_.size() > 1) {
        const double farthest = question_.resolved > 0.0
                                    ? question_.resolved / plan::smallest_tolerance(1.0)
                                    : std::numeric_limits<float>::max();
        buffers_->poses().set(context_->renderer()->pair_poses(), *poses_, instances_.end_index(),
                              farthest);
    }
}

void DevicePairTableBase::State::require_usable_poses() {
    if (!poses_) {
        return;
    }
    if (const auto number = buffers_->poses().unusable()) {
        const auto [x, y, cosine, sine] = buffers_->poses().pose(*number);
        refuse("poses", "that of the instance with index " +
                            std::to_string(instances_.index(*number)) + " is (" +
                            geometry::number(x) + ", " + geometry::number(y) + ") with cosine " +
                            geometry::number(cosine) + " and sine " + geometry::number(sine) +
                            "; positions must be finite and, with their origin, at most " +
                            geometry::number(largest_coordinate) +
                            " in magnitude, and the square of the length of (cosine, sine) must "
                            "differ from 1 by at most 1/64");
    }
    if (!are_poses_taken_) {
        are_poses_taken_ = true;
        instances_.order_soon();  // until now they were ordered by the poses of the world
    }
}

void DevicePairTableBase::State::take_pose(std::uint32_t number) {
    const auto [x, y, cosine, sine] = buffers_->poses().pose(number);
    const double length = std::hypot(cosine, sine);
    instances_.take_pose(number,
                         {.translation = {poses_->origin.x + x, poses_->origin.y + y},
                          .angle = arc_tangent(sine, cosine)},
                         {sine / length, cosine / length});
}

double DevicePairTableBase::State::rounding_of(const PairInstance& entry) const {
    const geometry::Polygon& polygon = *polygon_of(entry.instance.shape);
    const double magnitude = instances_.origin().lpNorm<1>() + entry.place.lpNorm<1>() +
                             polygon.radius() + polygon.centre().lpNorm<1>();
    return plan::rounding_of_host_pose(polygon, magnitude);
}

void DevicePairTableBase::State::take_poses(const plan::PairRowData& pair) {
    if (poses_) {
        take_pose(pair.a);
        take_pose(pair.b);
    }
}

plan::PairRowData DevicePairTableBase::State::pair_of(std::uint32_t device_row) {
    const plan::PairRowData data = buffers_->row(device_row);
    take_poses(data);
    return data;
}

}  // namespace nearfield
