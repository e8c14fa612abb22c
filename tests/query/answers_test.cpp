#include <tests/query/agreement.hpp>
#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t every_answer_seed = 4711;

void check_answer(const PlacedPair& pair, const PenetrationQuery& query,
                  const PenetrationResult& result) {
    check_penetration(pair, query.points, result);
}

void check_answer(const PlacedPair& pair, const ContactQuery& query, const ContactResult& result) {
    check_contacts(pair, query.contact_distance, result);
}

/// Areas of hundreds of rings take the oracle minutes: there, techniques only agree.
void check_answer(const PlacedPair& pair, const IntersectionQuery& query,
                  const IntersectionResult& result) {
    if (pair.pair().a.rings.size() + pair.pair().b.rings.size() < 200) {
        check_intersection(pair, query.kind, result);
    }
}

void check_answer(const PlacedPair& pair, const SeparationQuery& /*query*/,
                  const SeparationResult& result) {
    check_separation(pair, result);
}

/// A pair of shapes is asked everything, by each technique. The oracle knows the answers,
/// techniques agree, and answers are the same without their lists and with A and B exchanged.
class EveryAnswer : public QueryTest {
protected:
    static void check(const Pair& pair, double contact_distance) {
        const CorpusKeeper keeper(pair, contact_distance);
        SCOPED_TRACE(describe(pair) + "\ncontact distance " + std::to_string(contact_distance));
        const PlacedPair placed(context(), pair);
        const SubPixelGrids grids =
            has_grid_of_cpu(host_device()) ? SubPixelGrids::same : SubPixelGrids::apart;
        const std::vector<AnyResult> exact = answers(placed, contact_distance, Technique::cpu);
        for (const Technique technique : device_techniques) {
            SCOPED_TRACE(to_string(technique));
            const std::vector<AnyQuery> asked = queries(placed, contact_distance, technique);
            const std::vector<AnyResult> found = answers(placed, contact_distance, technique);
            for (std::size_t i = 0; i < found.size(); ++i) {
                const bool is_on_a_grid = std::holds_alternative<IntersectionQuery>(asked[i]);
                check_agreement({.pair = placed,
                                 .query = asked[i],
                                 .grids = is_on_a_grid ? grids : SubPixelGrids::same,
                                 .mostly_equal = false},
                                found[i], by_technique_of(found[i], exact[i]));
            }
        }
    }
    static void check(const Pair& pair) { check(pair, 2.0 * pair.tolerance); }
    /// Of two shapes in world coordinates.
    static void check(const Rings& a, const Rings& b, double tolerance) {
        check({{"A", a}, {"B", b}, {}, {}, tolerance});
    }

private:
    static std::vector<AnyQuery> queries(const PlacedPair& pair, double contact_distance,
                                         Technique technique) {
        std::vector<AnyQuery> queries{pair.separation()};
        for (const PenetrationPoints points : both_ways) {
            queries.emplace_back(pair.penetration(points));
        }
        queries.emplace_back(pair.contacts(contact_distance));
        for (const IntersectionKind kind : every_kind) {
            queries.emplace_back(pair.intersection(kind));
        }
        for (AnyQuery& any : queries) {
            std::visit(
                [technique](auto& query) {
                    if constexpr (requires { query.technique; }) {
                        query.technique = technique;
                    }
                },
                any);
        }
        return queries;
    }
    static std::vector<AnyResult> answers(const PlacedPair& pair, double contact_distance,
                                          Technique technique) {
        std::vector<AnyResult> results;
        for (const AnyQuery& any : queries(pair, contact_distance, technique)) {
            std::visit(
                [&](const auto& query) {
                    if constexpr (requires {
                                      check_answer(pair, query, run_alone(context(), query));
                                  }) {
                        const auto result = run_alone(context(), query);
                        EXPECT_EQ(result.technique, technique);
                        check_answer(pair, query, result);
                        check_otherwise(pair, query, result);
                        results.emplace_back(result);
                    }
                },
                any);
        }
        return results;
    }
    /// The same query without its list.
    template <class Query>
    static void check_otherwise(const PlacedPair& /*pair*/, Query query,
                                const typename Query::Result& with) {
        query.summary_only = true;
        const auto without = run_alone(context(), query);
        EXPECT_TRUE(without.status.ok()) << without.status.text();
        EXPECT_EQ(without.count, with.count) << "without a list";
        EXPECT_EQ(without.intersects, with.intersects);
        EXPECT_EQ(without.error_bound, with.error_bound);
        if constexpr (requires { with.deepest; }) {
            // Of points that are equally deep, the device may name any.
            EXPECT_NEAR(without.deepest.depth, with.deepest.depth, 1e-3 * with.tolerance);
            EXPECT_TRUE(with.technique != Technique::cpu ||
                        without.deepest.unique == with.deepest.unique);
        } else if constexpr (requires { with.area; }) {
            EXPECT_EQ(without.area, with.area);
        } else {
            EXPECT_EQ(without.manifold.size(), with.manifold.size());
        }
        if constexpr (requires { with.samples; }) {
            EXPECT_TRUE(without.samples.empty());
        } else {
            EXPECT_TRUE(without.points.empty());
        }
    }
    /// The other way round, and the closest point of A alone.
    static void check_otherwise(const PlacedPair& pair, SeparationQuery query,
                                const SeparationResult& separation) {
        ClosestPointQuery closest = pair.closest_point();
        closest.technique = query.technique;
        check_same(separation, run_alone(context(), closest));
        std::swap(query.a, query.b);
        const SeparationResult other_way = run_alone(context(), query);
        EXPECT_EQ(other_way.distance, separation.distance) << "A and B swapped";
        EXPECT_EQ(other_way.intersects, separation.intersects);
    }
};

/// Every other pair is moved apart, by little or by much.
TEST_F(EveryAnswer, HoldsForRandomPairs) {
    int number = 0;
    for_each_case(every_answer_seed, 60, [&](Random& random) {
        Pair pair = any_pair(random);
        if (number++ % 2 == 1) {
            const double far = random.scale(1.0, 1e4) * pair.tolerance;
            const double direction = random.between(-3.2, 3.2);
            pair.pose_b.translation.x += far * std::cos(direction);
            pair.pose_b.translation.y += far * std::sin(direction);
        }
        const double contact_distance = pair.tolerance * random.scale(0.3, 8.0);
        check(pair, contact_distance);
    });
}

/// As they are, and apart.
TEST_F(EveryAnswer, HoldsForEveryFamily) {
    for (Pair& pair : family_pairs(every_answer_seed)) {
        check(pair, 0.5);
        pair.pose_b.translation.x += 15.0;
        check(pair, 0.5);
    }
}

TEST_F(EveryAnswer, HoldsForLongCoasts) {
    Random random(every_answer_seed);
    for (const int n : {5000, 20000}) {
        SCOPED_TRACE(n);
        const Rings a = coast(random, n, 0.5);
        const Rings b = scaled_and_moved(coast(random, n / 2, 0.4), 1.5, {0.9, 0.4});
        const Vector2 far = n == 5000 ? Vector2{1e6, -1e6} : Vector2{};
        check(scaled_and_moved(a, 1.0, far), scaled_and_moved(b, 1.0, far), 0.01);
    }
}

TEST_F(EveryAnswer, HoldsForIdenticalCopiesAndSharedEdges) {
    Random random(every_answer_seed);
    const Rings shape = star(random, 60, 0.5);
    check(shape, shape, 0.02);
    const Rings left = rectangle({-2, -1}, {0, 1});
    const Rings within = rectangle({-1.5, -0.5}, {-0.5, 0.5});
    check(left, rectangle({0, -1}, {2, 1}), 0.05);
    check(left, rectangle({0, -0.3}, {2, 3}), 0.05);
    check(left, rectangle({-1, -1}, {2, 1}), 0.05);  // overlapping, edges on one line
    check(left, within, 0.05);
    check(within, left, 0.05);
}

TEST_F(EveryAnswer, HoldsForShapesSmallerThanACell) {
    Random random(every_answer_seed);
    const Rings big = star(random, 30, 0.6);
    const Rings small = scaled_and_moved(star(random, 9, 0.5), 1e-3, {0.1, 0.05});
    check(small, big, 0.1);
    check(big, small, 0.1);
    check(big, big, 10.0);
}

TEST_F(EveryAnswer, HoldsAtExtremeScales) {
    Random random(every_answer_seed);
    const Rings a = with_holes(random, 6);
    const Rings b = scaled_and_moved(coast(random, 400, 0.5), 1.2, {0.6, -0.3});
    for (const double factor : {1e-12, 1e-6, 1e6, 1e11}) {
        SCOPED_TRACE(factor);
        check(scaled_and_moved(a, factor, {}), scaled_and_moved(b, factor, {}), 0.02 * factor);
    }
}

TEST_F(EveryAnswer, HoldsForAThousandParts) {
    Random random(every_answer_seed);
    Rings parts;
    for (int i = 0; i < 1000; ++i) {
        const Vector2 place{0.06 * (i % 40) - 1.2, 0.1 * (i / 40) - 1.2};
        parts.push_back(scaled_and_moved(star(random, 6, 0.5), 0.028, place)[0]);
    }
    check(parts, star(random, 30, 0.5), 0.01);
    check(star(random, 30, 0.5), parts, 0.01);
}

TEST_F(EveryAnswer, HoldsForDegeneratePolygons) {
    constexpr std::uint32_t cells = 40;
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), cells, every_answer_seed);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        check({shapes[i], shapes[(i + 5) % shapes.size()], {}, {{1.3, -0.7}, 0.1}, 0.7});
    }
}

// So many edges in a tile that it is left to the CPU, and so many boxes around each point that the
// device's walks give up.
TEST_F(EveryAnswer, HoldsForCrowds) {
    const NamedRings pentagons{"pentagons", nested_pentagons(260)};
    check({pentagons, pentagons, {}, {}, 0.4});
    check({pentagons, pentagons, {{0.3, 0.2}, 0.4}, {{-100.0, 3.0}, 2.0}, 0.4});
    NamedRings specks{"specks", {}};
    Random random(every_answer_seed);
    for (int i = 0; i < 400; ++i) {
        specks.rings.push_back(
            scaled_and_moved(regular(4), 0.001,
                             {random.between(-0.1, 0.1), random.between(-0.1, 0.1)})
                .front());
    }
    check({pentagons, specks, {}, {}, 0.4});
}

TEST_F(EveryAnswer, HoldsForSpikes) {
    NamedRings spikes{"spikes", {{}}};
    for (int i = 0; i < 1200; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 1200;
        const double radius = i % 2 == 0 ? 0.3 : 1.0;
        spikes.rings.front().push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    check({spikes, spikes, {}, {{0.3, 0.2}, 0.0}, 0.1});
}

TEST_F(EveryAnswer, HoldsForOutlines) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    ASSERT_GE(outlines.size(), 2U);
    check({outlines[0], outlines[1], {}, {{60.0, 30.0}, 0.4}, 2.0});
}

TEST_F(EveryAnswer, HoldsAroundTheSizeFromWhichThereIsATree) {
    Random random(every_answer_seed);
    for (const int n : {3, 63, 64, 65, 130}) {
        SCOPED_TRACE(n);
        const Rings a = star(random, n, 0.5);
        const Rings b = star(random, n, 0.6);
        check({{"A", a}, {"B", b}, {}, {{0.9, 0.4}, 0.3}, 0.02});
        check(scaled_and_moved(a, 0.1, {0.1, 0.1}), b, 0.02);
        check(a, scaled_and_moved(b, 0.1, {0.1, 0.1}), 0.02);
        check(a, a, 0.02);
    }
}

}  // namespace
}  // namespace nearfield::test
