#pragma once

#include <tests/oracle/boundary.hpp>
#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace nearfield::test {

using oracle::ShapeOracle;

/// The part of the error bound by which ContainmentTest may be wrong in favour of not inside.
inline constexpr double certain_part = 1.0 / 16.0;

/// A place on a shape's boundary as a result states it.
struct BoundaryPlace {
    Vector2 point;
    Feature feature;
};

class ContainmentQueries : public QueryTest {
protected:
    static ContainmentResult ask(const Instance& a, const Instance& b) {
        ContainmentResult result = run_alone(context(), ContainmentQuery{a, b});
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.technique, Technique::cpu);
        EXPECT_EQ(result.tolerance, 0.0);
        EXPECT_TRUE(result.regions.empty());
        return result;
    }
    static ContainmentResult ask(const Pair& pair) {
        const PlacedPair placed(context(), pair, Technique::cpu);
        return ask(placed.instance_a(), placed.instance_b());
    }

    /// Checks every member against the oracle.
    static ContainmentResult check(const Pair& pair) {
        const PlacedPair placed(context(), pair, Technique::cpu);
        const CorpusKeeper keeper(placed.pair(), placed.tolerance());
        SCOPED_TRACE(describe(placed.pair()));
        const ContainmentResult result = ask(placed.instance_a(), placed.instance_b());
        const double protrusion = oracle::protrusion(placed.a(), placed.b());
        if (protrusion <= certain_part * result.error_bound) {
            EXPECT_TRUE(result.inside) << "reaches out by " << protrusion;
        } else if (protrusion > result.error_bound) {
            EXPECT_FALSE(result.inside) << "reaches out by " << protrusion;
        }
        check_summary(placed, result);
        if (result.inside) {
            check_clearance(placed, result);
        } else {
            check_empty(result);
        }
        return result;
    }
    static ContainmentResult check(const Rings& a, const Rings& b) {
        return check(Pair{{"A", a}, {"B", b}, {}, {}, 0.1});
    }

    static void check_summary(const PlacedPair& placed, const ContainmentResult& result) {
        EXPECT_GE(result.error_bound, placed.rounding() / 16.0);
        EXPECT_LE(result.error_bound, 1e-13 * largest_coordinate_of(placed));
        const Truth meets = placed.intersects();
        EXPECT_TRUE(meets == Truth::too_close_to_call ||
                    result.intersects == (meets == Truth::yes));
        EXPECT_TRUE(result.intersects || !result.inside);
    }

    static double largest_coordinate_of(const PlacedPair& placed) {
        double most = 0.0;
        for (const auto& [shape, pose] : {std::pair{&placed.pair().a, placed.pair().pose_a},
                                          std::pair{&placed.pair().b, placed.pair().pose_b}}) {
            most = std::max({most, std::abs(pose.translation.x), std::abs(pose.translation.y)});
            for (const Ring& ring : shape->rings) {
                for (const Vector2& vertex : ring) {
                    most = std::max(most, oracle::length(vertex));
                }
            }
        }
        return 2.0 * most;
    }

    static void check_empty(const ContainmentResult& result) {
        EXPECT_EQ(result.clearance, 0.0);
        EXPECT_EQ(result.point_a, Vector2{});
        EXPECT_EQ(result.point_b, Vector2{});
        EXPECT_EQ(result.direction, Vector2{});
        EXPECT_TRUE(result.unique);
    }

    static void check_clearance(const PlacedPair& placed, const ContainmentResult& result) {
        const double bound = result.error_bound;
        const double truth = oracle::boundary_distance(placed.a(), placed.b());
        EXPECT_NEAR(result.clearance, truth, bound);
        EXPECT_NEAR(oracle::distance(result.point_a, result.point_b), result.clearance, bound);
        check_place(placed.a(), {result.point_a, result.feature_a}, result);
        check_place(placed.b(), {result.point_b, result.feature_b}, result);
        if (result.clearance == 0.0) {
            EXPECT_EQ(result.direction, Vector2{});
            EXPECT_TRUE(result.unique);
            return;
        }
        EXPECT_NEAR(oracle::length(result.direction), 1.0, 1e-12);
        const Vector2 way = oracle::minus(result.point_b, result.point_a);
        EXPECT_NEAR(oracle::dot(way, result.direction), result.clearance, bound);
        check_unique(placed, result);
    }

    /// The point lies on the boundary and, at a clearance, on the feature.
    static void check_place(const ShapeOracle& shape, const BoundaryPlace& place,
                            const ContainmentResult& result) {
        EXPECT_LE(shape.nearest(place.point).distance, result.error_bound);
        if (result.clearance == 0.0) {
            return;
        }
        ASSERT_LT(place.feature.index, shape.size());
        const double from_feature =
            place.feature.kind == Feature::Kind::vertex
                ? oracle::distance(shape.vertex(place.feature.index), place.point)
                : shape.nearest_on_edge(place.feature.index, place.point).distance;
        EXPECT_LE(from_feature, result.error_bound);
    }

    /// Segments that do not cross are closest at a vertex, so another closest pair has one.
    static void check_unique(const PlacedPair& placed, const ContainmentResult& result) {
        const double near = result.clearance + 2.0 * result.error_bound;
        double farthest = 0.0;  // of the rivals, from the pair
        const auto look = [&](const ShapeOracle& from, const Vector2& point_from,
                              const ShapeOracle& to, const Vector2& point_to) {
            for (std::uint32_t i = 0; i < from.size(); ++i) {
                const oracle::Nearest nearest = to.nearest(from.vertex(i));
                if (nearest.distance <= near) {
                    farthest = std::max({farthest, oracle::distance(from.vertex(i), point_from),
                                         oracle::distance(nearest.point, point_to)});
                }
            }
        };
        look(placed.a(), result.point_a, placed.b(), result.point_b);
        look(placed.b(), result.point_b, placed.a(), result.point_a);
        if (!result.unique) {
            EXPECT_GE(farthest, certain_part * result.error_bound);
        }
        // Pairs between the two margins may count or not; clear ones must.
        const bool is_symmetric_square =
            farthest > 1e-3 * result.clearance && count_exact_rivals(placed, result) > 1;
        EXPECT_FALSE(is_symmetric_square && result.unique);
    }

    /// Number of places, at least a thousandth of the clearance apart from each other, of vertices
    /// that are as close as the pair to within a fraction of the rounding.
    static int count_exact_rivals(const PlacedPair& placed, const ContainmentResult& result) {
        std::vector<Vector2> places;
        const auto look = [&](const ShapeOracle& from, const ShapeOracle& to) {
            for (std::uint32_t i = 0; i < from.size(); ++i) {
                const Vector2 vertex = from.vertex(i);
                const bool is_new =
                    std::none_of(places.begin(), places.end(), [&](const Vector2& known) {
                        return oracle::distance(known, vertex) < 1e-3 * result.clearance;
                    });
                if (is_new && to.nearest(vertex).distance <=
                                  result.clearance + certain_part * result.error_bound) {
                    places.push_back(vertex);
                }
            }
        };
        look(placed.a(), placed.b());
        return static_cast<int>(places.size());
    }

    /// A pair in which A is placed somewhere in the box of B.
    static Pair nested_pair(Random& random) {
        Pair pair = any_pair(random);
        const ShapeOracle a(pair.a.rings, {{}, pair.pose_a.angle});
        const ShapeOracle b(pair.b.rings, pair.pose_b);
        const double ratio = random.scale(0.003, 1.0);
        for (Ring& ring : pair.a.rings) {
            for (Vector2& vertex : ring) {
                vertex = oracle::times(vertex, ratio);
            }
        }
        const Rectangle box = b.box();
        const Vector2 to{random.between(box.min.x, box.max.x),
                         random.between(box.min.y, box.max.y)};
        pair.pose_a.translation = oracle::minus(to, oracle::times(a.origin(), ratio));
        return pair;
    }
};

}  // namespace nearfield::test
