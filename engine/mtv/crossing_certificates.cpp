#include <engine/geometry/segment.hpp>
#include <engine/mtv/crossing_certificates.hpp>

namespace nearfield::mtv {

using geometry::Vector;

namespace {

// Number of edges of each shape.
constexpr std::size_t max_edges = 128;
constexpr std::size_t max_edges_of_small = 8;
constexpr std::uint32_t small = 128;

/// A certificate's strips, but for their middles. The edges have these lengths, and run along these
/// unit vectors.
CrossingCertificate strips_of(const Vector& along_a, double length_a, const Vector& along_b,
                              double length_b) {
    // A's edge crosses the line of B's edge while B's normal separates its ends, and the other way
    // round.
    const double sine = std::abs(geometry::cross(along_a, along_b));
    CrossingCertificate pair;
    pair.across_a = {-along_a.y(), along_a.x()};
    pair.across_b = {-along_b.y(), along_b.x()};
    pair.half_a = 0.5 * sine * length_b;
    pair.half_b = 0.5 * sine * length_a;
    return pair;
}

void set_middles(const Vector& middle_a, const Vector& middle_b, CrossingCertificate& pair) {
    const Vector between = middle_b - middle_a;
    pair.middle_a = pair.across_a.dot(between);
    pair.middle_b = pair.across_b.dot(between);
}

Vector middle_of(const simd::TransformedEdges& edges, std::uint32_t edge) {
    return 0.5 * (edges.start(edge) + edges.end(edge));
}

}  // namespace

CrossingCertificate crossing_of(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                const simd::EdgePair& pair) {
    const Vector along_a = a.end(pair.first) - a.start(pair.first);
    const Vector along_b = b.end(pair.second) - b.start(pair.second);
    const double length_a = along_a.norm();
    const double length_b = along_b.norm();
    if (!(length_a > 0.0 && length_b > 0.0)) {
        return {Vector::UnitX(), Vector::UnitY()};
    }
    CrossingCertificate crossing =
        strips_of(along_a / length_a, length_a, along_b / length_b, length_b);
    set_middles(middle_of(a, pair.first), middle_of(b, pair.second), crossing);
    return crossing;
}

void CrossingCertificates::find_longest(const simd::TransformedEdges& edges,
                                        const geometry::Box& reach, std::vector<Edge>& longest) {
    longest.clear();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        const double length = (end - start).norm();
        if (length > 0.0 &&
            reach.intersects(geometry::Box(start.cwiseMin(end), start.cwiseMax(end)))) {
            longest.push_back({i, length, Vector::Zero()});
        }
    }
    const std::size_t count =
        std::min(longest.size(), edges.count <= small ? max_edges_of_small : max_edges);
    // Equally long edges in order, so that the result is the same with every standard library.
    std::partial_sort(longest.begin(), longest.begin() + static_cast<std::ptrdiff_t>(count),
                      longest.end(), [](const Edge& i, const Edge& j) {
                          return i.length > j.length || (i.length == j.length && i.index < j.index);
                      });
    longest.resize(count);
    for (Edge& edge : longest) {
        edge.along = (edges.end(edge.index) - edges.start(edge.index)) / edge.length;
    }
}

void CrossingCertificates::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                double longest, double least, WorkBudget& work,
                                std::vector<CrossingCertificate>& certificates) {
    certificates.clear();
    find_longest(a, geometry::grown(b.box, longest), of_a_);
    find_longest(b, geometry::grown(a.box, longest), of_b_);
    work.add(a.count + b.count + of_a_.size() * of_b_.size());
    for (const Edge& edge_a : of_a_) {
        if (0.5 * edge_a.length <= least) {
            break;
        }
        for (const Edge& edge_b : of_b_) {
            if (0.5 * edge_b.length <= least) {
                break;
            }
            CrossingCertificate pair =
                strips_of(edge_a.along, edge_a.length, edge_b.along, edge_b.length);
            if (std::min(pair.half_a, pair.half_b) > least) {
                set_middles(middle_of(a, edge_a.index), middle_of(b, edge_b.index), pair);
                certificates.push_back(pair);
            }
        }
    }
}

}  // namespace nearfield::mtv
