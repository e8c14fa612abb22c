#include <engine/geometry/segment.hpp>
#include <engine/mtv/crossing_certificates.hpp>

namespace nearfield::mtv {

using geometry::Vector;

namespace {

// Number of edges of each shape.
constexpr std::size_t max_edges = 128;
constexpr std::size_t max_edges_of_small = 16;
constexpr std::uint32_t small = 128;

}  // namespace

void CrossingCertificates::find_longest(const simd::TransformedEdges& edges,
                                        std::vector<Edge>& longest) {
    longest.clear();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const double length = (edges.end(i) - edges.start(i)).norm();
        if (length > 0.0) {
            longest.push_back({i, length});
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
}

void CrossingCertificates::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                double least, WorkBudget& work,
                                std::vector<CrossingCertificate>& certificates) {
    certificates.clear();
    find_longest(a, of_a_);
    find_longest(b, of_b_);
    work.add(a.count + b.count + of_a_.size() * of_b_.size());
    for (const Edge& edge_a : of_a_) {
        const Vector start_a = a.start(edge_a.index);
        const Vector along_a = (a.end(edge_a.index) - start_a) / edge_a.length;
        if (0.5 * edge_a.length <= least) {
            break;
        }
        for (const Edge& edge_b : of_b_) {
            const Vector start_b = b.start(edge_b.index);
            const Vector along_b = (b.end(edge_b.index) - start_b) / edge_b.length;
            const double sine = std::abs(geometry::cross(along_a, along_b));
            CrossingCertificate pair;
            pair.half_a = 0.5 * sine * edge_b.length;
            pair.half_b = 0.5 * sine * edge_a.length;
            if (0.5 * edge_b.length <= least) {
                break;
            }
            if (std::min(pair.half_a, pair.half_b) <= least) {
                continue;
            }
            // A's edge crosses the line of B's edge while B's normal separates its ends, and the
            // other way round.
            pair.across_a = {-along_a.y(), along_a.x()};
            pair.across_b = {-along_b.y(), along_b.x()};
            const Vector between = 0.5 * (b.start(edge_b.index) + b.end(edge_b.index)) -
                                   0.5 * (start_a + a.end(edge_a.index));
            pair.middle_a = pair.across_a.dot(between);
            pair.middle_b = pair.across_b.dot(between);
            certificates.push_back(pair);
        }
    }
}

}  // namespace nearfield::mtv
