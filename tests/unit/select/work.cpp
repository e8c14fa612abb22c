#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/planner.hpp>
#include <engine/select/fit_cost.hpp>
#include <engine/select/work.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::select {
namespace {

using geometry::Polygon;
using test::Random;

/// The planned work of a query: points and cells.
struct Planned {
    double points = 0.0;
    double cells = 0.0;
};

Planned planned(AnyQuery query, const Polygon& a, const Polygon& b) {
    std::visit([](auto& asked) { asked.technique = Technique::raster; }, query);
    plan::PlanLimits limits;
    limits.memory = std::uint64_t{1} << 30U;
    plan::Planner planner(limits);
    plan::Plan plan;
    std::vector<AnyResult> results;
    const plan::QueryShapes shapes{&a, &b};
    planner.plan(std::span(&query, 1), std::span(&shapes, 1), plan, results);
    Planned planned{static_cast<double>(plan.points.size()), 0.0};
    for (const plan::Tile& tile : plan.tiles) {
        planned.cells += static_cast<double>(tile.width) * tile.height;
    }
    return planned;
}

TEST(Work, EstimatesSamplesWithinAFactor) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Polygon a;
        Polygon b;
        ASSERT_TRUE(a.assign(test::coast(random, random.whole(30, 3000), 0.2)).ok());
        ASSERT_TRUE(b.assign(test::coast(random, random.whole(30, 3000), 0.2)).ok());
        const double tolerance = random.scale(0.002, 0.02);
        PenetrationQuery penetration;
        penetration.a.shape = {0, 0};
        penetration.b = {{1, 0}, {{random.between(0.3, 1.2), 0.2}, random.between(0.0, 6.0)}};
        penetration.tolerance = tolerance;
        const Work points = select::work_of(penetration, &a, b);
        EXPECT_EQ(points.edges, a.size() + b.size());
        // Localisation excludes points that cannot be inside, which boxes alone cannot show.
        const Planned found = planned(penetration, a, b);
        EXPECT_LT(points.samples, 16.0 * found.points + 200.0);
        EXPECT_GT(points.samples, found.points / 3.0);

        IntersectionQuery intersection;
        intersection.a = penetration.a;
        intersection.b = penetration.b;
        intersection.tolerance = tolerance;
        const double cells = planned(intersection, a, b).cells;
        EXPECT_LT(select::work_of(intersection, &a, b).samples, 4.0 * cells);
        EXPECT_GT(select::work_of(intersection, &a, b).samples, cells / 2.0);

        DistanceFieldQuery field;
        field.b.shape = {1, 0};
        field.tolerance = tolerance;
        field.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 0.5}};
        const double field_cells = planned(field, a, b).cells;
        EXPECT_NEAR(select::work_of(field, nullptr, b).samples, field_cells, 0.1 * field_cells);
    }
}

TEST(Work, LiesWithinItsBounds) {
    int open = 0;
    int below = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Polygon a;
        Polygon b;
        ASSERT_TRUE(a.assign(test::any_shape(random).rings).ok());
        ASSERT_TRUE(b.assign(test::any_shape(random).rings).ok());
        const Instance at_a{{0, 0}, {{random.between(-1.0, 1.0), 0.1}, 1.0}};
        const Instance at_b{{1, 0}, {{random.between(-1.0, 1.0), 0.0}, 2.0}};
        const double d = random.scale(0.001, 0.5);
        PenetrationQuery vertices{at_a, at_b, d};
        vertices.points = PenetrationPoints::vertices;
        DistanceFieldQuery field;
        field.a = at_a;
        field.b = at_b;
        field.tolerance = d;
        DistanceFieldQuery window = field;
        window.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 0.5}};
        IntersectionQuery intersection;
        intersection.a = at_a;
        intersection.b = at_b;
        intersection.tolerance = d;
        for (const AnyQuery& query :
             {AnyQuery(vertices), AnyQuery(PenetrationQuery{at_a, at_b, d}), AnyQuery(intersection),
              AnyQuery(ContactQuery{at_a, at_b, d, 2.0 * d}), AnyQuery(field), AnyQuery(window),
              AnyQuery(SeparationQuery{at_a, at_b, d})}) {
            const WorkBounds bounds = select::work_bounds(query, &a, b);
            const Work work = select::work_of(query, &a, b);
            for (const Work& bound : {bounds.least, bounds.most}) {
                EXPECT_EQ(bound.kind, work.kind);
            }
            EXPECT_LE(bounds.least.edges, work.edges);
            EXPECT_LE(work.edges, bounds.most.edges);
            EXPECT_LE(bounds.least.samples, work.samples);
            EXPECT_LE(work.samples, bounds.most.samples);
            EXPECT_LE(bounds.least.searches, work.searches);
            EXPECT_LE(work.searches, bounds.most.searches);
            if (bounds.least.samples < bounds.most.samples) {
                ++open;
                below += work.samples < bounds.most.samples ? 1 : 0;
            }
        }
        EXPECT_EQ(select::work_bounds(vertices, &a, b).least.samples, a.size());
        EXPECT_EQ(select::work_bounds(vertices, &a, b).most.samples, a.size());
        EXPECT_EQ(select::work_bounds(window, &a, b).least.samples,
                  select::work_bounds(window, &a, b).most.samples);
    }
    EXPECT_GT(below, open * 9 / 10) << "estimates that the bounds cut off";
}

TEST(Work, BoundsSayWhatADeviceCanSave) {
    Random random(1);
    const auto random_costs = [&] {
        QueryCosts costs;
        costs.points = {random.scale(0.1, 10.0), random.scale(1e-3, 1.0), random.scale(1e-3, 1.0),
                        random.scale(1e-3, 1.0), random.scale(1e-3, 1.0)};
        return costs;
    };
    for (int i = 0; i < 1000; ++i) {
        const QueryCosts cpu = random_costs();
        const QueryCosts device = random_costs();
        WorkBounds bounds;
        bounds.least.edges = random.between(0.0, 100.0);
        bounds.most.edges = bounds.least.edges + random.between(0.0, 100.0);
        bounds.least.samples = random.between(0.0, 100.0);
        bounds.most.samples = bounds.least.samples + random.between(0.0, 100.0);
        bounds.least.searches = random.between(0.0, 100.0);
        bounds.most.searches = bounds.least.searches + random.between(0.0, 100.0);
        bounds.most.shape_edges = random.between(0.0, 100.0);
        const double most = bounds.max_saved(cpu, device);
        for (int k = 0; k < 20; ++k) {
            Work work;
            work.edges = random.between(bounds.least.edges, bounds.most.edges);
            work.samples = random.between(bounds.least.samples, bounds.most.samples);
            work.searches = random.between(bounds.least.searches, bounds.most.searches);
            work.shape_edges = random.between(0.0, bounds.most.shape_edges);
            EXPECT_LE(work.time(cpu) - work.time(device), most + 1e-9) << i;
        }
    }
}

TEST(Work, IsOfTheKindThatTheQueryIs) {
    Random random(1);
    Polygon shape;
    ASSERT_TRUE(shape.assign(test::star(random, 20, 0.5)).ok());
    DistanceFieldQuery field;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 0.5}};
    EXPECT_EQ(select::work_of(field, nullptr, shape).kind, &QueryCosts::field);
    field.features = true;
    EXPECT_EQ(select::work_of(field, nullptr, shape).kind, &QueryCosts::features);
    EXPECT_EQ(select::work_of(SeparationQuery{}, &shape, shape).kind, &QueryCosts::closest);
    PenetrationQuery vertices;
    vertices.points = PenetrationPoints::vertices;
    EXPECT_EQ(select::work_of(vertices, &shape, shape).samples, 20.0);
}

TEST(Work, OfResidentFieldsIsReadWhereTheHostAsks) {
    Random random(1);
    Polygon shape;
    ASSERT_TRUE(shape.assign(test::star(random, 20, 0.5)).ok());
    DistanceFieldQuery field;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 0.5}};
    field.resident = true;
    const auto is_read = [&] { return select::work_of(field, nullptr, shape).is_read; };
    EXPECT_TRUE(is_read());
    field.values = false;
    EXPECT_FALSE(is_read());
    field.rectangle.reset();
    EXPECT_FALSE(select::work_of(field, &shape, shape).is_read) << "with an estimate of its cells";
    field.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 0.5}};
    field.features = true;
    EXPECT_TRUE(is_read());
    field.features = false;
    field.gradients = true;
    EXPECT_TRUE(is_read());
    field.gradients = false;
    const Vector2 point{0.1, 0.1};
    field.points = std::span(&point, 1);
    EXPECT_TRUE(is_read());
    // The host makes the summaries of these, from all points, whether they stay on the device or
    // not.
    PenetrationQuery penetration;
    penetration.tolerance = 0.1;
    penetration.records = false;
    penetration.resident = true;
    EXPECT_TRUE(select::work_of(penetration, &shape, shape).is_read);
}

TEST(Work, IsPlannedDoneAndRead) {
    const DeviceCosts costs{.submission = 1000.0,
                            .latency = 1000.0,
                            .plan = {.field = {1.0, 2.0, 3.0}},
                            .device = {.field = {10.0, 20.0, 30.0}},
                            .read = {.field = {100.0, 200.0, 300.0}}};
    Work work{.kind = &QueryCosts::field, .edges = 2.0, .samples = 3.0};
    EXPECT_EQ(work.load(costs).alone, 14.0 + 1400.0);
    EXPECT_EQ(work.load(costs).device, 140.0);
    EXPECT_EQ(work.load(costs).cpu, 0.0);
    work.is_read = false;
    EXPECT_EQ(work.load(costs).alone, 14.0);
    EXPECT_EQ(work.load(costs).device, 140.0);
    const CpuCosts cpu{.plan = {.field = {1.0, 2.0, 3.0}}, .answer = {.field = {10.0, 20.0, 30.0}}};
    EXPECT_EQ(work.load(cpu).alone, 14.0);
    EXPECT_EQ(work.load(cpu).device, 0.0);
    EXPECT_EQ(work.load(cpu).cpu, 140.0);
}

TEST(Load, HidesTheLesserWorkAsFarAsTheyOverlap) {
    const Load load{.alone = 1.0, .device = 30.0, .cpu = 20.0};
    EXPECT_EQ(load.time(0.0), 51.0);
    EXPECT_EQ(load.time(0.5), 41.0);
    EXPECT_EQ(load.time(1.0), 31.0);
}

TEST(FitCost, FindsWhatMeasurementsWereMadeOf) {
    const WorkCost made{3.0, 0.02, 0.5, 0.3, 0.1};
    const auto measured = [&](double edges, double samples, double searches) {
        return MeasuredWork{.edges = edges,
                            .samples = samples,
                            .searches = searches,
                            .shape_edges = edges / 2.0,
                            .time = made.query + made.edge * edges + made.sample * samples +
                                    made.search * searches + made.shape * edges / 2.0};
    };
    const Measurements measurements{
        .least = measured(32, 20, 40),
        .edges = measured(8192, 300, 1500),
        .samples = measured(32, 5000, 10000),
        .searches = measured(8192, 5000, 40000),
    };
    const WorkCost found = select::fit_cost(measurements, made.shape);
    EXPECT_NEAR(found.query, made.query, 1e-6);
    EXPECT_NEAR(found.edge, made.edge, 1e-6);
    EXPECT_NEAR(found.sample, made.sample, 1e-6);
    EXPECT_NEAR(found.search, made.search, 1e-6);
    EXPECT_NEAR(found.shape, made.shape, 1e-6);
    // An edge of a shape takes no more than all that many edges took.
    const WorkCost less = select::fit_cost(measurements, 1.0);
    EXPECT_NEAR(less.shape, made.shape + 2.0 * made.edge, 1e-6);
    EXPECT_NEAR(less.edge, 0.0, 1e-6);
}

TEST(FitCost, HasNoNegativeCosts) {
    // More work in less time, as noise may cause.
    const WorkCost found = select::fit_cost({
        .least = {32, 20, 40, 0, 5.0},
        .edges = {8192, 20, 100, 0, 4.0},
        .samples = {32, 5000, 10000, 0, 3.0},
        .searches = {8192, 5000, 40000, 0, 2.0},
    });
    EXPECT_GE(found.query, 0.0);
    EXPECT_GE(found.edge, 0.0);
    EXPECT_GE(found.sample, 0.0);
    EXPECT_GE(found.search, 0.0);
    const MeasuredWork none;
    const WorkCost edges_alone = select::fit_cost({.least = {32, 0, 0, 0, 5.0},
                                                   .edges = {8192, 0, 0, 0, 25.0},
                                                   .samples = none,
                                                   .searches = none});
    EXPECT_EQ(edges_alone.sample, 0.0);
    EXPECT_EQ(edges_alone.search, 0.0);
    EXPECT_GT(edges_alone.edge, 0.0);
}

/// The mean over places by brute force, with all vertices.
TEST(Work, EstimatesHowManyEdgesAreAboutAsNearAsTheNearest) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Polygon shape;
        ASSERT_TRUE(shape.assign(test::coast(random, random.whole(100, 3000), 0.2)).ok());
        DistanceFieldQuery field;
        field.tolerance = random.scale(0.002, 0.02);
        field.rectangle = Rectangle{{-1.2, -1.2}, {1.2, 1.2}};
        const double cell = field.tolerance * std::numbers::sqrt2;
        const geometry::TransformedPolygon placed(shape, {});
        double logarithms = 0.0;
        constexpr int places = 300;
        for (int i = 0; i < places; ++i) {
            const geometry::Vector at(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
            std::vector<double> distances;
            for (std::uint32_t k = 0; k < shape.size(); ++k) {
                distances.push_back((placed.vertex(k) - at).norm());
            }
            const double most = *std::min_element(distances.begin(), distances.end()) +
                                16.0 * std::numbers::sqrt2 * cell;
            const auto near = std::count_if(distances.begin(), distances.end(),
                                            [most](double distance) { return distance <= most; });
            logarithms += std::log2(1.0 + static_cast<double>(near));
        }
        const Work work = select::work_of(field, nullptr, shape);
        EXPECT_GT(work.searches, 0.7 * work.samples * logarithms / places);
        EXPECT_LT(work.searches, 2.0 * work.samples * logarithms / places);
        field.tolerance = 1.0;  // hardly a block
        const Work small = select::work_of(field, nullptr, shape);
        EXPECT_LE(small.searches, small.samples * std::log2(1.0 + shape.size()));
    }
}

}  // namespace
}  // namespace nearfield::select
