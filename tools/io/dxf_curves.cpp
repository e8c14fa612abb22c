#include <nearfield/portable_math.hpp>

#include <tools/io/dxf_curves.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// The point a part of the way from one to another.
Vector2 between(const Vector2& from, const Vector2& to, double part) {
    return {(1.0 - part) * from.x + part * to.x, (1.0 - part) * from.y + part * to.y};
}

/// A polynomial B-spline.
struct Spline {
    std::size_t degree = 3;
    std::vector<double> knots;  // degree + 1 more than points, ascending
    std::vector<Vector2> points;

    /// The polar form of the polynomial between knots `span` and `span` + 1, at as many parameters
    /// as the degree says (Ramshaw 1987; de Boor's algorithm with another parameter in each step).
    [[nodiscard]] Vector2 polar(std::size_t span, const std::array<double, 3>& parameters) const {
        std::array<Vector2, 4> d;
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(span - degree), degree + 1,
                    d.begin());
        for (std::size_t step = 1; step <= degree; ++step) {
            for (std::size_t j = degree; j >= step; --j) {
                const double left = knots[span - degree + j];
                const double right = knots[span + 1 + j - step];
                d[j] = between(d[j - 1], d[j], (parameters[step - 1] - left) / (right - left));
            }
        }
        return d[degree];
    }

    /// The k-th point of the Bézier curve between two knots.
    [[nodiscard]] Vector2 control(std::size_t span, std::size_t k) const {
        std::array<double, 3> parameters{knots[span], knots[span], knots[span]};
        std::fill_n(parameters.begin(), k, knots[span + 1]);
        return polar(span, parameters);
    }
};

Spline read_spline(const DxfValues& values, const DxfEntity& entity) {
    Spline spline;
    const double degree = values.number(entity, 71);
    spline.knots = values.numbers(entity, 40);
    const std::vector<double> x = values.numbers(entity, 10);
    const std::vector<double> y = values.numbers(entity, 20);
    const std::vector<double> z = values.numbers(entity, 30);
    const std::vector<double> weights = values.numbers(entity, 41);
    if (x.empty() && entity.find(11) != nullptr) {
        values.fail(entity, "has points to go through, and no control points");
    }
    if (!(degree == 1.0 || degree == 2.0 || degree == 3.0)) {
        values.fail(entity, "is not of degree 1, 2 or 3; convert it to polylines");
    }
    spline.degree = static_cast<std::size_t>(degree);
    const auto differs = [](const std::vector<double>& numbers) {
        return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) !=
               numbers.end();
    };
    if (differs(weights)) {
        values.fail(entity, "is rational: its weights differ; convert it to polylines");
    }
    if (differs(z)) {
        values.fail(entity, "does not lie in the plane of x and y");
    }
    if (y.size() != x.size() || x.size() <= spline.degree ||
        spline.knots.size() != x.size() + spline.degree + 1) {
        values.fail(entity, "has " + std::to_string(x.size()) + " control points and " +
                                std::to_string(spline.knots.size()) + " knots; degree " +
                                std::to_string(spline.degree) +
                                " needs more points than that, and as many knots and " +
                                std::to_string(spline.degree + 1) + " more");
    }
    if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) {
        values.fail(entity, "its knots do not ascend");
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        spline.points.push_back({x[i], y[i]});
    }
    return spline;
}

}  // namespace

ArcChain dxf_spline(const DxfValues& values, const DxfEntity& entity) {
    static_cast<void>(values.direction(entity));  // its points are not seen from behind
    const Spline spline = read_spline(values, entity);
    ArcChain chain{.points = {}, .offset = entity.offset};
    double magnitude = 0.0;
    for (const Vector2& point : spline.points) {
        magnitude = std::max({magnitude, std::abs(point.x), std::abs(point.y)});
    }
    Vector2 end;
    for (std::size_t span = spline.degree; span < spline.points.size(); ++span) {
        if (spline.knots[span] == spline.knots[span + 1]) {
            continue;
        }
        const Vector2 start = spline.control(span, 0);
        const Vector2 second = spline.control(span, 1);
        if (!chain.points.empty() &&
            std::max(std::abs(start.x - end.x), std::abs(start.y - end.y)) > 1e-9 * magnitude) {
            values.fail(entity, "is in several pieces: a knot is repeated too often");
        }
        end = spline.control(span, spline.degree);
        ArcChain::Point& from = chain.points.emplace_back();
        from.at = start;
        if (spline.degree == 2) {
            from.controls = {between(second, start, 1.0 / 3.0), between(second, end, 1.0 / 3.0)};
        } else if (spline.degree == 3) {
            from.controls = {second, spline.control(span, 2)};
        }
    }
    if (!chain.points.empty()) {
        chain.points.push_back({.at = end});
    }
    return chain;
}

DxfEllipse dxf_ellipse(const DxfValues& values, const DxfEntity& entity) {
    constexpr double turn = 2.0 * std::numbers::pi;
    const Vector2 axis = values.point(entity, 11);
    DxfEllipse ellipse{.centre = values.point(entity, 10), .length = std::hypot(axis.x, axis.y)};
    ellipse.width = values.number(entity, 40) * ellipse.length;
    ellipse.rotation = arc_tangent(axis.y, axis.x);
    if (!(ellipse.length > 0.0 && ellipse.width > 0.0)) {
        values.fail(entity, "its axes are not above 0");
    }
    const double way = values.direction(entity);
    const double first = values.number(entity, 41, 0.0);
    double sweep = std::fmod(values.number(entity, 42, turn) - first, turn);
    sweep += sweep <= 0.0 ? turn : 0.0;
    constexpr double rounding = 1e-4;  // of files with few digits
    if (turn - sweep <= rounding || sweep <= rounding) {
        return ellipse;
    }
    const double ratio = ellipse.width / ellipse.length;
    const auto at = [&](double angle) {
        const auto [sine, cosine] = sine_cosine(angle);
        return Vector2{ellipse.centre.x + cosine * axis.x - way * ratio * sine * axis.y,
                       ellipse.centre.y + cosine * axis.y + way * ratio * sine * axis.x};
    };
    // None is near half a turn, where ends say little about the way between.
    const std::size_t parts = 1 + static_cast<std::size_t>(sweep / 2.0);
    ArcChain& chain = ellipse.arc.emplace(ArcChain{.points = {}, .offset = entity.offset});
    for (std::size_t i = 0; i <= parts; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(parts);
        ArcChain::Point& point = chain.points.emplace_back();
        point.at = at(first + part * sweep);
        if (i < parts) {
            point.ellipse = EllipticArc{.radius_x = ellipse.length,
                                        .radius_y = ellipse.width,
                                        .rotation = ellipse.rotation,
                                        .counter_clockwise = way > 0.0};
        }
    }
    return ellipse;
}

}  // namespace nearfield::tools
