#include <engine/localize/broad_phase.hpp>
#include <engine/localize/hierarchy.hpp>

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
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return boxes[i].min()[axis] < boxes[j].min()[axis];
    });
    // Next to each other, as they are swept over.
    sorted_.clear();
    for (const std::uint32_t index : order_) {
        sorted_.push_back(boxes[index]);
    }
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const Box& box = sorted_[i];
        const double end = box.max()[axis] + reach;
        for (std::size_t j = i + 1; j < sorted_.size() && sorted_[j].min()[axis] <= end; ++j) {
            if (boxes_meet(sorted_[j], box, reach)) {
                pairs.emplace_back(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
}

}  // namespace nearfield::localize
