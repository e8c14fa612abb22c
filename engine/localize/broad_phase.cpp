#include <engine/localize/broad_phase.hpp>

#include <algorithm>
#include <numeric>

namespace nearfield::localize {
namespace {

using geometry::Box;

/// The axis along which the centres of the boxes are spread wider.
int widest_axis(std::span<const Box> boxes) {
    geometry::Vector sum = geometry::Vector::Zero();
    geometry::Vector squares = geometry::Vector::Zero();
    const geometry::Vector origin = boxes.empty() ? sum : boxes.front().center();
    for (const Box& box : boxes) {
        const geometry::Vector centre = box.center() - origin;
        sum += centre;
        squares += centre.cwiseProduct(centre);
    }
    const auto count = static_cast<double>(boxes.size());
    const geometry::Vector spread = squares - sum.cwiseProduct(sum) / std::max(count, 1.0);
    return spread.x() >= spread.y() ? 0 : 1;
}

}  // namespace

void BroadPhase::find(std::span<const Box> boxes, double reach, std::vector<Pair>& pairs) {
    pairs.clear();
    const int axis = widest_axis(boxes);
    order_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        order_.emplace_back(boxes[i].min()[axis], i);
    }
    std::sort(order_.begin(), order_.end());
    // Stored in sweep order and grown by the reach once.
    sorted_.clear();
    for (const auto& [low, index] : order_) {
        const Box& box = boxes[index];
        sorted_.push_back({low - reach, box.min()[1 - axis] - reach, box.max()[1 - axis] + reach});
    }
    found_.clear();
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const std::uint32_t first = order_[i].second;
        const double end = boxes[first].max()[axis];
        const double low = boxes[first].min()[1 - axis];
        const double high = boxes[first].max()[1 - axis];
        for (std::size_t j = i + 1; j < sorted_.size() && sorted_[j].begin <= end; ++j) {
            if (sorted_[j].low <= high && low <= sorted_[j].high) {
                found_.push_back(std::minmax(first, order_[j].second));
            }
        }
    }
    sort_found(boxes.size(), pairs);
}

void BroadPhase::sort_found(std::size_t boxes, std::vector<Pair>& pairs) {
    // Counting sort by the first box, then a sort of each bucket: few pairs share a first box.
    ends_.assign(boxes + 1, 0);
    for (const Pair& pair : found_) {
        ++ends_[pair.first + 1];
    }
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    pairs.resize(found_.size());
    for (const Pair& pair : found_) {
        pairs[ends_[pair.first]++] = pair;
    }
    std::size_t first = 0;
    for (std::size_t box = 0; box < boxes; ++box) {
        const auto begin = pairs.begin() + static_cast<std::ptrdiff_t>(first);
        first = ends_[box];
        std::sort(begin, pairs.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

}  // namespace nearfield::localize
