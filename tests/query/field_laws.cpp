#include <tests/oracle/plane.hpp>
#include <tests/query/field_laws.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nearfield::test {
namespace {

using oracle::Nearest;
using oracle::ShapeOracle;

/// The margin within which two distances count as equal, as the header states.
double margin_of(double tolerance, double distance) {
    return std::max(tolerance / 1000, std::ldexp(distance, -18));
}

/// The nearest point on a feature.
Vector2 place_on(const ShapeOracle& b, Feature feature, const Vector2& point) {
    return feature.kind == Feature::Kind::vertex ? b.vertex(feature.index)
                                                 : b.nearest_on_edge(feature.index, point).point;
}

struct Found {
    Vector2 point;
    Feature feature;
    Vector2 gradient;
    bool has_gradient = false;
    bool unique = false;
};

std::ostream& operator<<(std::ostream& text, const Found& found) {
    return text << "(" << found.point.x << ", " << found.point.y << ") "
                << (found.feature.kind == Feature::Kind::edge ? "edge " : "vertex ")
                << found.feature.index << (found.unique ? "" : " not unique") << ": ";
}

/// Checks a nearest feature and the gradient from it.
void check_feature(Report& report, const ShapeOracle& b, double tolerance, const Found& found) {
    const double truth = b.nearest(found.point).distance;
    const double named = distance_to_feature(b, found.feature, found.point);
    const double margin = margin_of(tolerance, truth);
    const double allowed = 4 * b.rounding() + 1e-12 * truth;
    report.require(named <= truth + margin + allowed, found, "is ", named, " away, the nearest ",
                   truth);
    const Vector2 place = place_on(b, found.feature, found.point);
    if (found.unique) {
        const double along_wall = std::sqrt(margin * (2 * named + margin));
        const double clearly_near = named + 0.9 * margin - 2 * allowed;
        for (const Nearest& rival : b.local_minima_within(found.point, clearly_near)) {
            report.require(oracle::distance(rival.point, place) <= 2.05 * along_wall + allowed,
                           found, "has a rival ", rival.distance, " away, it is ", named);
        }
    } else if (named > margin) {
        const auto others = b.edges_within(found.point, named + 1.1 * margin + 2 * allowed);
        report.require(std::any_of(others.begin(), others.end(),
                                   [&](const Nearest& other) {
                                       return oracle::distance(other.point, place) > 1e-9 * named;
                                   }),
                       found, "has no rival");
    }
    // Closer than a thousandth of d, either side may be reported.
    if (found.has_gradient && named > tolerance / 1000 + allowed) {
        const double side = b.signed_distance(found.point) < 0.0 ? -1.0 : 1.0;
        const Vector2 expected = oracle::times(oracle::minus(found.point, place), side / named);
        const double most = 1e-6 + 2 * allowed / named;
        report.require(oracle::distance(found.gradient, expected) <= most, found, "gradient (",
                       found.gradient.x, ", ", found.gradient.y, ") instead of (", expected.x, ", ",
                       expected.y, ")");
    }
}

/// Checks some cells of a result, or all.
template <class Check>
void for_cells(const DistanceFieldResult& result, std::size_t most, Check&& check) {
    const std::size_t cells = std::size_t{result.width} * result.height;
    Random random(cells);
    for (std::size_t i = 0; i < std::min(cells, most); ++i) {
        check(cells <= most ? i
                            : static_cast<std::size_t>(random.between(0.0, 1.0) *
                                                       static_cast<double>(cells)));
    }
}

}  // namespace

double distance_to_feature(const oracle::ShapeOracle& b, Feature feature, const Vector2& point) {
    if (feature.index >= b.size()) {
        return infinity;
    }
    return feature.kind == Feature::Kind::vertex ? oracle::distance(b.vertex(feature.index), point)
                                                 : b.nearest_on_edge(feature.index, point).distance;
}

PlacedShape::PlacedShape(Context& context, const Rings& rings, const Pose& pose)
    : context_(&context), pose_(pose), oracle_(rings, pose) {
    Expected<ShapeHandle> handle = context.add_shape(rings);
    EXPECT_TRUE(handle.has_value()) << handle.error().text();
    handle_ = handle.has_value() ? *handle : ShapeHandle{};
}

PlacedShape::~PlacedShape() {
    EXPECT_TRUE(context_->remove_shape(handle_).ok());
}

AnyField::AnyField(Context& context, Random& random)
    : pair_(any_pair(random)), shape_(context, pair_.b.rings, pair_.pose_b) {
    const Rectangle box = shape_.oracle().box();
    const double size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    const Vector2 low{box.min.x + size * random.between(-0.5, 0.8),
                      box.min.y + size * random.between(-0.5, 0.8)};
    rectangle_ = {low,
                  {low.x + size * random.scale(0.05, 1.5), low.y + size * random.scale(0.05, 1.5)}};
    tolerance_ = size * random.scale(0.01, 0.2);
}

DistanceFieldQuery AnyField::query() const {
    DistanceFieldQuery query;
    query.technique = device_techniques.front();
    query.b = shape_.instance();
    query.tolerance = tolerance_;
    query.rectangle = rectangle_;
    return query;
}

std::string AnyField::text() const {
    std::ostringstream text;
    text.precision(17);
    text << pair_.b.name << ' ' << to_text(pair_.b.rings) << " at (" << pair_.pose_b.translation.x
         << ", " << pair_.pose_b.translation.y << ") turned by " << pair_.pose_b.angle << " over ("
         << rectangle_.min.x << ", " << rectangle_.min.y << ") to (" << rectangle_.max.x << ", "
         << rectangle_.max.y << "), d = " << tolerance_;
    return text.str();
}

Vector2 turned(const Vector2& vector, double angle) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * vector.x - sine * vector.y, sine * vector.x + cosine * vector.y};
}

Rectangle box_around(std::span<const Vector2> points) {
    Rectangle box{points.front(), points.front()};
    for (const Vector2& point : points) {
        box.min = {std::min(box.min.x, point.x), std::min(box.min.y, point.y)};
        box.max = {std::max(box.max.x, point.x), std::max(box.max.y, point.y)};
    }
    return box;
}

Vector2 centre_of(const DistanceFieldResult& result, std::size_t cell) {
    return {result.origin.x + (static_cast<double>(cell % result.width) + 0.5) * result.cell,
            result.origin.y + (static_cast<double>(cell / result.width) + 0.5) * result.cell};
}

void FieldLaws::check_cells(const ShapeOracle& b, const DistanceFieldQuery& query,
                            const DistanceFieldResult& result, std::size_t max_cells) {
    Report report("features and gradients");
    report.require(result.status.ok(), result.status.text());
    const std::size_t cells = std::size_t{result.width} * result.height;
    report.require(result.features.size() == cells && result.unique.size() == cells &&
                       result.gradients.size() == 2 * cells,
                   "sizes ", result.features.size(), ", ", result.unique.size(), ", ",
                   result.gradients.size(), " for ", cells, " cells");
    if (!report.clean()) {
        return;
    }
    for_cells(result, max_cells, [&](std::size_t cell) {
        Found found;
        found.point = centre_of(result, cell);
        found.feature = result.features[cell];
        found.gradient = {static_cast<double>(result.gradients[2 * cell]),
                          static_cast<double>(result.gradients[2 * cell + 1])};
        found.has_gradient = true;
        found.unique = result.unique[cell] != 0;
        check_feature(report, b, query.tolerance, found);
    });
}

void FieldLaws::check_differences(const ShapeOracle& b, const DistanceFieldResult& result,
                                  std::size_t max_cells) {
    Report report("central differences");
    report.require(result.status.ok(), result.status.text());
    const std::size_t cells = std::size_t{result.width} * result.height;
    report.require(result.gradients.size() == 2 * cells, result.gradients.size(), " numbers for ",
                   cells, " cells");
    report.require(result.gradient_error_bound < 1.0, "bound ", result.gradient_error_bound);
    if (!report.clean()) {
        return;
    }
    const double most = result.gradient_error_bound * (1 + 1e-6) + b.rounding() / result.cell;
    for_cells(result, max_cells, [&](std::size_t cell) {
        const Vector2 centre = centre_of(result, cell);
        const double h = result.cell;
        const auto exact = [&](double x, double y) {
            return b.signed_distance({centre.x + x, centre.y + y});
        };
        const double x = (exact(h, 0) - exact(-h, 0)) / (2 * h);
        const double y = (exact(0, h) - exact(0, -h)) / (2 * h);
        const auto found_x = static_cast<double>(result.gradients[2 * cell]);
        const auto found_y = static_cast<double>(result.gradients[2 * cell + 1]);
        report.require(std::abs(found_x - x) <= most && std::abs(found_y - y) <= most, "cell ",
                       cell, " has (", found_x, ", ", found_y, ") instead of (", x, ", ", y,
                       ") within ", most);
    });
}

double FieldLaws::max_apart(const DistanceFieldResult& one, const DistanceFieldResult& other) {
    double most = 0.0;
    for (std::size_t i = 0; i < one.gradients.size(); ++i) {
        const auto difference = static_cast<double>(one.gradients[i] - other.gradients[i]);
        most = std::isnan(difference) ? difference : std::max(most, std::abs(difference));
        if (std::isnan(most)) {
            break;
        }
    }
    return most;
}

void FieldLaws::check_blended(const DistanceFieldResult& differences,
                              const DistanceFieldResult& blended) {
    ASSERT_TRUE(differences.status.ok()) << differences.status.text();
    ASSERT_TRUE(blended.status.ok()) << blended.status.text();
    ASSERT_EQ(differences.gradients.size(), blended.gradients.size());
    EXPECT_STRNE(blended.gradient_format, "");
    EXPECT_EQ(differences.values, blended.values);
    const double precision =
        blended.gradient_error_bound - differences.gradient_error_bound;  // the cost of the format
    EXPECT_GT(precision, 0.0);
    EXPECT_LE(max_apart(differences, blended), precision + 1e-7);
}

void FieldLaws::check_points(const ShapeOracle& b, const DistanceFieldQuery& query,
                             const DistanceFieldResult& result) {
    Report report("points of a field");
    report.require(result.status.ok(), result.status.text());
    report.require(result.points.size() == query.points.size(), result.points.size(), " of ",
                   query.points.size(), " points");
    if (!report.clean()) {
        return;
    }
    const double d = query.tolerance;
    const double octagon = std::sqrt(2.0 - std::sqrt(2.0)) * std::sqrt(2.0);  // 1.0824
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        const FieldPoint& point = result.points[i];
        report.require(point.position == query.points[i], "point ", i, " is another one");
        const double truth = b.signed_distance(point.position);
        report.require(
            std::abs(point.distance - truth) <= point.error_bound * (1 + 1e-6) + b.rounding(),
            "point ", i, " at ", point.position.x, ", ", point.position.y, " is ", point.distance,
            ", should be ", truth, " within ", point.error_bound);
        report.require(point.error_bound <= result.error_bound + d * (1 + 1e-6), "point ", i,
                       " has the bound ", point.error_bound);
        report.require(point.inside >= 0.0 && point.inside <= 1.0 + 1e-12, "inside ", point.inside);
        if (std::abs(truth) > octagon * d + result.error_bound + b.rounding()) {
            report.require((point.inside > 0.5) == (truth < 0.0), "point ", i, " is ", point.inside,
                           " inside, at ", truth);
        }
        if (std::abs(truth) > d * std::sqrt(2.0) * std::sqrt(2.0) + result.error_bound) {
            report.require(point.inside < 1e-12 || point.inside > 1 - 1e-12, "point ", i, " is ",
                           point.inside, " inside, far from the boundary at ", truth);
        }
        Found found{point.position, point.feature, point.gradient,
                    query.gradient == GradientMethod::analytic, point.unique};
        check_feature(report, b, d, found);
    }
}

}  // namespace nearfield::test
