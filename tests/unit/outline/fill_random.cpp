#include <engine/geometry/polygon.hpp>
#include <nearfield/fill.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/tangled_rings.hpp>
#include <tests/unit/support/winding_oracle.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace nearfield {
namespace {

using test::side_of;
using test::TangledRings;
using test::WholePlace;
using test::WindingOracle;

std::uint64_t from_environment(const char* name, std::uint64_t usual) {
    const char* const asked = std::getenv(name);
    return asked == nullptr ? usual : std::strtoull(asked, nullptr, 10);
}

const char* name_of(FillRule rule) {
    switch (rule) {
        case FillRule::odd_even:
            return "odd-even";
        case FillRule::nonzero:
            return "nonzero";
        case FillRule::positive:
            return "positive";
        case FillRule::union_of_parts:
            return "union of parts";
    }
    return "";
}

/// True if the segments have a point in common other than an end of both.
bool interfere(const WholePlace& a, const WholePlace& b, const WholePlace& c, const WholePlace& d) {
    const int of_c = side_of(a, b, c);
    const int of_d = side_of(a, b, d);
    const int of_a = side_of(c, d, a);
    const int of_b = side_of(c, d, b);
    if (of_c * of_d < 0 && of_a * of_b < 0) {
        return true;
    }
    const auto inside = [](const WholePlace& from, const WholePlace& to, const WholePlace& p) {
        const bool is_end = (p.x == from.x && p.y == from.y) || (p.x == to.x && p.y == to.y);
        return !is_end && std::min(from.x, to.x) <= p.x && p.x <= std::max(from.x, to.x) &&
               std::min(from.y, to.y) <= p.y && p.y <= std::max(from.y, to.y);
    };
    return (of_c == 0 && inside(a, b, c)) || (of_d == 0 && inside(a, b, d)) ||
           (of_a == 0 && inside(c, d, a)) || (of_b == 0 && inside(c, d, b));
}

/// One input, resolved and compared with the oracle.
class Check {
public:
    Check(const std::vector<Ring>& rings, FillRule rule, const FillSettings& settings, double unit,
          std::uint64_t seed)
        : unit_(unit),
          oracle_(rings, unit, rule, settings.part_sizes),
          fill_(resolve_fill(rings, rule, settings)),
          random_(seed) {}

    void run() {
        ASSERT_TRUE(fill_.has_value()) << fill_.error().text();
        if (!fill_->rings.empty()) {
            geometry::Polygon polygon;
            const Status status = polygon.assign(fill_->rings, fill_->deviation);
            ASSERT_TRUE(status.ok()) << status.text();
        }
        radius_ = fill_->deviation / unit_;
        const WindingOracle result(fill_->rings, unit_, FillRule::odd_even);
        check_sides(result);
        check_boundary(result);
        check_planar(result);
    }

private:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    /// A point in the deviation's order of magnitude from another one, or far away.
    WholePlace beside(const WholePlace& p) {
        const double by = radius_ * std::exp2(uniform(-6.0, 4.0));
        const double angle = uniform(0.0, 6.2832);
        return {p.x + std::llround(by * std::cos(angle)), p.y + std::llround(by * std::sin(angle))};
    }

    static WholePlace between(const WholePlace& a, const WholePlace& b, double part) {
        return {a.x + std::llround(part * static_cast<double>(b.x - a.x)),
                a.y + std::llround(part * static_cast<double>(b.y - a.y))};
    }

    void check_sides(const WindingOracle& result) {
        const auto check_ring = [&](const std::vector<WholePlace>& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const WholePlace& next = ring[(i + 1) % ring.size()];
                check_side(result, beside(ring[i]));
                check_side(result, beside(between(ring[i], next, uniform(0.0, 1.0))));
                // Far from all edges, mostly.
                check_side(result, {ring[i].x, next.y});
            }
        };
        for (const std::vector<WholePlace>& ring : oracle_.rings()) {
            check_ring(ring);
        }
        for (const std::vector<WholePlace>& ring : result.rings()) {
            check_ring(ring);
        }
    }

    void check_side(const WindingOracle& result, const WholePlace& p) {
        const int wanted = oracle_.side(p);
        const int found = result.side(p);
        if (wanted < 0 || found < 0 || wanted == found) {
            return;
        }
        EXPECT_LE(oracle_.distance(p), radius_ + 1.0) << "wrong side far from all edges";
        EXPECT_TRUE(oracle_.has_near(p, radius_ + 4.0, found))
            << "wrong side far from the boundary";
    }

    /// Both sides of the region are near every point of the result's edges.
    void check_boundary(const WindingOracle& result) {
        for (const std::vector<WholePlace>& ring : result.rings()) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const WholePlace p =
                    between(ring[i], ring[(i + 1) % ring.size()], uniform(0.0, 1.0));
                EXPECT_TRUE(oracle_.has_near(p, radius_ + 4.0, 0)) << "an inner edge remains";
                EXPECT_TRUE(oracle_.has_near(p, radius_ + 4.0, 1)) << "an outer edge came up";
            }
        }
    }

    static void check_planar(const WindingOracle& result) {
        struct Edge {
            WholePlace a, b;
        };
        std::vector<Edge> edges;
        for (const std::vector<WholePlace>& ring : result.rings()) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
            }
        }
        for (std::size_t i = 0; i < edges.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_FALSE(interfere(edges[i].a, edges[i].b, edges[j].a, edges[j].b))
                    << "edges " << j << " and " << i << " cross or overlap";
            }
        }
    }

    double unit_;
    WindingOracle oracle_;
    Expected<ResolvedFill> fill_;
    std::mt19937_64 random_;
    double radius_ = 0.0;
};

std::string describe(const std::vector<Ring>& rings) {
    std::string text;
    char number[80];
    for (const Ring& ring : rings) {
        text += "\n  ";
        for (const Vector2& vertex : ring) {
            std::snprintf(number, sizeof number, "{%a, %a}, ", vertex.x, vertex.y);
            text += number;
        }
    }
    return text;
}

TEST(FillRandom, AgreesWithWindingNumbers) {
    const std::uint64_t first = from_environment("NEARFIELD_TEST_FIRST", 0);
    const std::uint64_t count = from_environment("NEARFIELD_TEST_CASES", 1500);
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        TangledRings tangled(seed);
        const std::vector<Ring> rings = tangled.make(static_cast<int>(seed % TangledRings::kinds));
        const auto rule = static_cast<FillRule>(seed / TangledRings::kinds % 4);
        FillSettings settings;
        std::vector<std::uint32_t> parts;
        if (rings.size() > 1 && tangled.whole(0, 1) == 0) {
            parts = {static_cast<std::uint32_t>(rings.size() - 1), 0, 1};
            settings.part_sizes = parts;
        }
        if (tangled.whole(0, 3) == 0) {
            settings.deviation = tangled.unit() * std::exp2(tangled.uniform(10, 55));
        }
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + name_of(rule) + ", deviation " +
                     std::to_string(settings.deviation) + describe(rings));
        const Expected<ResolvedFill> fill = resolve_fill(rings, rule, settings);
        if (!fill.has_value()) {
            // Everything in one place, or a deviation below the grid's.
            ASSERT_EQ(fill.error().code(), StatusCode::invalid_shape);
            ASSERT_TRUE(settings.deviation > 0.0 ||
                        fill.error().message().starts_with("the rings span 0 "))
                << fill.error().text();
            continue;
        }
        Check(rings, rule, settings, tangled.unit(), seed).run();
        if (HasFailure()) {
            return;
        }
    }
}

}  // namespace
}  // namespace nearfield
