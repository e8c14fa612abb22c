#include <tests/oracle/boundary.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/point_index.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

bool by_boundary_a(IntersectionKind kind) {
    return kind != IntersectionKind::volume_volume;
}

bool by_boundary_b(IntersectionKind kind) {
    return kind == IntersectionKind::boundary_boundary;
}

/// The distance to the part of a shape in question: its boundary or its interior.
double distance_from(const ShapeOracle& shape, bool by_boundary, const Vector2& p) {
    return by_boundary ? shape.nearest(p).distance : std::max(0.0, shape.signed_distance(p));
}

void check_samples(Report& report, const PlacedPair& pair, IntersectionKind kind,
                   const IntersectionResult& result) {
    const double most = result.error_bound + pair.rounding() + 1e-9 * pair.tolerance();
    for (const IntersectionSample& sample : result.samples) {
        const Vector2& p = sample.position;
        const double from_a = distance_from(pair.a(), by_boundary_a(kind), p);
        const double from_b = distance_from(pair.b(), by_boundary_b(kind), p);
        report.require(from_a <= most && from_b <= most, "sample ", p.x, ", ", p.y, " is ", from_a,
                       " from A and ", from_b, " from B; bound ", result.error_bound);
        if (!by_boundary_a(kind)) {
            report.require(sample.edge == IntersectionSample::no_edge, "sample names edge ",
                           sample.edge);
            continue;
        }
        const double from_edge = sample.edge < pair.a().size()
                                     ? pair.a().nearest_on_edge(sample.edge, p).distance
                                     : std::numeric_limits<double>::infinity();
        report.require(from_edge <= most, "sample ", p.x, ", ", p.y, " names edge ", sample.edge,
                       ", which is ", from_edge, " away; bound ", result.error_bound);
    }
}

/// Samples must be cell centres of the regions, ordered by region, row, column.
void check_grid(Report& report, const PlacedPair& pair, const IntersectionResult& result) {
    const double allowed = 1e-6 * result.cell + pair.rounding();
    std::tuple<std::size_t, long, long> last{0, -1, -1};
    for (const IntersectionSample& sample : result.samples) {
        bool placed = false;
        for (std::size_t i = std::get<0>(last); i < result.regions.size() && !placed; ++i) {
            const Region& region = result.regions[i];
            const double x = (sample.position.x - region.min.x) / result.cell - 0.5;
            const double y = (sample.position.y - region.min.y) / result.cell - 0.5;
            const long column = std::lround(x);
            const long row = std::lround(y);
            const bool on_grid =
                std::abs(x - static_cast<double>(column)) * result.cell <= allowed &&
                std::abs(y - static_cast<double>(row)) * result.cell <= allowed && column >= 0 &&
                column < static_cast<long>(region.width) && row >= 0 &&
                row < static_cast<long>(region.height);
            if (on_grid && std::tuple(i, row, column) > last) {
                last = {i, row, column};
                placed = true;
            }
        }
        report.require(placed, "sample ", sample.position.x, ", ", sample.position.y,
                       " is no cell's centre, or out of order");
    }
}

/// Points that must have a sample within the bound.
std::vector<Vector2> points_to_find(const PlacedPair& pair, IntersectionKind kind, double bound) {
    constexpr std::size_t most = 4000;
    std::vector<Vector2> points;
    if (kind == IntersectionKind::boundary_boundary) {
        return oracle::crossings(pair.a(), pair.b(), most);
    }
    if (kind == IntersectionKind::boundary_volume) {
        for (const Vector2& p : oracle::sample_boundary(pair.a(), pair.tolerance() / 3, most)) {
            if (pair.b().depth(p) > bound) {
                points.push_back(p);
            }
        }
        return points;
    }
    const Rectangle a = pair.a().box();
    const Rectangle b = pair.b().box();
    const Vector2 low{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)};
    const Vector2 high{std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)};
    Random random(most);
    for (std::size_t i = 0; i < most && low.x < high.x && low.y < high.y; ++i) {
        const Vector2 p{random.between(low.x, high.x), random.between(low.y, high.y)};
        if (pair.a().depth(p) > bound && pair.b().depth(p) > bound) {
            points.push_back(p);
        }
    }
    return points;
}

void check_complete(Report& report, const PlacedPair& pair, IntersectionKind kind,
                    const IntersectionResult& result) {
    const double bound = result.error_bound + pair.rounding() + 1e-9 * pair.tolerance();
    PointIndex samples(bound);
    for (const IntersectionSample& sample : result.samples) {
        samples.add(sample.position);
    }
    for (const Vector2& p : points_to_find(pair, kind, bound)) {
        report.require(samples.has_near(p), "no sample within ", result.error_bound, " of ", p.x,
                       ", ", p.y, " (", pair.a().depth(p), " deep in A, ", pair.b().depth(p),
                       " in B)");
    }
}

/// The length of the part of A's boundary that is in B or within `reach` of it.
double length_near(const ShapeOracle& a, const ShapeOracle& b, double reach) {
    constexpr double max_pieces = 4000;
    const double spacing = std::max(reach, a.perimeter() / max_pieces);
    double sum = 0.0;
    for (const oracle::Edge& edge : a.local_edges().edges()) {
        const Vector2 along = oracle::minus(edge.to, edge.from);
        const double pieces = std::max(1.0, std::ceil(oracle::length(along) / spacing));
        for (double i = 0.5; i < pieces; i += 1.0) {
            const Vector2 local = oracle::plus(edge.from, oracle::times(along, i / pieces));
            const double piece = oracle::length(along) / pieces;
            if (b.signed_distance(oracle::plus(local, a.origin())) <= reach + piece) {
                sum += piece;
            }
        }
    }
    return sum;
}

/// A cell can be wrong only near a boundary that is near the other shape: on either side, within
/// the bound plus the cell's half diagonal.
void check_area(Report& report, const PlacedPair& pair, const IntersectionResult& result) {
    const double reach = result.error_bound + pair.tolerance();
    const double length =
        length_near(pair.a(), pair.b(), 2 * reach) + length_near(pair.b(), pair.a(), 2 * reach);
    const double truth = pair.common_area();
    report.require(std::abs(result.area - truth) <= 2 * reach * length, "area ", result.area,
                   ", should be ", truth, " within ", 2 * reach * length);
}

}  // namespace

void check_intersection(const PlacedPair& pair, IntersectionKind kind,
                        const IntersectionResult& result) {
    Report report("intersection of kind " + std::to_string(static_cast<int>(kind)));
    check_summary(report, result, pair);
    if (!result.status.ok()) {
        return;
    }
    report.require(result.kind == kind, "kind is ", static_cast<int>(result.kind));
    report.require(result.count == result.samples.size(), "count ", result.count, ", ",
                   result.samples.size(), " samples");
    const double area = static_cast<double>(result.count) * result.cell * result.cell;
    report.require(std::abs(result.area - area) <= 1e-9 * area, "area ", result.area, " for ",
                   result.count, " cells of ", result.cell);
    check_samples(report, pair, kind, result);
    check_grid(report, pair, result);
    check_complete(report, pair, kind, result);
    if (kind == IntersectionKind::volume_volume) {
        check_area(report, pair, result);
    }
}

}  // namespace nearfield::test
