#include <engine/plan/planner.hpp>
#include <engine/select/fit_cost.hpp>
#include <engine/select/work.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

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
            // If all vertices are examined and none is cut off by a limit.
            if (bounds.least.samples < bounds.most.samples && a.size() + b.size() < 512) {
                EXPECT_LT(work.samples, bounds.most.samples);
            }
        }
        EXPECT_EQ(select::work_bounds(vertices, &a, b).least.samples, a.size());
        EXPECT_EQ(select::work_bounds(vertices, &a, b).most.samples, a.size());
        EXPECT_EQ(select::work_bounds(window, &a, b).least.samples,
                  select::work_bounds(window, &a, b).most.samples);
    }
}

TEST(Work, BoundsSayWhatADeviceCanSave) {
    Random random(1);
    const auto random_costs = [&] {
        TechniqueCost costs;
        costs.points = {random.scale(0.1, 10.0), random.scale(1e-3, 1.0), random.scale(1e-3, 1.0)};
        return costs;
    };
    for (int i = 0; i < 1000; ++i) {
        const TechniqueCost cpu = random_costs();
        const TechniqueCost device = random_costs();
        WorkBounds bounds;
        bounds.least.edges = random.between(0.0, 100.0);
        bounds.most.edges = bounds.least.edges + random.between(0.0, 100.0);
        bounds.least.samples = random.between(0.0, 100.0);
        bounds.most.samples = bounds.least.samples + random.between(0.0, 100.0);
        const double most = bounds.max_saved(cpu, device);
        for (int k = 0; k < 20; ++k) {
            Work work;
            work.edges = random.between(bounds.least.edges, bounds.most.edges);
            work.samples = random.between(bounds.least.samples, bounds.most.samples);
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
    EXPECT_EQ(select::work_of(field, nullptr, shape).kind, &TechniqueCost::field);
    field.features = true;
    EXPECT_EQ(select::work_of(field, nullptr, shape).kind, &TechniqueCost::features);
    EXPECT_EQ(select::work_of(SeparationQuery{}, &shape, shape).kind, &TechniqueCost::closest);
    PenetrationQuery vertices;
    vertices.points = PenetrationPoints::vertices;
    EXPECT_EQ(select::work_of(vertices, &shape, shape).samples, 20.0);
}

TEST(FitCost, FindsWhatMeasurementsWereMadeOf) {
    const WorkCost made{3.0, 0.02, 0.5};
    const auto measured = [&](double edges, double samples) {
        return MeasuredWork{edges, samples, made.query + made.edge * edges + made.sample * samples};
    };
    const WorkCost found =
        select::fit_cost(measured(32, 20), measured(8192, 300), measured(32, 5000));
    EXPECT_NEAR(found.query, made.query, 1e-6);
    EXPECT_NEAR(found.edge, made.edge, 1e-6);
    EXPECT_NEAR(found.sample, made.sample, 1e-6);
}

TEST(FitCost, HasNoNegativeCosts) {
    // More edges and samples in less time, as noise may cause.
    const WorkCost found = select::fit_cost({32, 20, 5.0}, {8192, 20, 4.0}, {32, 5000, 3.0});
    EXPECT_GE(found.query, 0.0);
    EXPECT_GE(found.edge, 0.0);
    EXPECT_GE(found.sample, 0.0);
    const WorkCost without_samples = select::fit_cost({32, 0, 5.0}, {8192, 0, 25.0}, {32, 0, 5.0});
    EXPECT_EQ(without_samples.sample, 0.0);
    EXPECT_GT(without_samples.edge, 0.0);
}

}  // namespace
}  // namespace nearfield::select
