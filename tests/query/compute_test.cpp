#include <tests/query/field_laws.hpp>
#include <tests/support/degenerate_polygons.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t compute_seed = 3141;

std::vector<Vector2> points_in(Random& random, const Rectangle& box, int count) {
    std::vector<Vector2> points{box.min, box.max, {box.min.x, box.max.y}};
    for (int i = 0; i < count; ++i) {
        points.push_back(
            {random.between(box.min.x, box.max.x), random.between(box.min.y, box.max.y)});
    }
    return points;
}

/// Distance fields by the compute technique, compared with the oracle and, except near the
/// boundary, with the raster's signs.
class ComputeFields : public FieldLaws {
protected:
    static void check(Context& context, const oracle::ShapeOracle& b, DistanceFieldQuery query) {
        query.technique = Technique::raster;
        const DistanceFieldResult drawn = run_alone(context, query);
        query.technique = Technique::compute;
        const DistanceFieldResult result = run_alone(context, query);
        EXPECT_EQ(result.technique, Technique::compute);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        ASSERT_EQ(drawn.values.size(), result.values.size());
        Report report("signs of raster and compute");
        for (std::size_t i = 0; i < drawn.values.size(); ++i) {
            const auto value = static_cast<double>(result.values[i]);
            report.require(std::signbit(drawn.values[i]) == std::signbit(result.values[i]) ||
                               std::abs(value) <= drawn.error_bound + result.error_bound,
                           "cell ", i, ": ", drawn.values[i], " and ", value);
        }
        if (query.values) {
            check_field(b, query.tolerance, result, 2000);
        }
        if (query.features && query.gradients && query.gradient == GradientMethod::analytic) {
            check_cells(b, query, result, 1000);
        }
        if (query.gradients && query.gradient == GradientMethod::central_differences) {
            check_differences(b, result, 1000);
        }
        check_points(b, query, result);
    }

    static void check(const Rings& rings, double tolerance, const Rectangle& box, bool features) {
        const PlacedShape shape(context(), rings, {});
        SCOPED_TRACE(to_text(rings));
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = tolerance;
        query.rectangle = box;
        query.features = query.gradients = features;
        check(context(), shape.oracle(), query);
    }
};

TEST_F(ComputeFields, HoldForRandomShapesAndEveryPart) {
    for_each_case(compute_seed, 24, [&](Random& random) {
        const AnyField field(context(), random);
        SCOPED_TRACE(field.text());
        DistanceFieldQuery query = field.query();
        const auto points = points_in(random, field.rectangle(), 20);
        if (random.whole(0, 1) == 0) {
            query.points = points;
        }
        query.values = random.whole(0, 3) > 0;
        query.features = random.whole(0, 1) == 0;
        query.gradients = random.whole(0, 2) > 0;
        query.gradient = random.whole(0, 1) == 0 ? GradientMethod::analytic
                                                 : GradientMethod::central_differences;
        query.sign = static_cast<SignEncoding>(random.whole(0, 2));
        if (!query.values && !query.features && !query.gradients) {
            query.points = points;
        }
        check(context(), field.oracle(), query);
    });
}

TEST_F(ComputeFields, HoldForEveryFamilyAndARealOutline) {
    for (const auto& [name, rings] : every_family(compute_seed)) {
        SCOPED_TRACE(name);
        check(rings, 0.02, {{-1.3, -1.2}, {1.2, 1.3}}, false);
        check(rings, 0.08, {{-1.3, -1.2}, {1.2, 1.3}}, true);
    }
    const Rings iceland = read_outline(NEARFIELD_TEST_DATA "/iceland_10m.geojson").rings;
    check(iceland, 2.0, oracle::ShapeOracle(iceland, {}).box(), false);
}

/// Vertices on samples and on rows of samples, slivers, folds: signs must equal the raster's.
TEST_F(ComputeFields, HoldForDegeneratePolygons) {
    constexpr std::uint32_t cells = 40;
    int checked = 0;
    for (const support::DegeneratePolygon& degenerate :
         support::degenerate_polygons(cells, cells, compute_seed)) {
        SCOPED_TRACE(degenerate.name);
        std::vector<Ring> rings;
        for (const auto& ring : degenerate.rings) {
            Ring& plain = rings.emplace_back();
            for (const auto& vertex : ring) {
                plain.push_back({vertex.x(), vertex.y()});
            }
        }
        // Some are invalid as shapes.
        if (const auto shape = context().add_shape(rings); shape.has_value()) {
            EXPECT_TRUE(context().remove_shape(*shape).ok());
            check(rings, 1.0 / std::numbers::sqrt2, {{0, 0}, {cells, cells}}, false);
            ++checked;
        }
    }
    EXPECT_GE(checked, 6);
}

TEST_F(ComputeFields, HoldWhereABlockHasHundredsOfEdges) {
    // A comb with 30 teeth per cell over the full height of a block.
    const double d = 0.5;
    const double cell = d * std::numbers::sqrt2;
    Ring comb;
    for (int i = 0; i < 600; ++i) {
        comb.push_back({i * cell / 30.0, i % 2 == 0 ? 0.0 : 10.0 * cell});
    }
    comb.push_back({20.0 * cell, -cell});
    comb.push_back({0.0, -cell});
    for (const bool features : {false, true}) {
        check({comb}, d, {{-3, -3}, {16, 10}}, features);
    }
}

TEST_F(ComputeFields, HoldForCoastLinesOfEverySize) {
    Random random(compute_seed);
    for (const int vertices : {40, 600, 9000}) {
        for (const double roughness : {0.4, 0.8}) {
            check(coast(random, vertices, roughness), 0.013, {{-1.5, -1.4}, {1.4, 1.5}}, false);
        }
    }
    // So dense that only the outer edges are ever nearest.
    check(star(random, 5000, 0.2), 0.02, {{-1.1, -1.2}, {1.2, 1.1}}, false);
    for (const char* name :
         {"/sweden_50m.geojson", "/cuba_50m.geojson", "/sri_lanka_10m.geojson"}) {
        SCOPED_TRACE(name);
        const Rings rings = read_outline(std::string(NEARFIELD_TEST_DATA) + name).rings;
        const Rectangle box = oracle::ShapeOracle(rings, {}).box();
        const double d = std::max(box.max.x - box.min.x, box.max.y - box.min.y) / 150.0;
        check(rings, d, box, false);
        check(rings, 4.0 * d, box, true);
    }
}

TEST_F(ComputeFields, HoldWhateverIsLeftOfTheLastBlock) {
    Random random(compute_seed);
    const Rings shape = coast(random, 300, 0.5);
    const double d = 0.01;
    const double cell = d * std::numbers::sqrt2;
    for (const int columns : {1, 7, 8, 9, 16, 24, 47}) {
        const int rows = random.whole(1, 40);
        SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
        const Vector2 low{random.between(-1.0, 0.5), random.between(-1.0, 0.5)};
        check(shape, d, {low, {low.x + (columns - 0.5) * cell, low.y + (rows - 0.5) * cell}},
              columns % 2 == 0);
    }
}

TEST_F(ComputeFields, HoldFarAwayAndBeyondATile) {
    Random random(compute_seed);
    const Rings shape = scaled_and_moved(star(random, 12, 0.3), 20.0, {});
    const double d = 1.0 / (60.0 * std::numbers::sqrt2);
    check(shape, d, {{-20.0, 3.0}, {20.0, 3.05}}, false);
    check(shape, d, {{-0.03, -20.0}, {0.03, 20.0}}, false);
    check(shape, 0.5, {{500.0, -600.0}, {540.0, -580.0}}, false);
    check(shape, 0.5, {{500.0, -600.0}, {520.0, -590.0}}, true);
}

TEST_F(ComputeFields, HoldForTinyAndHugeTolerances) {
    Random random(compute_seed);
    const Rings shape = star(random, 40, 0.4);
    check(shape, 1e-5, {{0.5, 0.5}, {0.5005, 0.5008}}, true);
    // Around a vertex of a shape of 10^8 cells.
    const Vector2 vertex = shape[0][3];
    const Rectangle around{{vertex.x - 1e-6, vertex.y - 7e-7}, {vertex.x + 9e-7, vertex.y + 8e-7}};
    check(shape, 1e-8, around, false);
    check(shape, 1e-8, around, true);
    for (const double factor : {1e-12, 1e7, 1e11}) {
        check(scaled_and_moved(shape, factor, {}), 0.01 * factor,
              {{-factor, -factor}, {factor, factor}}, true);
    }
}

// Around its centre all edges of a circle are about equally near.
TEST_F(ComputeFields, HoldAroundTheCentreOfACircle) {
    const Rings circle = regular(8000);
    check(circle, 0.002, {{-0.04, -0.03}, {0.03, 0.05}}, false);
    check(circle, 0.004, {{-0.04, -0.03}, {0.03, 0.05}}, true);
}

TEST_F(ComputeFields, AreRefusedWhereTooManyEdgesAreEquallyNear) {
    const PlacedShape circle(context(), regular(300000), {});
    DistanceFieldQuery query;
    query.b = circle.instance();
    query.tolerance = 0.01;
    query.rectangle = Rectangle{{-0.01, -0.01}, {0.01, 0.01}};
    query.features = true;
    query.technique = Technique::compute;
    const DistanceFieldResult result = run_alone(context(), query);
    EXPECT_EQ(result.status.code(), StatusCode::too_large) << result.status.text();
    EXPECT_TRUE(result.values.empty() && result.features.empty());
    query.technique = Technique::cpu;
    EXPECT_TRUE(run_alone(context(), query).status.ok());
}

TEST_F(ComputeFields, HoldOverManyRounds) {
    // So little memory that a tile batch has 256 x 256 cells.
    Expected<Context> small =
        Context::create(host_device(), on_demand({.memory_limit = 24U << 20U}));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    Random random(compute_seed);
    const PlacedShape shape(*small, star(random, 60, 0.4), {});
    DistanceFieldQuery query;
    query.b = shape.instance();
    query.rectangle = Rectangle{{-1.1, -1.0}, {1.2, 1.1}};
    query.tolerance = 0.004;
    const auto points = points_in(random, *query.rectangle, 50);
    check(*small, shape.oracle(), query);
    query.points = points;
    check(*small, shape.oracle(), query);
}

TEST_F(ComputeFields, StandBesideAllOtherQueriesInOneBatch) {
    Random random(compute_seed);
    const Pair shapes{
        {"A", star(random, 20, 0.5)}, {"B", star(random, 30, 0.4)}, {}, {{0.4, 0.2}, 0.5}, 0.04};
    std::vector<std::unique_ptr<PlacedPair>> pairs;
    Batch batch;
    std::vector<QueryHandle<PenetrationQuery>> penetrations;
    std::vector<QueryHandle<IntersectionQuery>> intersections;
    std::vector<QueryHandle<ContactQuery>> contacts;
    std::vector<QueryHandle<DistanceFieldQuery>> fields;
    const std::array techniques{Technique::compute, Technique::raster, Technique::compute};
    for (const Technique technique : techniques) {
        const PlacedPair& pair =
            *pairs.emplace_back(std::make_unique<PlacedPair>(context(), shapes, technique));
        penetrations.push_back(batch.add(pair.penetration()));
        IntersectionQuery intersection = pair.intersection(IntersectionKind::boundary_volume);
        intersection.technique = technique;
        intersections.push_back(batch.add(intersection));
        ContactQuery by_gradient = pair.contacts(0.08);
        by_gradient.normals = ContactNormals::gradient;
        contacts.push_back(batch.add(by_gradient));
        DistanceFieldQuery field{pair.instance_a(), pair.instance_b(), 0.04, std::nullopt};
        field.technique = technique;
        fields.push_back(batch.add(field));
    }
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        SCOPED_TRACE(i);
        const PlacedPair& pair = *pairs[i];
        EXPECT_EQ(results[intersections[i]].technique, techniques[i]);
        EXPECT_EQ(results[fields[i]].technique, techniques[i]);
        check_penetration(pair, PenetrationPoints::boundary, results[penetrations[i]]);
        check_intersection(pair, IntersectionKind::boundary_volume, results[intersections[i]]);
        check_field(pair.b(), 0.04, results[fields[i]], 500);
        ASSERT_TRUE(results[contacts[i]].status.ok()) << results[contacts[i]].status.text();
        EXPECT_EQ(results[contacts[i]].count, results[contacts[0]].count);
        EXPECT_GT(results[contacts[i]].count, 0U);
    }
    EXPECT_EQ(results[intersections[0]].count, results[intersections[2]].count);
    // The graph of the last tile batch, which is of the field for gradient normals.
    const std::string graph = *describe_graph(context(), GraphFormat::text);
    EXPECT_NE(graph.find("resolve field points by walks"), std::string::npos) << graph;
}

TEST_F(ComputeFields, BlendedGradientsAreRefusedByName) {
    const PlacedShape shape(context(), regular(5), {});
    DistanceFieldQuery query;
    query.b = shape.instance();
    query.tolerance = 0.1;
    query.rectangle = Rectangle{{-1, -1}, {1, 1}};
    query.gradients = true;
    query.gradient = GradientMethod::blended;
    query.technique = Technique::compute;
    const Status status = run_alone(context(), query).status;
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("compute does not answer blended gradients"), std::string::npos)
        << status.message();
}

TEST_F(ComputeFields, PointsAfterTheRastersImagesAreGone) {
    // More kinds of batches than cached compiled graphs: images of the first ones are destroyed.
    Expected<Context> made = Context::create(host_device(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(compute_seed);
    const PlacedPair pair(
        *made,
        {{"A", star(random, 9, 0.5)}, {"B", star(random, 9, 0.5)}, {}, {{0.5, 0.2}, 0.0}, 0.05});
    const PenetrationResult drawn = run_alone(*made, pair.penetration());
    for (std::uint32_t set = 1; set < 1U << intersection_strategies; ++set) {
        Batch batch;
        for (std::uint32_t i = 0; i < intersection_strategies; ++i) {
            const auto strategy = static_cast<IntersectionStrategy>(i);
            if ((set >> i & 1U) != 0 && strategy != IntersectionStrategy::logic_op) {
                IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
                query.strategy = strategy;
                batch.add(query);
                query.kind = IntersectionKind::boundary_boundary;
                batch.add(query);
            }
        }
        DistanceFieldQuery field{pair.instance_a(), pair.instance_b(), 0.05, std::nullopt};
        for (std::uint32_t encoding = 0; encoding < 3; ++encoding) {
            if ((set >> encoding & 1U) != 0) {
                field.sign = static_cast<SignEncoding>(encoding);
                batch.add(field);
            }
        }
        Results results;
        ASSERT_TRUE(made->run(batch, results).ok());
        PenetrationQuery computed = pair.penetration();
        computed.technique = Technique::compute;
        // Two in flight, so that descriptor sets are inspected while images are destroyed.
        Batch points;
        points.add(computed);
        const Expected<Ticket> first = made->submit(points);
        const Expected<Ticket> second = made->submit(batch);
        ASSERT_TRUE(first.has_value() && second.has_value());
        ASSERT_TRUE(made->collect(*first, results).ok());
        EXPECT_EQ(std::get<PenetrationResult>(results.results.front()).count, drawn.count);
        ASSERT_TRUE(made->collect(*second, results).ok());
    }
}

TEST_F(ComputeFields, MasksCountTowardsTheMemoryLimit) {
    Settings settings;
    settings.memory_limit = std::uint64_t{64} << 20U;
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const PlacedPair pair(
        *small, {{"A", rectangle({0, 0}, {1, 1})}, {"B", rectangle({0, 0}, {1, 1})}, {}, {}, 2e-5});
    IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
    query.summary_only = true;
    query.technique = Technique::compute;
    Batch batch;
    batch.add(query);
    Results results;
    const Status refused = small->run(batch, results);
    EXPECT_EQ(refused.code(), StatusCode::too_large) << refused.text();
    EXPECT_EQ(results.timings.device, 0.0) << "refused after the work";
}

TEST_F(ComputeFields, TooFarAwayIsRefusedByEveryTechniqueBeforeTheWork) {
    const PlacedShape shape(context(), regular(5), {});
    for (const Technique technique : every_technique) {
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = 1e-3;
        query.rectangle = Rectangle{{1e5, 0.0}, {1e5 + 0.1, 0.1}};
        query.technique = technique;
        Batch batch;
        batch.add(query);
        Results results;
        ASSERT_TRUE(context().run(batch, results).ok());
        const Status status = std::get<DistanceFieldResult>(results.results.front()).status;
        EXPECT_EQ(status.code(), StatusCode::invalid_query) << status.text();
        EXPECT_NE(status.message().find("single precision"), std::string::npos) << status.text();
        EXPECT_EQ(results.timings.device, 0.0) << "refused after the work";
    }
}

}  // namespace
}  // namespace nearfield::test
