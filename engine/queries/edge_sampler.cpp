#include <engine/geometry/clip.hpp>
#include <engine/queries/edge_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace nearfield::queries {

using geometry::Vector;

namespace {

/// Every this many edges, a ring's samples restart at a vertex, so that samples never depend on
/// anything farther back.
constexpr std::uint32_t max_edges_back = 64;

}  // namespace

double EdgeSampler::parts_of(std::uint32_t edge) {
    const double edge_length = length(edge);
    if (edge != next_ && edge_length <= spacing_) {
        catch_up(edge);
    }
    return advance(edge, edge_length);
}

double EdgeSampler::length(std::uint32_t edge) const {
    const std::span<const Vector> vertices = polygon_.vertices();
    return (vertices[polygon_.next(edge)] - vertices[edge]).norm();
}

bool EdgeSampler::starts_anew(std::uint32_t edge) const {
    return (edge - polygon_.ring_begin(polygon_.ring_of(edge))) % max_edges_back == 0;
}

/// Walks back to the last edge whose samples are independent of earlier edges, and forward again.
void EdgeSampler::catch_up(std::uint32_t edge) {
    std::uint32_t from = edge;
    double from_length = 0.0;
    while (from_length <= spacing_ && !starts_anew(from)) {
        from_length = length(--from);
    }
    for (; from < edge; ++from) {
        static_cast<void>(advance(from, length(from)));
    }
}

/// Returns the number of parts of an edge, continuing from the samples before it.
double EdgeSampler::advance(std::uint32_t edge, double edge_length) {
    next_ = edge + 1;
    if (edge_length <= spacing_ && !starts_anew(edge) && since_last_ + edge_length <= spacing_) {
        since_last_ += edge_length;
        return 0.0;
    }
    const double parts = parts_of_length(edge_length, spacing_);
    since_last_ = edge_length / parts;
    return parts;
}

double parts_of_length(double length, double spacing) {
    return std::max(1.0, std::ceil(length / spacing));
}

PartRange parts_within(const geometry::TransformedPolygon& placed, std::uint32_t edge, double parts,
                       const geometry::Box& within) {
    if (parts < 16.0) {
        return {0.0, parts};  // too few to be worth the test
    }
    Vector a = placed.vertex(edge);
    Vector b = placed.vertex(placed.polygon().next(edge));
    const Vector start = a;
    const double whole = (b - a).norm();
    for (const int axis : {0, 1}) {
        if (!geometry::clip_to_slab(a, b, axis, within.min()[axis], within.max()[axis])) {
            return {};
        }
    }
    // One more part at either end, for rounding.
    const double from = (a - start).norm() / whole * parts;
    const double to = (b - start).norm() / whole * parts;
    return {std::max(0.0, std::floor(from) - 1.0), std::min(parts, std::ceil(to) + 2.0)};
}

}  // namespace nearfield::queries
