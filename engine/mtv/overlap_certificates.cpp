#include <engine/geometry/segment.hpp>
#include <engine/mtv/overlap_certificates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// One disc for so many edges, but no more than this many discs.
constexpr std::uint32_t edges_per_disc = 8;
constexpr std::uint32_t max_discs = 128;

// Number of vertices, or of smaller groups, per group.
constexpr std::uint32_t group = 8;

// More than this many are grouped.
constexpr std::uint32_t most_in_top = 32;

// A disc shrinks until it contains no boundary point, but no more often; what is left counts.
constexpr int max_shrinks = 3;

void add_largest_disc(const simd::TransformedEdges& edges, std::uint32_t edge, WorkBudget& work,
                      std::vector<OverlapCertificate>& certificates) {
    const Vector start = edges.start(edge);
    const Vector end = edges.end(edge);
    const Vector along = end - start;
    const double length = along.norm();
    if (!(length > 0.0)) {
        return;
    }
    const Vector middle = 0.5 * (start + end);
    Vector inward = Vector(-along.y(), along.x()) / length;
    double radius = 0.5 * edges.box.sizes().minCoeff();  // no disc inside is larger
    // A larger step decides the side more reliably, provided nothing lies in between.
    const double probe = 1e-6 * length;
    const Vector left = middle + probe * inward;
    if (!contains(edges, left)) {
        inward = -inward;
    }
    for (int i = 0; i < max_shrinks; ++i) {
        const Vector centre = middle + radius * inward;
        const simd::NearEdge near = find_nearest(edges, centre);
        work.add(work_of_search(edges.count));
        if (near.squared >= radius * radius * (1.0 - 1e-9)) {
            break;
        }
        // The disc that touches the edge at its middle and passes through that point.
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
    const double depth = std::sqrt(find_nearest(edges, centre).squared);
    work.add(2 * work_of_search(edges.count));
    if (depth > 0.0 && contains(edges, centre)) {
        OverlapCertificate disc;
        disc.centre = centre;
        disc.least = depth;
        disc.most = depth;
        disc.is_disc = true;
        certificates.push_back(disc);
    }
}

OverlapCertificate group_of(const std::vector<OverlapCertificate>& certificates,
                            std::uint32_t first, std::uint32_t parts) {
    geometry::Box box;
    for (std::uint32_t i = first; i < first + parts; ++i) {
        box.extend(certificates[i].centre);
    }
    OverlapCertificate whole;
    whole.centre = box.center();
    whole.least = -std::numeric_limits<double>::infinity();
    whole.first = first;
    whole.parts = parts;
    whole.is_disc = certificates[first].is_disc;
    for (std::uint32_t i = first; i < first + parts; ++i) {
        const OverlapCertificate& part = certificates[i];
        const double way = (part.centre - whole.centre).norm();
        whole.least = std::max(whole.least, part.least - way);
        whole.most = std::max(whole.most, part.most + way);
        whole.spread = std::max(whole.spread, part.spread + way);
    }
    return whole;
}

/// Orders certificates such that consecutive ones are near each other: halves them along the longer
/// side of their box until as few are left as are in a group.
void order_by_place(std::vector<OverlapCertificate>& certificates, std::size_t first,
                    std::size_t end) {
    if (end - first <= group) {
        return;
    }
    geometry::Box box;
    for (std::size_t i = first; i < end; ++i) {
        box.extend(certificates[i].centre);
    }
    const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
    // Whole groups on both sides.
    std::size_t whole = group;
    while (2 * whole < end - first) {
        whole *= 2;
    }
    const std::size_t middle = first + whole;
    const auto at = [&certificates](std::size_t i) {
        return certificates.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(end),
                     [axis](const OverlapCertificate& i, const OverlapCertificate& j) {
                         return i.centre[axis] < j.centre[axis];
                     });
    order_by_place(certificates, first, middle);
    order_by_place(certificates, middle, end);
}

/// Adds the groups over the certificates from `first` on.
void add_groups(std::uint32_t first, std::vector<OverlapCertificate>& certificates,
                std::vector<std::uint32_t>& top) {
    auto end = static_cast<std::uint32_t>(certificates.size());
    if (end - first > most_in_top) {
        order_by_place(certificates, first, end);
    }
    while (end - first > most_in_top) {
        for (std::uint32_t i = first; i < end; i += group) {
            certificates.push_back(group_of(certificates, i, std::min(group, end - i)));
        }
        first = end;
        end = static_cast<std::uint32_t>(certificates.size());
    }
    for (; first < end; ++first) {
        top.push_back(first);
    }
}

}  // namespace

void add_certificates(const simd::TransformedEdges& edges, const geometry::Box& reach,
                      WorkBudget& work, std::vector<OverlapCertificate>& certificates,
                      std::vector<std::uint32_t>& top) {
    const auto middle_is_in_reach = [&](std::uint32_t edge) {
        return reach.contains(0.5 * (edges.start(edge) + edges.end(edge)));
    };
    std::uint32_t in_reach = 0;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        in_reach += middle_is_in_reach(i) ? 1U : 0U;
    }
    auto first = static_cast<std::uint32_t>(certificates.size());
    const std::uint32_t stride = std::max(edges_per_disc, (in_reach + max_discs - 1) / max_discs);
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        if (middle_is_in_reach(i) && next++ % stride == 0) {
            add_largest_disc(edges, i, work, certificates);
        }
    }
    add_groups(first, certificates, top);
    first = static_cast<std::uint32_t>(certificates.size());
    const geometry::Polygon& polygon = edges.placed.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        std::uint32_t before = polygon.ring_end(ring) - 1;
        for (std::uint32_t i = polygon.ring_begin(ring); i < polygon.ring_end(ring); ++i) {
            OverlapCertificate vertex;
            vertex.centre = edges.start(i);
            if (reach.contains(vertex.centre)) {
                vertex.before = edges.start(before) - vertex.centre;
                vertex.after = edges.end(i) - vertex.centre;
                certificates.push_back(vertex);
            }
            before = i;
        }
    }
    add_groups(first, certificates, top);
}

}  // namespace nearfield::mtv
