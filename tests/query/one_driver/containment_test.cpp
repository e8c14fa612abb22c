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
namespace {

using oracle::ShapeOracle;

constexpr std::uint64_t seed = 2718;

/// The part of the error bound by which ContainmentTest may be wrong in favour of not inside.
constexpr double certain_part = 1.0 / 16.0;

/// A place on a shape's boundary as a result states it.
struct Place {
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
    static void check_place(const ShapeOracle& shape, const Place& place,
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

TEST_F(ContainmentQueries, HoldForRandomPairs) {
    int inside = 0;
    for_each_case(seed, 400,
                  [&](Random& random) { inside += check(nested_pair(random)).inside ? 1 : 0; });
    EXPECT_GT(inside, random_cases(400) / 20);
    EXPECT_LT(inside, random_cases(400) / 2);
}

TEST_F(ContainmentQueries, HoldForEveryFamilyInOthers) {
    const std::vector<NamedRings> shapes = every_family(seed);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const std::size_t apart : {1U, 4U, 6U}) {
            const NamedRings& a = shapes[i];
            const NamedRings& b = shapes[(i + apart) % shapes.size()];
            Pair pair{a, b, {{0.35, 0.1}, 0.7}, {{0.0, 0.0}, 0.2}, 0.01};
            check(pair);
            pair.a.rings = scaled_and_moved(pair.a.rings, 0.05, {});
            check(pair);
        }
    }
}

TEST_F(ContainmentQueries, HoldForDegenerateShapes) {
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), 24, seed);
    ASSERT_GE(shapes.size(), 6U);
    for (const NamedRings& shape : shapes) {
        EXPECT_TRUE(check(Pair{shape, shape, {}, {}, 0.1}).inside) << shape.name;
        check(Pair{shape, {"room", rectangle({-1, -1}, {25, 25})}, {}, {}, 0.1});
        check(Pair{{"box", rectangle({9.5, 9.5}, {14.25, 12.25})}, shape, {}, {}, 0.1});
        for (const NamedRings& other : shapes) {
            check(Pair{shape, other, {}, {}, 0.1});
        }
    }
}

/// Unions of the cells of a lattice, whose closed sets contain each other exactly if their cells
/// do: coincident edges, holes that are filled exactly, islands, corners that touch.
class Lattice {
public:
    static constexpr int side = 6;
    using Cells = std::set<std::pair<int, int>>;

    static Cells any(Random& random, double share) {
        Cells cells;
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) {
                if (random.between(0.0, 1.0) < share) {
                    cells.insert({x, y});
                }
            }
        }
        if (cells.empty()) {
            cells.insert({random.whole(0, side), random.whole(0, side)});
        }
        return cells;
    }

    /// Each cell a ring of its own, so that neighbours share edges.
    static Rings parcels(const Cells& cells) {
        Rings rings;
        for (const auto& [x, y] : cells) {
            rings.push_back(rectangle({1.0 * x, 1.0 * y}, {x + 1.0, y + 1.0})[0]);
        }
        return rings;
    }

    /// The boundary alone, with collinear vertices or without.
    static Rings outline(const Cells& cells, bool joins_collinear) {
        // From each lattice point the directed edges that have a cell on the left only.
        std::multimap<std::pair<int, int>, std::pair<int, int>> edges;
        const auto add = [&](int x, int y, int dx, int dy, std::pair<int, int> beyond) {
            if (!cells.contains(beyond)) {
                edges.insert({{x, y}, {x + dx, y + dy}});
            }
        };
        for (const auto& [x, y] : cells) {
            add(x, y, 1, 0, {x, y - 1});
            add(x + 1, y, 0, 1, {x + 1, y});
            add(x + 1, y + 1, -1, 0, {x, y + 1});
            add(x, y + 1, 0, -1, {x - 1, y});
        }
        Rings rings;
        while (!edges.empty()) {
            Ring ring;
            const auto first = edges.begin()->first;
            std::pair<int, int> at = first;
            do {
                ring.push_back({1.0 * at.first, 1.0 * at.second});
                const auto next = edges.find(at);
                at = next->second;
                edges.erase(next);
            } while (at != first);
            rings.push_back(joins_collinear ? without_collinear(ring) : ring);
        }
        return rings;
    }

    static Rings any_rings(Random& random, const Cells& cells) {
        const int style = random.whole(0, 3);
        return style == 0 ? parcels(cells) : outline(cells, style == 1);
    }

private:
    static Ring without_collinear(const Ring& ring) {
        Ring corners;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& before = ring[(i + ring.size() - 1) % ring.size()];
            const Vector2& after = ring[(i + 1) % ring.size()];
            if (oracle::orientation(before, ring[i], after) != 0.0L) {
                corners.push_back(ring[i]);
            }
        }
        return corners;
    }
};

TEST_F(ContainmentQueries, OfCellsIsThatOfTheirSets) {
    int inside = 0;
    int clear = 0;
    for_each_case(seed, 1500, [&](Random& random) {
        const Lattice::Cells in_b = Lattice::any(random, random.between(0.3, 0.98));
        Lattice::Cells in_a = Lattice::any(random, random.between(0.02, 0.5));
        const double part = random.whole(0, 2) == 0 ? 1.0 : 1.0 / 3.0;  // side of A's cells
        const int per_cell = part == 1.0 ? 1 : 3;
        const int offset = part == 1.0 ? 0 : random.whole(0, 13);
        // Usually A loses what would stick out, but often a single cell is left.
        bool keeps_one = random.whole(0, 2) == 0;
        const auto is_in_b = [&](const std::pair<int, int>& cell) {
            return in_b.contains(
                {(cell.first + offset) / per_cell, (cell.second + offset) / per_cell});
        };
        for (auto cell = in_a.begin(); cell != in_a.end();) {
            const bool stays = is_in_b(*cell) || std::exchange(keeps_one, false);
            cell = stays ? std::next(cell) : in_a.erase(cell);
        }
        if (in_a.empty()) {
            in_a.insert({0, 0});
        }
        const bool truth = std::all_of(in_a.begin(), in_a.end(), is_in_b);
        const Pose pose{{random.between(-9.0, 9.0), random.between(-9.0, 9.0)},
                        random.whole(0, 2) == 0 ? 0.0 : random.between(-4.0, 4.0)};
        Pair pair{{"A", Lattice::any_rings(random, in_a)},
                  {"B", Lattice::any_rings(random, in_b)},
                  pose,
                  pose,
                  0.1};
        pair.a.rings = scaled_and_moved(pair.a.rings, part, {offset * part, offset * part});
        const ContainmentResult result = check(pair);
        EXPECT_EQ(result.inside, truth) << describe(pair);
        inside += result.inside ? 1 : 0;
        clear += result.clearance > 0.0 ? 1 : 0;
    });
    EXPECT_GT(inside, random_cases(1500) / 5);
    EXPECT_LT(inside, random_cases(1500) * 4 / 5);
    EXPECT_GT(clear, random_cases(1500) / 100);
}

TEST_F(ContainmentQueries, OfKnownShapes) {
    const Rings room = rectangle({0, 0}, {10, 10});
    ContainmentResult result = check(rectangle({2, 3}, {4, 6}), room);
    EXPECT_TRUE(result.inside);
    EXPECT_EQ(result.clearance, 2.0);
    EXPECT_NEAR(result.direction.x, -1.0, 1e-15);
    EXPECT_NEAR(result.direction.y, 0.0, 1e-15);
    EXPECT_EQ(result.feature_b.index, 3U);
    EXPECT_FALSE(result.unique);  // the whole left side is as near
    result = check(Rings{{{2, 5}, {5, 3}, {6, 6}}}, room);
    EXPECT_TRUE(result.unique);
    EXPECT_EQ(result.feature_a.kind, Feature::Kind::vertex);
    EXPECT_EQ(result.feature_a.index, 0U);
    EXPECT_EQ(result.point_b, (Vector2{0.0, 5.0}));
    // The boundary of a hole counts, also of one that A surrounds with a larger hole.
    const Rings frame{room[0], rectangle({4, 4}, {6, 6})[0]};
    EXPECT_EQ(check(rectangle({1.5, 1.5}, {3, 5}), frame).clearance, 1.0);
    EXPECT_EQ(
        check(Rings{rectangle({1, 1}, {9, 9})[0], rectangle({3.5, 3.5}, {6.5, 6.5})[0]}, frame)
            .clearance,
        0.5);
    EXPECT_FALSE(check(rectangle({1, 1}, {9, 9}), frame).inside);
    result = check(rectangle({0, 2}, {3, 3}), room);
    EXPECT_TRUE(result.inside);
    EXPECT_EQ(result.clearance, 0.0);
    EXPECT_EQ(result.point_a.x, 0.0);
    // An island in a hole.
    const Rings target{room[0], frame[1], rectangle({4.5, 4.5}, {5.5, 5.5})[0]};
    EXPECT_NEAR(check(rectangle({4.75, 4.75}, {5, 5}), target).clearance, 0.25, 1e-15);
    EXPECT_FALSE(check(rectangle({4.1, 4.1}, {4.4, 4.4}), target).inside);
}

TEST_F(ContainmentQueries, RigidMotionsOfBothLeaveTheAnswer) {
    for_each_case(seed + 1, 150, [&](Random& random) {
        const Pair pair = nested_pair(random);
        const ContainmentResult rest = ask(pair);
        const double angle = random.between(-4.0, 4.0);
        const Vector2 by{random.between(-30.0, 30.0), random.between(-30.0, 30.0)};
        const auto moved = [&](const Pose& pose) {
            const auto& [x, y] = pose.translation;
            return Pose{{std::cos(angle) * x - std::sin(angle) * y + by.x,
                         std::sin(angle) * x + std::cos(angle) * y + by.y},
                        pose.angle + angle};
        };
        Pair turned = pair;
        turned.pose_a = moved(pair.pose_a);
        turned.pose_b = moved(pair.pose_b);
        const ContainmentResult other = ask(turned);
        const double bound = 4.0 * (rest.error_bound + other.error_bound);
        if (rest.inside && rest.clearance > bound) {
            EXPECT_TRUE(other.inside) << describe(pair);
            EXPECT_NEAR(other.clearance, rest.clearance, bound) << describe(pair);
        } else if (other.inside) {
            EXPECT_LE(other.clearance, bound) << describe(pair);
        }
    });
}

TEST_F(ContainmentQueries, StarsLieInGrownCopiesAndNotInShrunkOnes) {
    for_each_case(seed + 2, 40, [&](Random& random) {
        const Rings shape = star(random, random.whole(3, 300), random.between(0.1, 0.9));
        const Pose pose{{random.between(-9.0, 9.0), random.between(-9.0, 9.0)},
                        random.between(-4.0, 4.0)};
        const auto in_copy = [&](double factor) {
            return check(
                Pair{{"A", shape}, {"B", scaled_and_moved(shape, factor, {})}, pose, pose, 0.1});
        };
        const ContainmentResult same = in_copy(1.0);
        EXPECT_TRUE(same.inside);
        EXPECT_EQ(same.clearance, 0.0);
        double last = 0.0;
        for (const double growth : {1e-9, 1e-3, 0.1, 1.0}) {
            const ContainmentResult grown = in_copy(1.0 + growth);
            EXPECT_TRUE(grown.inside);
            EXPECT_GT(grown.clearance, last);
            EXPECT_LE(grown.clearance, growth * (1.0 + 1e-9) + grown.error_bound);
            last = grown.clearance;
            EXPECT_FALSE(in_copy(1.0 / (1.0 + growth)).inside);
        }
    });
}

TEST_F(ContainmentQueries, AShapeIsInItselfHoweverItsEdgesAreDivided) {
    for_each_case(seed + 5, 400, [&](Random& random) {
        Pair pair = any_pair(random);
        pair.b.rings = with_collinear_runs(random, pair.a.rings, random.between(0.1, 1.0));
        pair.pose_b = pair.pose_a;
        EXPECT_TRUE(ask(pair).inside) << describe(pair);
        std::swap(pair.a, pair.b);
        EXPECT_TRUE(ask(pair).inside) << describe(pair);
    });
}

TEST_F(ContainmentQueries, ClearanceIsHowFarAMayGo) {
    int tried = 0;
    for_each_case(seed + 3, 300, [&](Random& random) {
        Pair pair = nested_pair(random);
        const Pose start = pair.pose_a;
        const ContainmentResult rest = ask(pair);
        if (!rest.inside || rest.clearance < 1e-6) {
            return;
        }
        ++tried;
        const auto moved_by = [&](const Vector2& way) {
            pair.pose_a = {oracle::plus(start.translation, way), start.angle};
            return ask(pair);
        };
        const double angle = random.between(-4.0, 4.0);
        const Vector2 anywhere{std::cos(angle), std::sin(angle)};
        EXPECT_TRUE(moved_by(oracle::times(anywhere, 0.999 * rest.clearance)).inside)
            << describe(pair);
        // Towards B's boundary it arrives there.
        const ContainmentResult nearer =
            moved_by(oracle::times(rest.direction, 0.75 * rest.clearance));
        EXPECT_TRUE(nearer.inside) << describe(pair);
        EXPECT_NEAR(nearer.clearance, 0.25 * rest.clearance,
                    4.0 * (rest.error_bound + nearer.error_bound))
            << describe(pair);
    });
    EXPECT_GT(tried, random_cases(300) / 30);
}

TEST_F(ContainmentQueries, AreTransitiveAndClearancesAddUp) {
    for_each_case(seed + 4, 100, [&](Random& random) {
        const Rings inner = star(random, random.whole(3, 60), 0.3);
        const Rings middle =
            scaled_and_moved(star(random, random.whole(3, 60), 0.6), random.scale(1.0, 8.0), {});
        const Rings outer =
            scaled_and_moved(star(random, random.whole(3, 60), 0.6), random.scale(4.0, 40.0), {});
        const ContainmentResult first = check(inner, middle);
        const ContainmentResult second = check(middle, outer);
        if (first.inside && second.inside) {
            const ContainmentResult both = check(inner, outer);
            EXPECT_TRUE(both.inside);
            EXPECT_GE(both.clearance + both.error_bound + first.error_bound + second.error_bound,
                      first.clearance + second.clearance);
        }
    });
}

TEST_F(ContainmentQueries, OfOutlines) {
    for (const NamedRings& outline : read_outlines(NEARFIELD_TEST_DATA)) {
        Pair pair{outline, outline, {{}, 0.4}, {{}, 0.4}, 0.5};
        const ContainmentResult self = ask(pair);
        EXPECT_TRUE(self.inside) << outline.name;
        EXPECT_EQ(self.clearance, 0.0);
        pair.pose_a.translation.x += 1e-3;
        EXPECT_FALSE(ask(pair).inside) << outline.name;
        const Rectangle box = ShapeOracle(outline.rings).box();
        pair = {outline, {"box", rectangle(oracle::minus(box.min, {1, 2}), box.max)}, {}, {}, 0.5};
        EXPECT_EQ(check(pair).clearance, 0.0);
        pair.b.rings = rectangle(oracle::minus(box.min, {1, 2}), oracle::plus(box.max, {3, 4}));
        EXPECT_NEAR(check(pair).clearance, 1.0, 1e-9);
    }
}

TEST_F(ContainmentQueries, RefuseWhatTheyCannotUse) {
    const PlacedPair pair(
        context(),
        {{"A", rectangle({0, 0}, {1, 1})}, {"B", rectangle({0, 0}, {1, 1})}, {}, {}, 0.1});
    for (const Technique technique : {Technique::raster, Technique::compute}) {
        const Status status =
            run_alone(context(), ContainmentQuery{pair.instance_a(), pair.instance_b(), technique})
                .status;
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find(std::string(to_string(technique)) +
                                        " does not answer containment"),
                  std::string::npos)
            << status.text();
    }
    ContainmentQuery query{pair.instance_a(), pair.instance_b(), Technique::cpu};
    EXPECT_TRUE(run_alone(context(), query).inside);
    query.b.pose.translation.y = std::numeric_limits<double>::infinity();
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::invalid_query);
    query.b = {};
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::unknown_shape);
}

}  // namespace
}  // namespace nearfield::test
