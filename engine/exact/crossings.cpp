#include <engine/exact/crossings.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearfield::exact {
namespace {

using geometry::Vector;

/// Where edge `pair.first` of A is no farther than `margin` from the line of an edge of B.
Crossing crossing_of(const PlacedEdges& a, const PlacedEdges& b, const EdgePair& pair,
                     double margin) {
    const Vector start = b.start(pair.second);
    const Vector along = b.end(pair.second) - start;
    // The sum of the coordinates is no less than the length, and costs no root.
    const double near = margin * along.lpNorm<1>();
    const double at_start = geometry::cross(along, a.start(pair.first) - start);
    const double change = geometry::cross(along, a.end(pair.first) - start) - at_start;
    if (!(std::abs(change) > near)) {
        return {pair.first, 0.0, 1.0};  // along the line, or hardly towards it
    }
    const double one = (-near - at_start) / change;
    const double other = (near - at_start) / change;
    return {pair.first, std::min(one, other), std::max(one, other)};
}

}  // namespace

std::span<const Crossing> CrossingFinder::find(const PlacedEdges& a, const PlacedEdges& b) {
    pairs_.clear();
    meeting_.for_each(a, b, [this](const EdgePair& pair) {
        pairs_.push_back(pair);
        return true;
    });
    return cut(a, b);
}

std::span<const Crossing> CrossingFinder::find_reversed(const PlacedEdges& a,
                                                        const PlacedEdges& b) {
    for (EdgePair& pair : pairs_) {
        std::swap(pair.first, pair.second);
    }
    return cut(a, b);
}

std::span<const Crossing> CrossingFinder::cut(const PlacedEdges& a, const PlacedEdges& b) {
    // Several times what the placed vertices are off by: where on an edge it is rounds as well.
    const double margin = 8.0 * (a.rounding + b.rounding);
    found_.clear();
    for (const EdgePair& pair : pairs_) {
        found_.push_back(crossing_of(a, b, pair, margin));
    }
    std::sort(found_.begin(), found_.end(), [](const Crossing& i, const Crossing& j) {
        return i.edge != j.edge ? i.edge < j.edge : i.from < j.from;
    });
    return found_;
}

}  // namespace nearfield::exact
