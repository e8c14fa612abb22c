#include <engine/geometry/segment.hpp>
#include <engine/mtv/overlap_certificates.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// Maximum number of discs: one per edge, or one per several edges if there are more.
constexpr std::uint32_t max_discs = 64;

// Number of vertices, or of smaller groups, per group.
constexpr std::uint32_t group = 8;

// A disc shrinks until it contains no boundary point; three times usually suffice.
constexpr int max_shrinks = 12;

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
    double radius = 0.5 * edges.box.diagonal().norm();
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
    const double depth = depth_in(edges, centre);
    work.add(2 * work_of_search(edges.count));
    if (depth > 0.0) {
        OverlapCertificate disc;
        disc.centre = centre;
        disc.radius = depth;
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
    whole.first = first;
    whole.parts = parts;
    for (std::uint32_t i = first; i < first + parts; ++i) {
        whole.spread = std::max(
            whole.spread, (certificates[i].centre - whole.centre).norm() + certificates[i].spread);
    }
    return whole;
}

}  // namespace

double depth_in(const simd::TransformedEdges& edges, const Vector& point) {
    const double distance = std::sqrt(find_nearest(edges, point).squared);
    return contains(edges, point) ? distance : -distance;
}

void add_certificates(const simd::TransformedEdges& edges, WorkBudget& work,
                      std::vector<OverlapCertificate>& certificates,
                      std::vector<std::uint32_t>& top) {
    auto first = static_cast<std::uint32_t>(certificates.size());
    const std::uint32_t stride = (edges.count + max_discs - 1) / max_discs;
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        add_largest_disc(edges, i, work, certificates);
    }
    // The largest discs are the most informative.
    std::sort(certificates.begin() + first, certificates.end(),
              [](const OverlapCertificate& i, const OverlapCertificate& j) {
                  return i.radius > j.radius;
              });
    auto end = static_cast<std::uint32_t>(certificates.size());
    for (; first < end; ++first) {
        top.push_back(first);
    }
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        OverlapCertificate vertex;
        vertex.centre = edges.start(i);
        vertex.is_vertex = true;
        certificates.push_back(vertex);
    }
    end = static_cast<std::uint32_t>(certificates.size());
    while (end - first > group) {
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

}  // namespace nearfield::mtv
