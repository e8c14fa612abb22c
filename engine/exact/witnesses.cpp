#include <engine/exact/witnesses.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::exact {
namespace {

using geometry::Vector;

// So many vertices and so many edges of a shape are looked at; every so many of more.
constexpr std::uint32_t most_of_each = 48;

// Discs shrink until nothing is in them; mostly three times suffice.
constexpr int most_shrinks = 12;

}  // namespace

double depth_in(const EdgeArrays& edges, const Vector& point) {
    const double distance = std::sqrt(kernels::find_nearest(edges, point.x(), point.y()).squared);
    return kernels::contain(edges, point.x(), point.y()) ? distance : -distance;
}

void Witnesses::add_largest_disc(const PlacedEdges& edges, std::uint32_t edge) {
    const Vector start = edges.start(edge);
    const Vector end = edges.end(edge);
    const Vector along = end - start;
    const double length = along.norm();
    if (!(length > 0.0)) {
        return;
    }
    const Vector middle = 0.5 * (start + end);
    Vector inward = Vector(-along.y(), along.x()) / length;
    double radius = 0.5 * edges.box.diagonal().norm();
    // The larger the step the surer the side, as long as nothing is in between.
    const double probe = 1e-6 * length;
    const Vector left = middle + probe * inward;
    if (!kernels::contain(edges, left.x(), left.y())) {
        inward = -inward;
    }
    for (int i = 0; i < most_shrinks; ++i) {
        const Vector centre = middle + radius * inward;
        const NearEdge near = kernels::find_nearest(edges, centre.x(), centre.y());
        if (near.squared >= radius * radius * (1.0 - 1e-9)) {
            break;
        }
        // The disc that touches the edge in its middle and goes through that point.
        const Vector point =
            geometry::nearest_on_segment(centre, edges.start(near.edge), edges.end(near.edge))
                .point -
            middle;
        const double ahead = inward.dot(point);
        if (!(ahead > 0.0)) {
            break;
        }
        radius = std::min(radius, point.squaredNorm() / (2.0 * ahead));
    }
    const Vector centre = middle + radius * inward;
    const double depth = depth_in(edges, centre);
    if (depth > 0.0) {
        all_.push_back({centre, depth});
    }
}

void Witnesses::choose(const PlacedEdges& edges) {
    all_.clear();
    const std::uint32_t stride = (edges.count + most_of_each - 1) / most_of_each;
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        add_largest_disc(edges, i);
    }
    // The largest first: they say most.
    std::sort(all_.begin(), all_.end(),
              [](const Witness& i, const Witness& j) { return i.radius > j.radius; });
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        all_.push_back({edges.start(i), 0.0});
    }
}

}  // namespace nearfield::exact
