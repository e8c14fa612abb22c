#include <tests/oracle/boundary.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/point_index.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

using oracle::Nearest;
using oracle::ShapeOracle;

/// What points and directions may differ by from exact ones: rounding, no more. Only the choice
/// between features that are equally near within d/1000 is left to the library.
double allowed_rounding(const PlacedPair& pair) {
    return pair.rounding() + 1e-6 * pair.tolerance();
}

double angle_between(const Vector2& a, const Vector2& b) {
    return std::abs(std::atan2(a.x * b.y - a.y * b.x, oracle::dot(a, b)));
}

std::string text_of(const Vector2& p) {
    std::ostringstream text;
    text.precision(17);
    text << p.x << ", " << p.y;
    return text.str();
}

double distance_to_feature(const ShapeOracle& b, const Feature& feature, const Vector2& point) {
    if (feature.index >= b.size()) {
        return std::numeric_limits<double>::infinity();
    }
    return feature.kind == Feature::Kind::vertex ? oracle::distance(b.vertex(feature.index), point)
                                                 : b.nearest_on_edge(feature.index, point).distance;
}

/// The flag has to be down where another local minimum of the distance is clearly within d/1000 and
/// farther from `nearest` than twice what points of one straight wall within d/1000 could be; and
/// up where no edge has a point within d/1000 in any other direction.
void check_unique(Report& report, const PlacedPair& pair, const PenetrationRecord& record) {
    const double slack = pair.tolerance() / 1000;
    const double allowed = allowed_rounding(pair);
    const auto about = [&](const char* what) {
        return "record at " + text_of(record.point) + " of depth " + std::to_string(record.depth) +
               ", nearest " + text_of(record.nearest) + ", is " + what;
    };
    if (record.unique) {
        const double along_wall = std::sqrt(slack * (2 * record.depth + slack));
        const double clearly_near = record.depth + 0.9 * slack - 2 * allowed;
        for (const Nearest& rival : pair.b().local_minima_within(record.point, clearly_near)) {
            report.require(
                oracle::distance(rival.point, record.nearest) <= 2.05 * along_wall + allowed,
                about("called unique; a rival is "), rival.distance, " away at ",
                text_of(rival.point));
        }
    } else if (record.depth > slack) {
        const auto others =
            pair.b().edges_within(record.point, record.depth + 1.1 * slack + 2 * allowed);
        const bool rivalled = std::any_of(others.begin(), others.end(), [&](const Nearest& other) {
            const Vector2 direction = oracle::minus(other.point, record.point);
            return angle_between(direction, record.direction) > 1e-6;
        });
        report.require(rivalled, about("called not unique and has no rival"));
    }
}

void check_record(Report& report, const PlacedPair& pair, const PenetrationRecord& record) {
    const double d = pair.tolerance();
    const double allowed = allowed_rounding(pair);
    const auto about = [&](const char* what, double value) {
        std::ostringstream text;
        text.precision(17);
        text << "record at " << record.point.x << ", " << record.point.y << " depth "
             << record.depth << (record.unique ? "" : " (not unique)") << ": " << what << ' '
             << value;
        return text.str();
    };
    const auto require_at_most = [&](double value, double most, const char* what) {
        report.require(value <= most, value <= most ? std::string() : about(what, value));
    };
    const double truth = pair.b().nearest(record.point).distance;
    require_at_most(pair.a().nearest(record.point).distance, allowed,
                    "the point is off A's boundary by");
    require_at_most(pair.b().signed_distance(record.point), 1e-3 * d, "the point is outside B by");
    require_at_most(std::abs(record.depth - truth), 1e-3 * d + allowed, "the depth is off by");
    require_at_most(pair.b().nearest(record.nearest).distance, allowed,
                    "`nearest` is off B's boundary by");
    require_at_most(distance_to_feature(pair.b(), record.feature, record.nearest), allowed,
                    "`nearest` is off its feature by");
    require_at_most(std::abs(oracle::length(record.direction) - 1.0), 1e-9,
                    "the direction's length is off by");
    const Vector2 reached =
        oracle::plus(record.point, oracle::times(record.direction, record.depth));
    require_at_most(oracle::distance(reached, record.nearest), allowed,
                    "point + depth * direction misses `nearest` by");
    report.require(record.depth > 0.0, "depth ", record.depth);
    check_unique(report, pair, record);
}

/// The lowest place along A's rings, not before `from`, where the point lies; infinity: none.
double place_along(const ShapeOracle& a, const Vector2& point, double from, double allowed) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Nearest& on_edge : a.edges_within(point, allowed)) {
        const double within = on_edge.feature.kind == Feature::Kind::edge ? 0.5 : 0.0;
        const double place = on_edge.feature.index + within;
        if (place >= from) {
            lowest = std::min(lowest, place);
        }
    }
    return lowest;
}

/// Records follow A's rings: edge numbers do not fall, but for one wrap a ring at most.
void check_order(Report& report, const PlacedPair& pair, const PenetrationResult& result) {
    const double allowed = allowed_rounding(pair);
    std::size_t falls = 0;
    double place = 0.0;
    for (const PenetrationRecord& record : result.records) {
        double next = place_along(pair.a(), record.point, place, allowed);
        if (std::isinf(next)) {
            ++falls;
            next = place_along(pair.a(), record.point, 0.0, allowed);
        }
        place = std::isinf(next) ? 0.0 : next;
    }
    report.require(falls <= pair.a().ring_begins().size(), "records go back along A ", falls,
                   " times; A has ", pair.a().ring_begins().size(), " rings");
}

void check_deepest(Report& report, const PlacedPair& pair, PenetrationPoints points,
                   const PenetrationResult& result) {
    double deepest = 0.0;
    bool found = result.records.empty();
    for (const PenetrationRecord& record : result.records) {
        deepest = std::max(deepest, record.depth);
        found = found || record.point == result.deepest.point;
    }
    if (result.count > 0) {
        report.require(result.deepest.depth == deepest && found, "deepest is ",
                       result.deepest.depth, ", the deepest record ", deepest);
    }
    const oracle::Deepest truth =
        points == PenetrationPoints::vertices
            ? oracle::deepest_vertex(pair.a(), pair.b())
            : oracle::deepest_on_boundary(pair.a(), pair.b(), pair.tolerance() / 10);
    const double allowed = allowed_rounding(pair);
    report.require(deepest >= truth.depth - result.error_bound - allowed, "deepest is ", deepest,
                   " with a bound of ", result.error_bound, "; A's boundary at ", truth.point.x,
                   ", ", truth.point.y, " is at depth ", truth.depth);
    report.require(result.count == 0 || deepest <= std::max(truth.upper, 0.0) + allowed,
                   "deepest is ", deepest, ", but no point of A's boundary is deeper than ",
                   truth.upper);
}

void check_boundary_complete(Report& report, const PlacedPair& pair,
                             const PenetrationResult& result) {
    constexpr std::size_t most_samples = 4000;
    const double d = pair.tolerance();
    PointIndex records(2 * d * (1 + 1e-9));
    for (const PenetrationRecord& record : result.records) {
        records.add(record.point);
    }
    for (const Vector2& p : oracle::sample_boundary(pair.a(), d / 2, most_samples)) {
        report.require(records.has_near(p) || pair.b().depth(p) <= d, "no record within 2 d of ",
                       p.x, ", ", p.y, " on A's boundary, which is deep inside B");
    }
}

void check_vertices_complete(Report& report, const PlacedPair& pair,
                             const PenetrationResult& result) {
    const double close_call = 1e-3 * pair.tolerance() + pair.rounding();
    const double same = allowed_rounding(pair);
    PointIndex records(same);
    for (const PenetrationRecord& record : result.records) {
        records.add(record.point);
    }
    PointIndex vertices(same);
    std::size_t certain = 0;
    std::size_t possible = 0;
    for (std::uint32_t i = 0; i < pair.a().size(); ++i) {
        const Vector2 v = pair.a().vertex(i);
        const double depth = pair.b().depth(v);
        vertices.add(v);
        certain += depth > close_call ? 1U : 0U;
        possible += depth > -close_call ? 1U : 0U;
        report.require(depth <= close_call || records.has_near(v), "vertex ", i, " at ", v.x, ", ",
                       v.y, " of depth ", depth, " has no record");
    }
    for (const PenetrationRecord& record : result.records) {
        report.require(vertices.has_near(record.point), "the record at ", record.point.x, ", ",
                       record.point.y, " is at no vertex of A");
    }
    report.require(result.count >= certain && result.count <= possible, result.count, " records; ",
                   certain, " to ", possible, " vertices are inside");
}

}  // namespace

void check_penetration(const PlacedPair& pair, PenetrationPoints points,
                       const PenetrationResult& result) {
    Report report(points == PenetrationPoints::boundary ? "penetration of the boundary"
                                                        : "penetration of the vertices");
    check_summary(report, result, pair);
    if (!result.status.ok()) {
        return;
    }
    report.require(result.count == result.records.size(), "count ", result.count, ", ",
                   result.records.size(), " records");
    for (const PenetrationRecord& record : result.records) {
        check_record(report, pair, record);
    }
    check_order(report, pair, result);
    check_deepest(report, pair, points, result);
    if (points == PenetrationPoints::boundary) {
        check_boundary_complete(report, pair, result);
    } else {
        check_vertices_complete(report, pair, result);
    }
}

}  // namespace nearfield::test
