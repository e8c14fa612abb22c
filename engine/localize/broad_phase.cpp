#include <engine/localize/broad_phase.hpp>

#include <algorithm>
#include <numeric>

namespace nearfield::localize {
namespace {

using geometry::Box;

/// The axis along which the centres of the boxes are spread wider.
int widest_axis(std::span<const Bounds> shapes) {
    geometry::Vector sum = geometry::Vector::Zero();
    geometry::Vector squares = geometry::Vector::Zero();
    const geometry::Vector origin = shapes.empty() ? sum : shapes.front().box.center();
    for (const Bounds& shape : shapes) {
        const geometry::Vector centre = shape.box.center() - origin;
        sum += centre;
        squares += centre.cwiseProduct(centre);
    }
    const auto count = static_cast<double>(shapes.size());
    const geometry::Vector spread = squares - sum.cwiseProduct(sum) / std::max(count, 1.0);
    return spread.x() >= spread.y() ? 0 : 1;
}

}  // namespace

void BroadPhase::find(std::span<const Bounds> shapes, double reach, std::vector<Pair>& pairs) {
    pairs.clear();
    const int axis = widest_axis(shapes);
    // Half the reach on either side of every box, and more than the rounding of its vertices, since
    // the sums are rounded too.
    const double half_reach = 0.5 * (1.0 + 1e-9) * reach;
    const auto margin_of = [=](const Bounds& shape) { return half_reach + 2.0 * shape.rounding; };
    order_.clear();
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        order_.emplace_back(shapes[i].box.min()[axis] - margin_of(shapes[i]), i);
    }
    std::sort(order_.begin(), order_.end());
    // Stored in sweep order and grown once.
    sorted_.clear();
    for (const auto& [begin, index] : order_) {
        const Box& box = shapes[index].box;
        const double margin = margin_of(shapes[index]);
        sorted_.push_back({begin, box.max()[axis] + margin, box.min()[1 - axis] - margin,
                           box.max()[1 - axis] + margin});
    }
    found_.clear();
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const Grown& one = sorted_[i];
        for (std::size_t j = i + 1; j < sorted_.size() && sorted_[j].begin <= one.end; ++j) {
            if (sorted_[j].low > one.high || one.low > sorted_[j].high) {
                continue;
            }
            const Pair pair = std::minmax(order_[i].second, order_[j].second);
            if (may_meet(shapes[pair.first], shapes[pair.second], reach)) {
                found_.push_back(pair);
            }
        }
    }
    sort_found(shapes.size(), pairs);
}

void BroadPhase::sort_found(std::size_t shapes, std::vector<Pair>& pairs) {
    // Counting sort by the first shape, then a sort of each bucket: few pairs share a first shape.
    ends_.assign(shapes + 1, 0);
    for (const Pair& pair : found_) {
        ++ends_[pair.first + 1];
    }
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    pairs.resize(found_.size());
    for (const Pair& pair : found_) {
        pairs[ends_[pair.first]++] = pair;
    }
    std::size_t first = 0;
    for (std::size_t shape = 0; shape < shapes; ++shape) {
        const auto begin = pairs.begin() + static_cast<std::ptrdiff_t>(first);
        first = ends_[shape];
        std::sort(begin, pairs.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

}  // namespace nearfield::localize
