#include <engine/exact/witnesses.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::exact {
namespace {

using geometry::Vector;

// Discs at so many edges; at every so many of more.
constexpr std::uint32_t most_discs = 64;

// So many vertices, or groups of them, make up a group.
constexpr std::uint32_t group = 8;

// Discs shrink until nothing is in them; mostly three times suffice.
constexpr int most_shrinks = 12;

void add_largest_disc(const PlacedEdges& edges, std::uint32_t edge, WorkMeter& work,
                      std::vector<Witness>& witnesses) {
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
    if (!contains(edges, left)) {
        inward = -inward;
    }
    for (int i = 0; i < most_shrinks; ++i) {
        const Vector centre = middle + radius * inward;
        const NearEdge near = find_nearest(edges, centre);
        work.add(work_of_search(edges.count));
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
    work.add(2 * work_of_search(edges.count));
    if (depth > 0.0) {
        Witness disc;
        disc.centre = centre;
        disc.radius = depth;
        witnesses.push_back(disc);
    }
}

Witness group_of(const std::vector<Witness>& witnesses, std::uint32_t first, std::uint32_t parts) {
    geometry::Box box;
    for (std::uint32_t i = first; i < first + parts; ++i) {
        box.extend(witnesses[i].centre);
    }
    Witness whole;
    whole.centre = box.center();
    whole.first = first;
    whole.parts = parts;
    for (std::uint32_t i = first; i < first + parts; ++i) {
        whole.spread = std::max(whole.spread,
                                (witnesses[i].centre - whole.centre).norm() + witnesses[i].spread);
    }
    return whole;
}

}  // namespace

double depth_in(const PlacedEdges& edges, const Vector& point) {
    const double distance = std::sqrt(find_nearest(edges, point).squared);
    return contains(edges, point) ? distance : -distance;
}

void add_witnesses(const PlacedEdges& edges, WorkMeter& work, std::vector<Witness>& witnesses,
                   std::vector<std::uint32_t>& top) {
    auto first = static_cast<std::uint32_t>(witnesses.size());
    const std::uint32_t stride = (edges.count + most_discs - 1) / most_discs;
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        add_largest_disc(edges, i, work, witnesses);
    }
    // They say most.
    std::sort(witnesses.begin() + first, witnesses.end(),
              [](const Witness& i, const Witness& j) { return i.radius > j.radius; });
    auto end = static_cast<std::uint32_t>(witnesses.size());
    for (; first < end; ++first) {
        top.push_back(first);
    }
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        Witness vertex;
        vertex.centre = edges.start(i);
        vertex.is_vertex = true;
        witnesses.push_back(vertex);
    }
    end = static_cast<std::uint32_t>(witnesses.size());
    while (end - first > group) {
        for (std::uint32_t i = first; i < end; i += group) {
            witnesses.push_back(group_of(witnesses, i, std::min(group, end - i)));
        }
        first = end;
        end = static_cast<std::uint32_t>(witnesses.size());
    }
    for (; first < end; ++first) {
        top.push_back(first);
    }
}

}  // namespace nearfield::exact
