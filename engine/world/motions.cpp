#include <engine/toi/swept_box.hpp>
#include <engine/world/motions.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::world {
namespace {

/// In place of the number of an instance that stands still.
constexpr std::uint32_t still = UINT32_MAX;

}  // namespace

void Motions::clear() {
    entries_.clear();
    boxes_ = {};
    last_change_ = 0;
    max_rounding_ = 0.0;
}

void Motions::place(std::uint32_t index, const Instances& instances) {
    Entry& entry = entries_[index];
    if (!instances.is_placed(index)) {
        boxes_.remove(index);
        return;
    }
    const Pose& start = instances[index].pose;
    geometry::Box& box = entry.bounds.box;
    box = entry.end == start ? geometry::grown(instances.box(index), instances.rounding(index))
                             : toi::swept_box({instances.polygon(index), start, entry.end});
    const double largest =
        std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
    max_rounding_ = std::max(max_rounding_, 8.0 * std::numeric_limits<double>::epsilon() * largest);
    boxes_.set(index, box);
}

void Motions::update(const Instances& instances, std::span<const InstanceHandle> moving,
                     std::span<const Pose> ends) {
    numbers_.assign(instances.size(), still);
    for (std::size_t i = 0; i < moving.size(); ++i) {
        numbers_[moving[i].index] = static_cast<std::uint32_t>(i);
    }
    entries_.resize(instances.size());
    for (std::uint32_t index = 0; index < instances.size(); ++index) {
        Entry& entry = entries_[index];
        const Pose& end = numbers_[index] == still ? instances[index].pose : ends[numbers_[index]];
        entry.has_changed = instances.changed(index) > last_change_ || !(entry.end == end);
        if (entry.has_changed) {
            entry.end = end;
            place(index, instances);
        }
    }
    last_change_ = instances.last_change();
    boxes_.prepare();
}

}  // namespace nearfield::world
