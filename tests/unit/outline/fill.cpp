#include <engine/geometry/polygon.hpp>
#include <nearfield/fill.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield {
namespace {

Ring square(double x, double y, double side) {
    return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Ring reversed(const Ring& ring) {
    return {ring.rbegin(), ring.rend()};
}

ResolvedFill resolved(const std::vector<Ring>& rings, FillRule rule,
                      const FillSettings& settings = {}) {
    const Expected<ResolvedFill> fill = resolve_fill(rings, rule, settings);
    EXPECT_TRUE(fill.has_value()) << fill.error().text();
    return fill.has_value() ? *fill : ResolvedFill{};
}

Status refusal(const std::vector<Ring>& rings, FillRule rule, const FillSettings& settings = {}) {
    const Expected<ResolvedFill> fill = resolve_fill(rings, rule, settings);
    EXPECT_FALSE(fill.has_value());
    return fill.has_value() ? Status() : fill.error();
}

/// Counter-clockwise is positive, so this is the area of the region.
double area(const ResolvedFill& fill) {
    double twice = 0.0;
    for (const Ring& ring : fill.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[(i + 1) % ring.size()];
            twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
        }
    }
    return 0.5 * twice;
}

TEST(Fill, RegionMayBeEmpty) {
    const ResolvedFill negative = resolved({reversed(square(0, 0, 1))}, FillRule::positive);
    EXPECT_TRUE(negative.rings.empty());
    const ResolvedFill twice = resolved({square(0, 0, 1), square(0, 0, 1)}, FillRule::odd_even);
    EXPECT_TRUE(twice.rings.empty());
    const ResolvedFill line = resolved({{{0, 0}, {1, 1}, {3, 3}}, {{1, 0}}}, FillRule::nonzero);
    EXPECT_TRUE(line.rings.empty());
}

TEST(Fill, GapsNarrowerThanTheDeviationClose) {
    const std::vector<Ring> rings{{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                  {{1.0 + 1e-9, 0}, {2, 0}, {2, 1}, {1.0 + 1e-9, 1}}};
    EXPECT_EQ(resolved(rings, FillRule::nonzero).rings.size(), 2U);
    FillSettings settings;
    settings.deviation = 1e-6;
    const ResolvedFill fill = resolved(rings, FillRule::nonzero, settings);
    EXPECT_EQ(fill.rings.size(), 1U);
    EXPECT_LE(fill.deviation, 1e-6);
    EXPECT_GE(fill.deviation, 0.49e-6);
}

TEST(Fill, DeviationIsRelativeToTheBox) {
    for (const double scale : {1e-20, 1e-9, 1.0, 1e6, 4e11}) {
        const std::vector<Ring> rings{square(-scale, -scale, 1.5 * scale),
                                      square(-0.5 * scale, -0.4 * scale, 1.4 * scale)};
        const ResolvedFill fill = resolved(rings, FillRule::nonzero);
        EXPECT_EQ(fill.rings.size(), 1U);
        EXPECT_LT(fill.deviation, 1e-12 * scale);
        EXPECT_GT(fill.deviation, 0.0);
        EXPECT_NEAR(area(fill) / (scale * scale), 2.25 + 1.96 - 0.9, 1e-10);
        geometry::Polygon polygon;
        const Status status = polygon.assign(fill.rings, fill.deviation);
        EXPECT_TRUE(status.ok()) << scale << ": " << status.text();
    }
    // Far from the origin the coordinates' own rounding counts.
    const ResolvedFill far = resolved({square(1e6, 1e6, 1e-3)}, FillRule::nonzero);
    EXPECT_LT(far.deviation, 1e6 * 1e-14);
}

TEST(Fill, SubnormalCoordinatesAreZero) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    const std::vector<Ring> rings{{{tiny, 0}, {1, -tiny}, {1, 1}, {1e-300, 1}},
                                  {{0.5, 0.5}, {0.5, -1}, {1.5, 1e-310}}};
    EXPECT_NEAR(area(resolved(rings, FillRule::nonzero)), 1.0 + 0.75 - 0.21875, 0.2);
}

TEST(Fill, RefusalsNameWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Status no_number = refusal({square(0, 0, 1), {{0, 0}, {1, nan}}}, FillRule::nonzero);
    EXPECT_EQ(no_number.code(), StatusCode::invalid_shape);
    EXPECT_EQ(no_number.message(), "ring 1, vertex 1: y is not a number");
    const Status far = refusal({square(2e12, 0, 1)}, FillRule::odd_even);
    EXPECT_EQ(far.code(), StatusCode::invalid_shape);
    EXPECT_TRUE(far.message().starts_with("ring 0, vertex 0: x is 2e+12")) << far.message();
    EXPECT_EQ(refusal({}, FillRule::nonzero).code(), StatusCode::invalid_shape);
    EXPECT_TRUE(refusal({square(0, 0, 1e-21)}, FillRule::nonzero)
                    .message()
                    .starts_with("the rings span 1e-21"));
    EXPECT_EQ(refusal({square(0, 0, 1)}, static_cast<FillRule>(9)).code(),
              StatusCode::invalid_shape);

    FillSettings settings;
    settings.deviation = 1e-15;
    EXPECT_NE(refusal({square(0, 0, 1)}, FillRule::nonzero, settings).message().find("below"),
              std::string::npos);
    for (const double wrong : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
        settings.deviation = wrong;
        EXPECT_EQ(refusal({square(0, 0, 1)}, FillRule::nonzero, settings).code(),
                  StatusCode::invalid_shape);
    }
}

TEST(Fill, PartsMustAddUp) {
    const std::vector<Ring> rings{square(0, 0, 1), square(2, 2, 1)};
    for (const std::vector<std::uint32_t>& sizes :
         {std::vector<std::uint32_t>{1}, {1, 2}, {UINT32_MAX, UINT32_MAX, 4}, {3}}) {
        FillSettings settings;
        settings.part_sizes = sizes;
        const Status status = refusal(rings, FillRule::union_of_parts, settings);
        EXPECT_EQ(status.code(), StatusCode::invalid_shape);
        EXPECT_NE(status.message().find("there are 2"), std::string::npos) << status.message();
        EXPECT_TRUE(resolve_fill(rings, FillRule::nonzero, settings).has_value());
    }
}

TEST(Fill, RefusesMoreVerticesThanAllowed) {
    Ring star;
    for (int i = 0; i < 41; ++i) {
        const double angle = 2.0 * std::numbers::pi * i * 20.0 / 41.0;
        star.push_back({std::cos(angle), std::sin(angle)});
    }
    FillSettings settings;
    settings.most = 100;  // it has 779 crossings
    EXPECT_EQ(refusal({star}, FillRule::nonzero, settings).code(), StatusCode::too_large);
    settings.most = 900;
    EXPECT_TRUE(resolve_fill(std::vector<Ring>{star}, FillRule::nonzero, settings).has_value());
    settings.most = 3;
    EXPECT_EQ(refusal({square(0, 0, 1)}, FillRule::nonzero, settings).code(),
              StatusCode::too_large);
}

/// Rings that crossing and overlapping leave are as thin as a shape accepts, or gone.
TEST(Fill, ShapesAcceptEveryRing) {
    for (int i = 1; i < 200; ++i) {
        const double slope = 1e-13 * i;
        const std::vector<Ring> rings{{{0, 0}, {1e3, slope}, {1e3, 1}, {0, 1}},
                                      {{0, 1e-13}, {1e3, 0}, {1e3, -1}, {0, -1}}};
        for (const FillRule rule : {FillRule::odd_even, FillRule::nonzero}) {
            const ResolvedFill fill = resolved(rings, rule);
            geometry::Polygon polygon;
            const Status status = polygon.assign(fill.rings, fill.deviation);
            EXPECT_TRUE(status.ok()) << i << ": " << status.text();
        }
    }
}

/// Far from the origin the grid is hardly coarser than the rounding of coordinates.
TEST(Fill, DropsRingsThinnerThanRounding) {
    const double far = 0x1p20 - 8;
    const double cell = 0x1p-28;
    const auto sliver = [&](double width) {
        return Ring{{far + 2, far}, {far + 3, far}, {far + 2, far + width}};
    };
    const ResolvedFill kept = resolved({square(far, far, 1), sliver(4 * cell)}, FillRule::nonzero);
    EXPECT_EQ(kept.rings.size(), 2U);
    const ResolvedFill left = resolved({square(far, far, 1), sliver(cell)}, FillRule::nonzero);
    EXPECT_EQ(left.rings.size(), 1U);
    EXPECT_GE(left.deviation, kept.deviation + 0.9 * cell);
}

}  // namespace
}  // namespace nearfield
