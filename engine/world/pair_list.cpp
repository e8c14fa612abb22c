#include <engine/geometry/hierarchy.hpp>
#include <engine/world/pair_list.hpp>

#include <algorithm>

namespace nearfield::world {

void PairList::clear() {
    last_change_ = 0;
    pairs_.clear();
    new_pairs_.clear();
}

template <class Boxes>
void PairList::find_pairs_of(std::uint32_t index, const Instances& instances, const Boxes& boxes,
                             double reach, bool both_ways) {
    // Slightly more than the margin of any pair, for the rounding of what is compared below.
    const geometry::Box search =
        geometry::grown(boxes.bounds(index).box, reach * (1.0 + 1e-9) + 3.0 * boxes.max_rounding());
    boxes.boxes().for_meeting(search, [&](std::uint32_t other) {
        const bool is_found_twice =
            has_changed_[other] != 0 && instances.number(other) < instances.number(index);
        if (other == index || is_found_twice || !instances.is_pair(index, other)) {
            return;
        }
        const bool is_first = instances.number(index) < instances.number(other);
        const std::uint32_t first = is_first ? index : other;
        const std::uint32_t second = is_first ? other : index;
        if (!geometry::may_meet(boxes.bounds(first), boxes.bounds(second), reach)) {
            return;
        }
        found_.push_back({first, second, none});
        if (both_ways) {
            found_.push_back({second, first, none});
        }
    });
}

void PairList::update(const Instances& instances, double reach, bool both_ways) {
    has_changed_.resize(instances.size());
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        has_changed_[i] = instances.changed(i) > last_change_ ? 1 : 0;
    }
    last_change_ = instances.last_change();
    find_overlapping_boxes(instances, instances, reach, both_ways);
}

void PairList::update(const Instances& instances, const Motions& motions, double reach) {
    has_changed_.resize(instances.size());
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        has_changed_[i] = motions.has_changed(i) ? 1 : 0;
    }
    find_overlapping_boxes(instances, motions, reach, false);
}

template <class Boxes>
void PairList::find_overlapping_boxes(const Instances& instances, const Boxes& boxes, double reach,
                                      bool both_ways) {
    found_.clear();
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        if (has_changed_[i] != 0 && instances.is_placed(i)) {
            find_pairs_of(i, instances, boxes, reach, both_ways);
        }
    }
    const auto comes_before = [&](const Pair& one, const Pair& other) {
        return one.a != other.a ? instances.number(one.a) < instances.number(other.a)
                                : instances.number(one.b) < instances.number(other.b);
    };
    std::sort(found_.begin(), found_.end(), comes_before);
    pairs_before_.swap(pairs_);
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < pairs_before_.size(); ++i) {
        const Pair& pair = pairs_before_[i];
        if (has_changed_[pair.a] == 0 && has_changed_[pair.b] == 0) {
            pairs_before_[kept++] = {pair.a, pair.b, i};
        }
    }
    pairs_before_.resize(kept);
    // Few are new, so most pairs are copied in long runs.
    pairs_.clear();
    new_pairs_.clear();
    auto next = pairs_before_.cbegin();
    for (const Pair& pair : found_) {
        const auto end = std::lower_bound(next, pairs_before_.cend(), pair, comes_before);
        pairs_.insert(pairs_.end(), next, end);
        new_pairs_.push_back(static_cast<std::uint32_t>(pairs_.size()));
        pairs_.push_back(pair);
        next = end;
    }
    pairs_.insert(pairs_.end(), next, pairs_before_.cend());
}

}  // namespace nearfield::world
