#include <engine/geometry/polygon.hpp>
#include <nearfield/fill.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/tangled_rings.hpp>
#include <tests/unit/support/winding_oracle.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace nearfield {
namespace {

using test::TangledRings;
using test::WholePlace;
using test::WindingOracle;

const Ring clean_square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

CleanedRings cleaned(const std::vector<Ring>& rings, const Cleaning& cleaning = {}) {
    const Expected<CleanedRings> result = clean(rings, cleaning);
    EXPECT_TRUE(result.has_value()) << result.error().text();
    return result.has_value() ? *result : CleanedRings{};
}

TEST(Cleaning, GoodRingsStayAsTheyAre) {
    const CleanedRings result = cleaned({clean_square});
    EXPECT_EQ(result.rings, std::vector<Ring>{clean_square});
    EXPECT_EQ(result.deviation, 0.0);
    EXPECT_TRUE(result.dropped.empty());
}

TEST(Cleaning, RingsThatEncloseNothingAreReported) {
    const CleanedRings result = cleaned({{},
                                         {{7, 8}},
                                         {{1, 1}, {2, 2}, {1, 1}, {2, 2}},
                                         clean_square,
                                         {{5, 5}, {6, 6}, {9, 9}},
                                         {{3, 0}, {4, 3e-16}, {5, 0}}});
    EXPECT_EQ(result.rings, std::vector<Ring>{clean_square});
    ASSERT_EQ(result.dropped.size(), 5U);
    EXPECT_EQ(result.dropped[0].ring, 0U);
    EXPECT_EQ(result.dropped[1].ring, 1U);
    EXPECT_EQ(result.dropped[1].at, (Vector2{7, 8}));
    EXPECT_EQ(result.dropped[2].ring, 2U);
    EXPECT_EQ(result.dropped[3].ring, 4U);
    EXPECT_EQ(result.dropped[3].width, 0.0);
    EXPECT_EQ(result.dropped[4].ring, 5U);
    EXPECT_NEAR(result.dropped[4].width, 3e-16, 1e-18);
    EXPECT_LE(result.deviation, 3e-16);
    EXPECT_GE(result.deviation, 1.5e-16);
}

TEST(Cleaning, WidthDecides) {
    const std::vector<Ring> rings{clean_square, {{10, 0}, {20, 0}, {20, 0.01}, {10, 0.01}}};
    EXPECT_EQ(cleaned(rings).rings.size(), 2U);
    EXPECT_EQ(cleaned(rings, {.width = 0.009}).rings.size(), 2U);
    const CleanedRings result = cleaned(rings, {.width = 0.011});
    EXPECT_EQ(result.rings.size(), 1U);
    ASSERT_EQ(result.dropped.size(), 1U);
    EXPECT_NEAR(result.dropped[0].width, 0.01, 1e-5);
    EXPECT_NEAR(result.deviation, 0.005, 1e-5);
}

TEST(Cleaning, VerticesThatDoNotMatterVanish) {
    const CleanedRings result = cleaned(
        {{{0, 0}, {0, 0}, {2, 0}, {3, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 4}, {0, 0}}});
    EXPECT_EQ(result.rings, std::vector<Ring>{clean_square});
    EXPECT_EQ(result.repeated + result.collinear + result.spikes, 6U);
    EXPECT_GE(result.repeated, 2U);
    EXPECT_EQ(result.spikes, 1U);
    EXPECT_EQ(result.deviation, 0.0);
}

TEST(Cleaning, WhatIsLeftOfLongSpikesVanishesToo) {
    const CleanedRings result =
        cleaned({{{0, 0}, {4, 0}, {6, 1}, {7, 3}, {9, 5}, {7, 3}, {6, 1}, {4, 0}, {4, 4}, {0, 4}}});
    EXPECT_EQ(result.rings, std::vector<Ring>{clean_square});
    EXPECT_EQ(result.deviation, 0.0);
}

TEST(Cleaning, VerticesExactlyOnLinesCostNoDeviation) {
    Ring ring{{0, 0}};
    for (int i = 1; i <= 1000; ++i) {
        ring.push_back({3.0 * i, 7.0 * i});
    }
    ring.push_back({0, 7000});
    const CleanedRings result = cleaned({ring});
    EXPECT_EQ(result.rings, (std::vector<Ring>{{{0, 0}, {3000, 7000}, {0, 7000}}}));
    EXPECT_EQ(result.collinear, 999U);
    EXPECT_EQ(result.deviation, 0.0);
}

TEST(Cleaning, RingsThatAreThinWithoutTheirSpikesVanish) {
    const Ring ring{{0, 0}, {5, 0}, {5, -7}, {5.0002, 0}, {10, 0}, {10, 9e-4}, {0, 9e-4}};
    const CleanedRings result = cleaned({ring, clean_square}, {.width = 1e-3});
    EXPECT_EQ(result.rings, std::vector<Ring>{clean_square});
    EXPECT_EQ(result.spikes, 0U) << "vertices of dropped rings do not count";
    EXPECT_LE(result.deviation, 1.5e-3);
}

TEST(Cleaning, VerticesStayWhereOnlyRingsAreDropped) {
    const std::vector<Ring> rings{{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 4}, {0, 0}},
                                  {{1, 1}, {1, 1}, {2, 2}}};
    const CleanedRings result = cleaned(rings, {.vertices = false});
    EXPECT_EQ(result.rings, std::vector<Ring>{rings[0]});
    EXPECT_EQ(result.dropped.size(), 1U);
    EXPECT_EQ(result.repeated + result.collinear + result.spikes, 0U);
}

TEST(Cleaning, ErrorsOfVerticesDoNotAddUpBeyondTheWidth) {
    // Each vertex is hardly off the line between its neighbours, but the arc is far from its chord.
    Ring arc;
    for (int i = 0; i <= 1000; ++i) {
        const double angle = 0.003 * i;
        arc.push_back({std::cos(angle), std::sin(angle)});
    }
    const CleanedRings result = cleaned({arc}, {.width = 0.01});
    ASSERT_EQ(result.rings.size(), 1U);
    EXPECT_LT(result.rings[0].size(), 400U);
    EXPECT_GT(result.rings[0].size(), 8U);
    EXPECT_LE(result.deviation, 0.01);
    for (std::size_t i = 0; i + 1 < result.rings[0].size(); ++i) {
        const Vector2& a = result.rings[0][i];
        const Vector2& b = result.rings[0][i + 1];
        EXPECT_GE(std::hypot(0.5 * (a.x + b.x), 0.5 * (a.y + b.y)), 1.0 - result.deviation);
    }
}

TEST(Cleaning, BentSliversVanish) {
    const std::vector<Ring> rings{
        {{0, 0}, {10, 0}, {10, 10}, {10 - 1e-4, 10}, {10 - 1e-4, 1e-4}, {0, 1e-4}}};
    const CleanedRings result = cleaned(rings, {.width = 1e-3});
    EXPECT_TRUE(result.rings.empty());
    ASSERT_EQ(result.dropped.size(), 1U);
    EXPECT_GT(result.dropped[0].width, 1.0) << "no strip holds it";
    EXPECT_LE(result.deviation, 1.5e-3);
    EXPECT_GE(result.deviation, 0.5e-4);
}

TEST(Cleaning, RefusalsNameWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Ring> bad{clean_square, {{1, nan}}};
    const Expected<CleanedRings> coordinates = clean(bad);
    ASSERT_FALSE(coordinates.has_value());
    EXPECT_EQ(coordinates.error().message(), "ring 1, vertex 0: y is not a number");
    for (const double wrong : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
        const Expected<CleanedRings> width =
            clean(std::vector<Ring>{clean_square}, {.width = wrong});
        ASSERT_FALSE(width.has_value());
        EXPECT_EQ(width.error().code(), StatusCode::invalid_shape);
    }
}

/// Rings are left that a shape accepts, and no point changes sides farther than the deviation.
TEST(Cleaning, KeepsSidesWithinTheDeviation) {
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        TangledRings tangled(seed);
        const std::vector<Ring> rings = tangled.make(static_cast<int>(seed % TangledRings::kinds));
        Cleaning cleaning;
        cleaning.width = tangled.unit() * std::exp2(tangled.uniform(5, 55));
        const CleanedRings result = cleaned(rings, cleaning);
        SCOPED_TRACE("seed " + std::to_string(seed));
        ASSERT_LE(result.deviation, 1.5 * std::max(cleaning.width, 0x1p15 * tangled.unit()));
        if (result.rings.empty()) {
            continue;
        }
        geometry::Polygon polygon;
        const Status status = polygon.assign(result.rings, result.deviation);
        ASSERT_TRUE(status.ok()) << status.text();

        const WindingOracle before(rings, tangled.unit(), FillRule::odd_even);
        const WindingOracle after(result.rings, tangled.unit(), FillRule::odd_even);
        const double radius = result.deviation / tangled.unit();
        for (const std::vector<WholePlace>& ring : before.rings()) {
            for (const WholePlace& vertex : ring) {
                const double by = std::max(radius, 4.0) * std::exp2(tangled.uniform(-5, 3));
                const double angle = tangled.uniform(0, 6.2832);
                const WholePlace p{vertex.x + std::llround(by * std::cos(angle)),
                                   vertex.y + std::llround(by * std::sin(angle))};
                const int side = before.side(p);
                const int now = after.side(p);
                if (side >= 0 && now >= 0 && side != now) {
                    ++changed;
                    ASSERT_LE(before.distance(p), radius + 1.0);
                }
            }
        }
        for (const std::vector<WholePlace>& ring : after.rings()) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const WholePlace& next = ring[(i + 1) % ring.size()];
                const WholePlace middle{ring[i].x / 2 + next.x / 2, ring[i].y / 2 + next.y / 2};
                ASSERT_LE(before.distance(middle), radius + 2.0);
            }
        }
    }
    EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace nearfield
