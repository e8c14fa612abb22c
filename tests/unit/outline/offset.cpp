#include <nearfield/fill.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace nearfield {
namespace {

ResolvedFill offset_of(const std::vector<Ring>& rings, double distance, double deviation,
                       FillRule rule = FillRule::nonzero) {
    const Expected<ResolvedFill> fill = offset_fill(rings, rule, distance, deviation);
    EXPECT_TRUE(fill.has_value()) << fill.error().text();
    return fill.has_value() ? *fill : ResolvedFill{};
}

bool is_inside(const std::vector<Ring>& rings, const Vector2& p) {
    bool inside = false;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[(i + 1) % ring.size()];
            if ((a.y > p.y) != (b.y > p.y)) {
                const long double x = a.x + (static_cast<long double>(p.y) - a.y) *
                                                (static_cast<long double>(b.x) - a.x) /
                                                (static_cast<long double>(b.y) - a.y);
                inside = inside != (p.x < x);
            }
        }
    }
    return inside;
}

double distance_to(const std::vector<Ring>& rings, const Vector2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[(i + 1) % ring.size()];
            const double x = b.x - a.x;
            const double y = b.y - a.y;
            const double t =
                std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y), 0.0, 1.0);
            least = std::min(least, std::hypot(a.x + t * x - p.x, a.y + t * y - p.y));
        }
    }
    return least;
}

/// Rings that cross each other and themselves, with coinciding edges, spikes and tiny ones.
std::vector<Ring> random_rings(std::mt19937& random, double scale) {
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::uniform_int_distribution<int> pick(0, 5);
    std::vector<Ring> rings;
    for (int count = 1 + pick(random) / 2; count > 0; --count) {
        const Vector2 at{place(random), place(random)};
        const double size = pick(random) == 0 ? 0.01 : 0.8;
        const bool on_grid = pick(random) < 2;
        Ring ring;
        for (int i = 3 + pick(random); i > 0; --i) {
            Vector2 vertex{at.x + size * place(random), at.y + size * place(random)};
            if (on_grid) {
                vertex = {std::round(4.0 * vertex.x) / 4.0, std::round(4.0 * vertex.y) / 4.0};
            }
            ring.push_back({scale * vertex.x, scale * vertex.y});
        }
        if (pick(random) == 0) {
            ring.insert(ring.begin() + 1, ring.front());
            ring.push_back(ring[ring.size() / 2]);
        }
        rings.push_back(ring);
        if (pick(random) == 0) {
            std::reverse(ring.begin(), ring.end());
            rings.push_back(ring);
        }
    }
    return rings;
}

TEST(Offset, EveryPointIsOnTheSideOfItsDistance) {
    std::size_t decided = 0;
    for (unsigned seed = 0; seed < 1500; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> number(-1.0, 1.0);
        const double scale = seed % 3 == 0 ? 1e6 : 1.0;
        const std::vector<Ring> rings = random_rings(random, scale);
        const auto rule = static_cast<FillRule>(seed % 4);
        const Expected<ResolvedFill> region = resolve_fill(rings, rule);
        if (!region.has_value() || region->rings.empty()) {
            continue;
        }
        const double distance =
            scale * std::pow(10.0, number(random) - 1.5) * (seed % 2 == 0 ? 1.0 : -1.0);
        const double deviation = std::abs(distance) * std::pow(10.0, 2.0 * number(random) - 2.5);
        const ResolvedFill fill = offset_of(rings, distance, deviation, rule);
        ASSERT_LE(fill.deviation, deviation) << seed;
        const auto check = [&](const Vector2& p) {
            const bool inside = is_inside(region->rings, p);
            const double signed_distance = (inside ? -1.0 : 1.0) * distance_to(region->rings, p);
            if (std::abs(signed_distance - distance) <= fill.deviation + 1e-13 * scale) {
                return;
            }
            ++decided;
            ASSERT_EQ(is_inside(fill.rings, p), signed_distance < distance)
                << "seed " << seed << ", (" << p.x << ", " << p.y << "), distance "
                << signed_distance << " of " << distance << ", deviation " << fill.deviation;
        };
        for (int i = 0; i < 40; ++i) {
            check({2.0 * scale * number(random), 2.0 * scale * number(random)});
        }
        // Just beyond the deviation on either side, where edges and corners of the region decide.
        for (const Ring& ring : region->rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vector2& a = ring[i];
                const Vector2& b = ring[(i + 1) % ring.size()];
                const double t = std::clamp(2.0 * number(random), 0.0, 1.0);
                const Vector2 from{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
                const double angle = 3.2 * number(random);
                for (const double beyond : {-1.02, 1.02}) {
                    const double length = std::abs(distance) + beyond * fill.deviation;
                    check({from.x + length * std::cos(angle), from.y + length * std::sin(angle)});
                }
            }
        }
    }
    EXPECT_GT(decided, 50'000U);
}

TEST(Offset, ArcsGetAsManyEdgesAsTheDeviationNeeds) {
    const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    // A full circle of radius 1 within half of the deviation: pi / acos(1 - deviation / 2) edges.
    for (const double deviation : {0.1, 0.01, 1e-4, 1e-6}) {
        const ResolvedFill fill = offset_of(square, 1.0, deviation);
        ASSERT_EQ(fill.rings.size(), 1U);
        const double edges = 3.141592653589793 / std::acos(1.0 - 0.5 * deviation);
        EXPECT_GE(static_cast<double>(fill.rings[0].size()), edges) << deviation;
        EXPECT_LE(static_cast<double>(fill.rings[0].size()), edges + 12.0) << deviation;
    }
}

TEST(Offset, RefusalsNameWhatIsWrong) {
    const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto refusal = [&](double distance, double deviation, std::uint32_t most = max_vertices) {
        const Expected<ResolvedFill> fill =
            offset_fill(square, FillRule::nonzero, distance, deviation, {.most = most});
        EXPECT_FALSE(fill.has_value());
        return fill.has_value() ? Status() : fill.error();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(nan, 0.1).message().find("the offset is"), std::string::npos);
    EXPECT_NE(refusal(1e13, 0.1).message().find("the offset is"), std::string::npos);
    EXPECT_NE(refusal(1.0, 0.0).message().find("must be above 0"), std::string::npos);
    EXPECT_NE(refusal(1.0, 1e-14).message().find("is below that of the offset"), std::string::npos);
    EXPECT_EQ(refusal(1.0, 1e-4, 50).code(), StatusCode::too_large);
}

}  // namespace
}  // namespace nearfield
