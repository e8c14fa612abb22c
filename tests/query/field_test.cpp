#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/field_laws.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t field_seed = 90210;

/// Fields by every technique: by the raster, by the CPU, and by compute, which lists the edges near
/// each block by one thread on devices that run on the CPU, and by workgroups on others. The device
/// of other() claims to be of the other kind.
class Field : public FieldLaws {
protected:
    void SetUp() override {
        test_support::Lies lies;
        lies.properties = [](VkPhysicalDeviceProperties& properties) {
            properties.deviceType = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
                                        ? VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU
                                        : VK_PHYSICAL_DEVICE_TYPE_CPU;
        };
        loader_.emplace(host_device(), std::move(lies));
        Expected<Context> made = Context::create(loader_->host(), on_demand());
        ASSERT_TRUE(made.has_value()) << made.error().text();
        other_.emplace(std::move(*made));
    }
    void TearDown() override {
        other_.reset();
        loader_.reset();
        FieldLaws::TearDown();
    }
    [[nodiscard]] Context& other() { return *other_; }

    /// Checks the field of a shape over a rectangle; returns that of the first technique.
    DistanceFieldResult check(const Rings& rings, const Pose& pose, double tolerance,
                              const Rectangle& rectangle, bool features = false) {
        SCOPED_TRACE(to_text(rings) + " d = " + std::to_string(tolerance));
        const PlacedShape shape(context(), rings, pose);
        const PlacedShape others(other(), rings, pose);
        DistanceFieldQuery query{.b = shape.instance(), .tolerance = tolerance};
        query.rectangle = rectangle;
        query.features = query.gradients = features;
        std::vector<DistanceFieldResult> results;
        for (const Technique technique : every_technique) {
            query.technique = technique;
            results.push_back(run_alone(context(), query));
            EXPECT_EQ(results.back().technique, technique);
        }
        const DistanceFieldResult computed = results[device_techniques.size() - 1];
        query.technique = Technique::compute;
        query.b = others.instance();
        results.insert(results.begin(), run_alone(other(), query));
        check_same(computed, results.front());
        for (const DistanceFieldResult& result : results) {
            SCOPED_TRACE(to_string(result.technique));
            const bool is_first = &result == &results[1];
            check_field(shape.oracle(), tolerance, result, is_first ? 20000 : 2000);
            check_covers(result, rectangle);
            check_agree(result, results.back());
            if (features) {
                check_cells(shape.oracle(), query, result, 500);
            }
        }
        return results[1];
    }
    /// Both ways to list edges find the same but for roundings.
    static void check_same(const DistanceFieldResult& expected, const DistanceFieldResult& result) {
        ASSERT_TRUE(expected.status.ok()) << expected.status.text();
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        ASSERT_EQ(result.values.size(), expected.values.size());
        Report report("values by other lists");
        for (std::size_t i = 0; i < result.values.size(); ++i) {
            const float most =
                1e-5F * std::max(std::abs(expected.values[i]), static_cast<float>(result.cell));
            report.require(std::abs(result.values[i] - expected.values[i]) <= most, "cell ", i,
                           ": ", result.values[i], " and ", expected.values[i]);
        }
    }
    /// Expects the same grid, values within the sum of both bounds, and equal signs unless a value
    /// is near 0.
    static void check_agree(const DistanceFieldResult& raster, const DistanceFieldResult& exact) {
        ASSERT_TRUE(raster.status.ok() && exact.status.ok());
        EXPECT_EQ(raster.origin, exact.origin);
        EXPECT_EQ(raster.cell, exact.cell);
        ASSERT_EQ(raster.width, exact.width);
        ASSERT_EQ(raster.height, exact.height);
        ASSERT_EQ(raster.values.size(), exact.values.size());
        EXPECT_LE(exact.error_bound, raster.error_bound);
        Report report("two techniques");
        const double most = (raster.error_bound + exact.error_bound) * (1 + 1e-6);
        for (std::size_t i = 0; i < exact.values.size(); ++i) {
            const auto drawn = static_cast<double>(raster.values[i]);
            const auto value = static_cast<double>(exact.values[i]);
            report.require(std::abs(drawn - value) <= most, "cell ", i, " is ", drawn, " and ",
                           value);
            report.require((drawn < 0.0) == (value < 0.0) || std::abs(value) <= most, "cell ", i,
                           " is ", drawn, " and ", value);
        }
    }

    /// Expects the same bits each time.
    void check_repeats(const Rings& rings, double tolerance, bool features) {
        const PlacedShape shape(other(), rings, {});
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = tolerance;
        query.rectangle = Rectangle{{-1.5, -1.4}, {1.4, 1.5}};
        query.features = query.gradients = features;
        query.technique = Technique::compute;
        const DistanceFieldResult first = run_alone(other(), query);
        EXPECT_TRUE(first.status.ok()) << first.status.text();
        for (int i = 0; i < 5; ++i) {
            const DistanceFieldResult next = run_alone(other(), query);
            EXPECT_EQ(next.values, first.values);
            EXPECT_TRUE(std::equal(next.features.begin(), next.features.end(),
                                   first.features.begin(), first.features.end(),
                                   [](const Feature& a, const Feature& b) {
                                       return a.kind == b.kind && a.index == b.index;
                                   }));
            EXPECT_EQ(next.gradients, first.gradients);
            EXPECT_EQ(next.unique, first.unique);
        }
    }

    /// Expects features that are as near as the nearest one, within what is promised.
    static void check_features(const oracle::ShapeOracle& b, const DistanceFieldResult& result) {
        Report report("features");
        const double allowed = result.tolerance / 1000.0 + 4.0 * b.rounding();
        for (std::size_t i = 0; i < result.features.size(); ++i) {
            const auto column = static_cast<double>(i % result.width);
            const auto row = static_cast<double>(i / result.width);
            const Vector2 centre{result.origin.x + (column + 0.5) * result.cell,
                                 result.origin.y + (row + 0.5) * result.cell};
            const Feature feature = result.features[i];
            const Vector2 vertex = b.vertex(feature.index);
            const double distance = feature.kind == Feature::Kind::vertex
                                        ? std::hypot(centre.x - vertex.x, centre.y - vertex.y)
                                        : b.nearest_on_edge(feature.index, centre).distance;
            const double truth = b.nearest(centre).distance;
            report.require(distance <= truth + allowed, "cell ", i, ": the feature is ", distance,
                           " away, the boundary ", truth);
        }
    }

    /// Expects a grid that starts at the rectangle's low corner, covers it and has no superfluous
    /// cells.
    static void check_covers(const DistanceFieldResult& result, const Rectangle& rectangle) {
        const double allowed =
            1e-6 * result.cell + 1e-12 * (std::abs(rectangle.max.x) + std::abs(rectangle.max.y));
        EXPECT_NEAR(result.origin.x, rectangle.min.x, allowed);
        EXPECT_NEAR(result.origin.y, rectangle.min.y, allowed);
        const double right = result.origin.x + result.width * result.cell;
        const double top = result.origin.y + result.height * result.cell;
        EXPECT_GE(right, rectangle.max.x - allowed);
        EXPECT_GE(top, rectangle.max.y - allowed);
        EXPECT_LE(right - result.cell, rectangle.max.x + allowed);
        EXPECT_LE(top - result.cell, rectangle.max.y + allowed);
    }

private:
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> other_;
};

TEST_F(Field, HoldsForRandomShapes) {
    for_each_case(field_seed, 50, [&](Random& random) {
        const Pair pair = any_pair(random);
        const Rectangle box = oracle::ShapeOracle(pair.b.rings, pair.pose_b).box();
        const double size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        const Vector2 low{box.min.x + size * random.between(-0.5, 0.8),
                          box.min.y + size * random.between(-0.5, 0.8)};
        const Vector2 high{low.x + size * random.scale(0.02, 1.5),
                           low.y + size * random.scale(0.02, 1.5)};
        check(pair.b.rings, pair.pose_b, size * random.scale(0.004, 0.2), {low, high},
              random.whole(0, 2) == 0);
    });
}

TEST_F(Field, HoldsForEveryFamily) {
    for (const auto& [name, rings] : every_family(field_seed)) {
        SCOPED_TRACE(name);
        check(rings, {{0.5, -0.25}, 0.9}, 0.02, {{-1.0, -1.5}, {2.0, 1.0}});
        check(rings, {{1e6, -1e6}, 0.4}, 0.03, {{1e6 - 1.3, -1e6 - 1.2}, {1e6 + 1.2, -1e6 + 1.3}});
        check(rings, {}, 0.06, {{-1.3, -1.2}, {1.2, 1.3}}, true);
    }
}

/// Vertices on samples and on rows of samples, slivers, folds.
TEST_F(Field, HoldsForDegenerateShapes) {
    constexpr std::uint32_t cells = 40;
    for (const auto& [name, rings] : degenerate_shapes(context(), cells, field_seed)) {
        SCOPED_TRACE(name);
        for (const bool features : {false, true}) {
            check(rings, {}, 1.0 / std::numbers::sqrt2, {{0, 0}, {cells, cells}}, features);
        }
    }
}

/// Of several levels of boxes, and several rounds of each list.
TEST_F(Field, HoldsForLargeShapes) {
    Random random(field_seed);
    for (const int vertices : {600, 9000, 60000}) {
        check(coast(random, vertices, 0.6), {}, 0.013, {{-1.5, -1.4}, {1.4, 1.5}});
    }
    check(coast(random, 9000, 0.8), {}, 0.03, {{-1.5, -1.4}, {1.4, 1.5}}, true);
    // So dense that only the outer edges are ever nearest.
    check(star(random, 5000, 0.2), {}, 0.02, {{-1.1, -1.2}, {1.2, 1.1}}, true);
    // Around its centre all edges of a circle are about equally near.
    check(regular(500), {}, 0.002, {{-0.04, -0.03}, {0.03, 0.05}}, true);
    for (const NamedRings& outline : read_outlines(NEARFIELD_TEST_DATA)) {
        SCOPED_TRACE(outline.name);
        const Rectangle box = oracle::ShapeOracle(outline.rings, {}).box();
        const double d = std::max(box.max.x - box.min.x, box.max.y - box.min.y) / 150.0;
        check(outline.rings, {}, d, box);
        check(outline.rings, {}, 4.0 * d, box, true);
    }
}

TEST_F(Field, HoldsWhateverIsLeftOfTheLastBlock) {
    Random random(field_seed);
    const Rings shape = coast(random, 300, 0.5);
    const double d = 0.01;
    const double cell = d * std::numbers::sqrt2;
    for (const int columns : {1, 7, 8, 9, 15, 16, 17, 24, 33, 47, 49, 65}) {
        const int rows = random.whole(1, 70);
        SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
        const Vector2 low{random.between(-1.0, 0.5), random.between(-1.0, 0.5)};
        check(shape, {}, d, {low, {low.x + (columns - 0.5) * cell, low.y + (rows - 0.5) * cell}},
              columns % 3 == 0);
    }
}

TEST_F(Field, HoldsFarAwayAndBeyondATile) {
    Random random(field_seed);
    const Rings shape = scaled_and_moved(star(random, 12, 0.3), 20.0, {});
    const double d = 1.0 / (150.0 * std::numbers::sqrt2);  // 150 cells per unit
    const auto wide = check(shape, {}, d, {{-20.0, 3.0}, {20.0, 3.05}});
    EXPECT_GT(wide.width, 5900U);
    const auto high = check(shape, {}, d, {{-0.03, -20.0}, {0.03, 20.0}});
    EXPECT_GT(high.height, 5900U);
    check(shape, {}, 0.5, {{500.0, -600.0}, {540.0, -580.0}});
    check(shape, {}, 0.5, {{500.0, -600.0}, {520.0, -590.0}}, true);
}

TEST_F(Field, HoldsForTinyAndHugeTolerances) {
    Random random(field_seed);
    const Rings shape = star(random, 40, 0.4);
    const auto one = check(shape, {}, 100.0, {{-1, -1}, {1, 1}});
    EXPECT_EQ(one.values.size(), 1U);
    check(shape, {}, 1e-5, {{0.5, 0.5}, {0.5005, 0.5008}}, true);
    // Around a vertex of a shape of 10^8 cells.
    const Vector2 vertex = shape[0][3];
    for (const bool features : {false, true}) {
        check(shape, {}, 1e-8,
              {{vertex.x - 1e-6, vertex.y - 7e-7}, {vertex.x + 9e-7, vertex.y + 8e-7}}, features);
    }
    check(shape, {}, 0.05, {{30.0, -40.0}, {32.0, -38.0}});  // far outside
    check(scaled_and_moved(shape, 1e-3, {}), {{1e6, 1e6}, 0.3}, 2e-5,
          {{1e6 - 1e-3, 1e6 - 1e-3}, {1e6 + 1e-3, 1e6 + 1e-3}});
    for (const double factor : {1e-12, 1e7, 1e11}) {
        check(scaled_and_moved(shape, factor, {}), {}, 0.01 * factor,
              {{-factor, -factor}, {factor, factor}}, factor < 1.0);
    }
}

/// Along the axes the sine of such a turn is 0.0 or -0.0: spikes without a width, and a hole of
/// which simplification leaves two edges, there and back.
TEST_F(Field, HoldsWhereBoundariesTurnBack) {
    const Ring spikes{{-0.5, -0.5}, {0.0, -0.5}, {0.0, -1.0}, {0.0, -0.5}, {0.5, -0.5}, {0.5, 0.0},
                      {1.0, 0.0},   {0.5, 0.0},  {0.5, 0.5},  {0.0, 0.5},  {0.0, 1.0},  {0.0, 0.5},
                      {-0.5, 0.5},  {-0.5, 0.0}, {-1.0, 0.0}, {-0.5, 0.0}};
    check({spikes}, {}, 0.05, {{-2.0, -2.0}, {2.0, 2.0}});
    const double small = 0.001;
    check({rectangle({-2.0, -2.0}, {2.0, 2.0}).front(),
           rectangle({-small, -small}, {small, small}).front()},
          {}, 0.05, {{-1.0, -1.0}, {1.0, 1.0}});
}

TEST_F(Field, CoversWhatTheBoxesShare) {
    const int cases = random_cases(60);
    for (int i = 0; i < cases; ++i) {
        Random random(field_seed + 100 + static_cast<std::uint64_t>(i));
        const PlacedPair pair(context(), any_pair(random));
        SCOPED_TRACE("seed " + std::to_string(field_seed) + " case " + std::to_string(i) + '\n' +
                     describe(pair.pair()));
        DistanceFieldQuery query;
        query.technique = Technique::raster;
        query.a = pair.instance_a();
        query.b = pair.instance_b();
        query.tolerance = pair.tolerance();
        const DistanceFieldResult result = run_alone(context(), query);
        const Rectangle a = pair.a().box();
        const Rectangle b = pair.b().box();
        const Rectangle common{{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
                               {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
        const double d = pair.tolerance();
        if (common.max.x < common.min.x - 2 * d || common.max.y < common.min.y - 2 * d) {
            EXPECT_EQ(result.status.code(), StatusCode::invalid_query) << result.status.text();
            continue;
        }
        if (common.min.x <= common.max.x && common.min.y <= common.max.y) {
            check_field(pair.b(), d, result);
            check_covers(result, {{common.min.x - d, common.min.y - d},
                                  {common.max.x + d, common.max.y + d}});
            query.technique = Technique::cpu;
            const DistanceFieldResult exact = run_alone(context(), query);
            EXPECT_EQ(exact.intersects, result.intersects);
            check_agree(result, exact);
        }
    }
}

/// Beside edges of millions of cells, at their vertices and in between.
TEST_F(Field, HoldsBesideLongEdges) {
    for_each_case(field_seed + 700, 4, [&](Random& random) {
        const Rings rings = star(random, 5, 0.5);
        const Expected<ShapeHandle> shape = context().add_shape(rings);
        ASSERT_TRUE(shape.has_value()) << shape.error().text();
        const oracle::ShapeOracle truth(rings);
        for (const double d : {1e-5, 1e-7, 1e-9, 1e-11}) {
            const auto edge = static_cast<std::uint32_t>(random.whole(0, 4));
            const Vector2 from = truth.vertex(edge);
            const Vector2 to = truth.vertex(truth.next(edge));
            const double t = random.between(0.0, 1.0) < 0.5 ? 1.0 : random.between(0.0, 1.0);
            const Vector2 p{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
            DistanceFieldQuery query{.b = {*shape, {}},
                                     .tolerance = d,
                                     .rectangle = Rectangle{{p.x - 40.0 * d, p.y - 30.0 * d},
                                                            {p.x + 50.0 * d, p.y + 60.0 * d}}};
            for (const Technique technique : every_technique) {
                SCOPED_TRACE(to_text(rings) + " by " + to_string(technique));
                query.technique = technique;
                query.features = false;
                check_field(truth, d, run_alone(context(), query));
                query.features = true;
                const DistanceFieldResult result = run_alone(context(), query);
                check_field(truth, d, result);
                check_features(truth, result);
            }
        }
        EXPECT_TRUE(context().remove_shape(*shape).ok());
    });
}

/// At a corner the gradient is the outward normal of one of its edges, whichever way round.
TEST_F(Field, GradientsAtCornersPointOut) {
    for (Ring ring : {Ring{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, Ring{{0, 1}, {2, 0}, {2, 2}}}) {
        const Vector2 middle = ring.size() == 4 ? Vector2{1.5, 1.5} : Vector2{4.0 / 3.0, 1.0};
        for (int turn = 0; turn < 2; ++turn) {
            std::reverse(ring.begin(), ring.end());
            const Expected<ShapeHandle> shape = context().add_shape(Rings{ring});
            ASSERT_TRUE(shape.has_value()) << shape.error().text();
            DistanceFieldQuery query{.b = {*shape, {}},
                                     .tolerance = 0.1,
                                     .rectangle = Rectangle{{-1.0, -1.0}, {4.0, 4.0}},
                                     .gradients = true};
            query.points = ring;
            for (const Technique technique : every_technique) {
                query.technique = technique;
                const DistanceFieldResult result = run_alone(context(), query);
                ASSERT_EQ(result.points.size(), ring.size());
                for (const FieldPoint& corner : result.points) {
                    const Vector2 out{corner.position.x - middle.x, corner.position.y - middle.y};
                    EXPECT_GT(corner.gradient.x * out.x + corner.gradient.y * out.y, 0.1)
                        << to_string(technique) << ", turn " << turn << ", corner ("
                        << corner.position.x << ", " << corner.position.y << ")";
                }
            }
            EXPECT_TRUE(context().remove_shape(*shape).ok());
        }
    }
}

/// The CPU's answer does not depend on the query's options: with features it measures to the
/// shape's own edges, with differences over a larger grid.
TEST_F(Field, OfTheCpuSaysTheSameHoweverItIsAsked) {
    Random random(field_seed);
    const Rings rings = coast(random, 2000, 0.5);
    const oracle::ShapeOracle oracle(rings, {});
    const ShapeHandle shape = *context().add_shape(rings);
    DistanceFieldQuery query;
    query.b = {shape, {}};
    query.tolerance = 0.01;
    query.rectangle = {{-1.3, -1.1}, {1.2, 1.25}};
    query.technique = Technique::cpu;
    const DistanceFieldResult values = run_alone(context(), query);
    check_field(oracle, query.tolerance, values, 5000);
    query.features = true;
    const DistanceFieldResult exact = run_alone(context(), query);
    check_field(oracle, query.tolerance, exact, 5000);
    EXPECT_LT(exact.error_bound, 0.002 * query.tolerance);
    check_agree(values, exact);
    query.features = false;
    query.gradients = true;
    query.gradient = GradientMethod::central_differences;
    const DistanceFieldResult differences = run_alone(context(), query);
    check_field(oracle, query.tolerance, differences, 5000);
    EXPECT_NEAR(values.error_bound, differences.error_bound, 1e-3 * query.tolerance);
    EXPECT_TRUE(context().remove_shape(shape).ok());
}

TEST_F(Field, FarInsideIsDeepNegative) {
    const auto result = check(rectangle({-100, -100}, {100, 100}), {}, 0.5, {{-3, -3}, {3, 3}});
    for (const float value : result.values) {
        EXPECT_LT(value, -96.0F);
    }
}

TEST_F(Field, OfListsIsTheSameEveryTime) {
    Random random(field_seed);
    check_repeats(coast(random, 6000, 0.5), 0.01, false);
    check_repeats(coast(random, 2000, 0.5), 0.03, true);
    check_repeats(star(random, 50, 0.4), 0.02, true);
}

TEST_F(Field, HoldsWhereListsHaveNoRoom) {
    // A region without room; a quarter without; blocks with more edges than a workgroup lists.
    check(regular(8000), {}, 0.002, {{-0.04, -0.03}, {0.03, 0.05}}, false);
    for (const int teeth : {100, 250, 400, 600}) {
        Ring comb;
        for (int i = 0; i < teeth; ++i) {
            comb.push_back({i * 20.0 / teeth, i % 2 == 0 ? 0.0 : 10.0});
        }
        comb.push_back({20.0, -1.0});
        comb.push_back({0.0, -1.0});
        check({comb}, {{0.3, 0.2}, 0.1}, 0.5, {{-3, -3}, {16, 10}}, true);
    }
}

TEST_F(Field, HoldsForManyRings) {
    Rings crowd;
    constexpr int across = 90;
    for (int i = 0; i < across * across; ++i) {
        const Vector2 low{(i % across) / 100.0 - 0.5,
                          static_cast<double>(i / across) / 100.0 - 0.5};
        crowd.push_back(
            {low, {low.x + 1e-4, low.y}, {low.x + 1e-4, low.y + 1e-4}, {low.x, low.y + 1e-4}});
    }
    check(crowd, {}, 0.01, {{-0.7, -0.6}, {0.5, 0.5}}, true);
    check(crowd, {}, 0.05, {{-0.7, -0.6}, {0.5, 0.5}}, false);
    // Nested squares, each of four long edges.
    Rings nested;
    for (int i = 1; i <= 400; ++i) {
        const double side = i / 400.0;
        nested.push_back({{-side, -side}, {side, -side}, {side, side}, {-side, side}});
    }
    check(nested, {{}, 0.3}, 0.02, {{-1.2, -1.2}, {1.2, 1.2}}, true);
}

}  // namespace
}  // namespace nearfield::test
