// Different shapes on a common lattice, coincident edges included, anywhere in the world. Held
// against exact Minkowski differences.

#include <engine/mtv/separating_translation.hpp>

#include <gtest/gtest.h>
#include <tests/unit/mtv/exact_difference.hpp>
#include <tests/unit/mtv/lattice_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::mtv {
namespace {

using namespace exact;

/// Divides every edge into equal parts, so that the same shape has many edges.
samples::Rings divided(const samples::Rings& rings, std::uint32_t parts) {
    samples::Rings divided;
    for (const Ring& ring : rings) {
        Ring& fine = divided.emplace_back();
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2 from = ring[i];
            const Vector2 to = ring[(i + 1) % ring.size()];
            for (std::uint32_t k = 0; k < parts; ++k) {
                const double part = static_cast<double>(k) / parts;
                fine.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
            }
        }
    }
    return divided;
}

/// Where the lattice lies, in how many parts each edge is, and how much work a search may take.
struct Place {
    Frame frame;
    double offset = 0.0;  ///< of its origin, both coordinates
    std::uint32_t parts = 1;
    std::uint64_t max_work = default_work;
};

/// A bar with three teeth that point up or down, `gap` apart.
Shape comb(std::int64_t tooth, std::int64_t gap, bool up) {
    const std::int64_t high = up ? 30 : -30;
    std::vector<Point> ring{{0, up ? -3 : 3}};
    for (std::int64_t x : {std::int64_t{0}, tooth + gap, 2 * (tooth + gap)}) {
        ring.insert(ring.end(), {{x, 0}, {x, high}, {x + tooth, high}, {x + tooth, 0}});
    }
    ring.push_back({3 * tooth + 2 * gap, up ? -3 : 3});
    return {ring};
}

Shape any_shape(samples::Random& random) {
    const std::vector<Shape> aligned = aligned_shapes();
    // The first one is large, which leaves little room for others beside it.
    return random.below(2) == 0
               ? aligned[1 + random.below(static_cast<std::uint32_t>(aligned.size()) - 1)]
               : lattice_star(random);
}

SeparatingTranslation find(const Shape& a, const Shape& b, const Place& place, double tolerance,
                           SeparatingTranslationFinder& finder) {
    const geometry::Polygon polygon_a =
        samples::polygon(divided(scaled(a, place.frame.scale), place.parts));
    const geometry::Polygon polygon_b =
        samples::polygon(divided(scaled(b, place.frame.scale), place.parts));
    const Pose pose{{place.offset, place.offset}, place.frame.angle};
    simd::TransformedInstances instances;
    const std::uint32_t index_a = instances.place(polygon_a, pose);
    const std::uint32_t index_b = instances.place(polygon_b, pose);
    instances.complete(index_a);
    instances.complete(index_b);
    return finder.find(instances[index_a], instances[index_b], pose, {tolerance, place.max_work});
}

struct Counts {
    int intersect = 0;
    int used_up = 0;
};

void check(const Shape& a, const Shape& b, const Place& place, SeparatingTranslationFinder& finder,
           Counts& counts) {
    const double tolerance = 1e-4 * place.frame.scale;
    const SeparatingTranslation way = find(a, b, place, tolerance, finder);
    const Difference difference(a, b);
    const double truth = place.frame.scale * difference.shortest();
    // Far from the origin, coordinates are multiples of larger steps.
    const double rounding =
        1e-9 * place.frame.scale + 256.0 * std::numeric_limits<double>::epsilon() * place.offset;
    if (!way.intersect) {
        EXPECT_LE(truth, rounding);
        return;
    }
    ++counts.intersect;
    const double length = way.vector.norm();
    EXPECT_GE(length, truth - rounding);
    EXPECT_LE(way.lower_bound, truth + rounding);
    EXPECT_LE(way.lower_bound, length);
    if (place.frame.scale == 1.0 && place.frame.angle == 0.0) {
        EXPECT_TRUE(difference.separates(way.vector.x(), way.vector.y()));
    }
    const SeparatingTranslation back = find(b, a, place, tolerance, finder);
    EXPECT_TRUE(back.intersect);
    EXPECT_GE(back.vector.norm(), truth - rounding);
    EXPECT_LE(back.lower_bound, truth + rounding);
    if (std::max(way.work, back.work) >= place.max_work) {
        counts.used_up += place.max_work == default_work ? 1 : 0;
        return;
    }
    EXPECT_LE(length, truth + tolerance + rounding);
    EXPECT_LE(back.vector.norm(), truth + tolerance + rounding);
    EXPECT_GE(way.lower_bound, length - tolerance);
}

TEST(LatticePairs, HaveTheLengthsOfExactDifferences) {
    samples::Random random(706);
    SeparatingTranslationFinder finder;
    Counts counts;
    const std::uint32_t pairs = number_of_pairs(400);
    for (std::uint32_t i = 0; i < pairs; ++i) {
        const auto step = [&] { return static_cast<std::int64_t>(random.below(9)) - 4; };
        // The teeth of every eighth pair fit into the gaps, with room on the lattice or with none.
        const bool combs = i % 8 == 0;
        const std::int64_t tooth = 5 + random.below(10);
        const std::int64_t gap = tooth + random.below(3);
        const Shape a = combs ? shifted(comb(tooth, gap, false), {0, 20}) : any_shape(random);
        const Shape b =
            shifted(combs ? comb(tooth, gap, true) : any_shape(random), {step(), step()});
        const Place places[] = {
            {{1.0, 0.0}, 0.0, 1},  {{1.0, 0.5 * std::numbers::pi}, 1e6, 1},
            {{1e-7, 0.7}, 0.0, 1}, {{1e6, 2.5}, 0.0, 1},
            {{1.0, 0.0}, 0.0, 64}, {{1.0 / 3.0, 0.7}, 10.0, 64},
        };
        // The many edges of the last take longer.
        Place place = places[random.below(random.below(4) == 0 ? 6 : 4)];
        // Work that runs out in the midst of the search leaves a bound that holds.
        if (random.below(4) == 0) {
            place.max_work = static_cast<std::uint64_t>(std::pow(10.0, random.between(3.0, 6.0)));
        }
        SCOPED_TRACE("pair " + std::to_string(i) + ", scale " + std::to_string(place.frame.scale) +
                     ", angle " + std::to_string(place.frame.angle) + ", in " +
                     std::to_string(place.parts) + " parts");
        check(a, b, place, finder, counts);
    }
    RecordProperty("intersect", counts.intersect);
    RecordProperty("used_up", counts.used_up);
    EXPECT_GE(counts.intersect, static_cast<int>(pairs / 3));
    EXPECT_LE(counts.used_up, static_cast<int>(pairs / 100));
}

}  // namespace
}  // namespace nearfield::mtv
