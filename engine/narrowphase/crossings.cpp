#include <engine/narrowphase/crossings.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearfield::narrowphase {
namespace {

using geometry::Vector;

/// The part of edge `pair.first` of A within `margin` of the line of an edge of B.
Crossing crossing_of(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                     const simd::EdgePair& pair, double margin) {
    const Vector start = b.start(pair.second);
    const Vector along = b.end(pair.second) - start;
    // The sum of the coordinates bounds the length from above and needs no square root.
    const double near = margin * along.lpNorm<1>();
    const double at_start = geometry::cross(along, a.start(pair.first) - start);
    const double change = geometry::cross(along, a.end(pair.first) - start) - at_start;
    if (!(std::abs(change) > near)) {
        return {pair.first, 0.0, 1.0};  // parallel to the line, or nearly so
    }
    const double one = (-near - at_start) / change;
    const double other = (near - at_start) / change;
    return {pair.first, std::min(one, other), std::max(one, other)};
}

}  // namespace

std::span<const Crossing> CrossingFinder::find(const simd::TransformedEdges& a,
                                               const simd::TransformedEdges& b) {
    has_pairs_ = candidates_.find_all(a, b, pairs_);
    return cut(a, b);
}

std::span<const Crossing> CrossingFinder::find_reversed(const simd::TransformedEdges& a,
                                                        const simd::TransformedEdges& b) {
    for (simd::EdgePair& pair : pairs_) {
        std::swap(pair.first, pair.second);
    }
    return cut(a, b);
}

std::span<const Crossing> CrossingFinder::cut(const simd::TransformedEdges& a,
                                              const simd::TransformedEdges& b) {
    // Several times the rounding of the transformed vertices: the position on an edge is rounded
    // too.
    const double margin = 8.0 * (a.rounding + b.rounding);
    found_.clear();
    if (!has_pairs_) {
        for (std::uint32_t edge = 0; edge < a.count; ++edge) {
            found_.push_back({edge, 0.0, 1.0});
        }
        return found_;
    }
    for (const simd::EdgePair& pair : pairs_) {
        found_.push_back(crossing_of(a, b, pair, margin));
    }
    std::sort(found_.begin(), found_.end(), [](const Crossing& i, const Crossing& j) {
        return i.edge != j.edge ? i.edge < j.edge : i.from < j.from;
    });
    return found_;
}

}  // namespace nearfield::narrowphase
