#include <engine/batch/technique_choice.hpp>
#include <engine/queries/checked_query.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::batch {
namespace {

Technique technique_of(const AnyQuery& query) {
    return std::visit([](const auto& asked) { return asked.technique; }, query);
}

/// Two pentagons at the origin, of radius 1 and 0.5, and two rings of many edges.
class TechniqueChoice : public testing::Test {
protected:
    static constexpr std::uint64_t pairs = 10;
    static constexpr std::uint64_t cells = 100;
    static constexpr int max_edges = 12000;  // as the comment of Technique::compute has it

    void SetUp() override {
        ASSERT_TRUE(a_.assign(test::regular(5)).ok());
        ASSERT_TRUE(b_.assign(test::scaled_and_moved(test::regular(5), 0.5, {})).ok());
        ASSERT_TRUE(fine_.assign(test::regular(max_edges)).ok());
        ASSERT_TRUE(finer_.assign(test::regular(max_edges + 1)).ok());
    }

    /// The context of a hardware device.
    static TechniqueRule hardware() {
        return {.available = {},
                .largest_range = std::uint64_t{1} << 27U,
                .thresholds = DeviceThresholds{.pairs = pairs, .cells = cells}};
    }
    static TechniqueRule software() {
        TechniqueRule rule = hardware();
        rule.thresholds.reset();
        return rule;
    }

    template <class Query>
    static Query between(double tolerance = 0.1) {
        Query query;
        query.a.shape = {0, 0};
        query.b.shape = {1, 0};
        if constexpr (requires { query.tolerance; }) {
            query.tolerance = tolerance;
        }
        return query;
    }
    /// Of a column of so many cells.
    static DistanceFieldQuery field(double up) {
        auto query = between<DistanceFieldQuery>(std::sqrt(0.5));  // cells of side 1
        query.rectangle = Rectangle{{0.0, 0.0}, {1.0, up}};
        return query;
    }

    [[nodiscard]] std::vector<Technique> choose(std::vector<AnyQuery> queries,
                                                const TechniqueRule& rule = hardware()) const {
        std::vector<queries::QueryShapes> shapes;
        const geometry::Polygon* const all[] = {&a_, &b_, &fine_, &finer_};
        queries::find_shapes(
            queries,
            [&](ShapeHandle handle) { return handle.index < 4 ? all[handle.index] : nullptr; },
            shapes);
        choose_techniques(queries, shapes, rule);
        std::vector<Technique> chosen;
        std::transform(queries.begin(), queries.end(), std::back_inserter(chosen), technique_of);
        return chosen;
    }
    [[nodiscard]] Technique choose_one(const AnyQuery& query,
                                       const TechniqueRule& rule = hardware()) const {
        return choose({query}, rule)[0];
    }

    /// Expects all but the last `others` of the queries to go to one technique.
    void expect_all(const std::vector<AnyQuery>& queries, Technique technique,
                    const TechniqueRule& rule = hardware(), std::size_t others = 0) const {
        std::vector<Technique> chosen = choose(queries, rule);
        chosen.resize(chosen.size() - others);
        EXPECT_EQ(chosen, std::vector<Technique>(chosen.size(), technique));
    }

    geometry::Polygon a_;
    geometry::Polygon b_;
    geometry::Polygon fine_;
    geometry::Polygon finer_;
};

TEST_F(TechniqueChoice, OfPairsIsComputeFromTheThresholdOn) {
    for (const AnyQuery& query :
         {AnyQuery(between<PenetrationQuery>()), AnyQuery(between<ContactQuery>()),
          AnyQuery(between<IntersectionQuery>())}) {
        SCOPED_TRACE(query.index());
        expect_all(std::vector<AnyQuery>(pairs - 1, query), Technique::cpu);
        expect_all(std::vector<AnyQuery>(pairs, query), Technique::compute);
        expect_all(std::vector<AnyQuery>(pairs + 1, query), Technique::compute);
    }
    std::vector<AnyQuery> mixed(pairs - 2, between<PenetrationQuery>());
    mixed.emplace_back(between<ContactQuery>());
    expect_all(mixed, Technique::cpu);
    mixed.emplace_back(between<IntersectionQuery>());
    expect_all(mixed, Technique::compute);
}

TEST_F(TechniqueChoice, OfFieldsIsComputeFromSoManyCellsOn) {
    EXPECT_EQ(choose_one(field(cells - 1.0)), Technique::cpu);
    EXPECT_EQ(choose_one(field(cells)), Technique::compute);
    EXPECT_EQ(choose_one(field(cells + 1.0)), Technique::compute);
    expect_all({field(0.5 * cells), field(0.4 * cells)}, Technique::cpu);
    expect_all({field(0.5 * cells), field(0.5 * cells)}, Technique::compute);
}

TEST_F(TechniqueChoice, CountsTheCellsOfTheCommonBoxAndAtPoints) {
    DistanceFieldQuery common = field(0.0);
    common.rectangle.reset();
    common.tolerance = 0.01;  // some thousands of cells in the square around the smaller shape
    EXPECT_EQ(choose_one(common), Technique::compute);
    common.a.pose.translation.x = 2.1;  // beside each other
    EXPECT_EQ(choose_one(common), Technique::cpu);
    const std::vector<Vector2> points(cells / 4);
    DistanceFieldQuery at_points = field(10.0 * cells);
    at_points.values = false;
    at_points.points = std::span(points).first(points.size() - 1);
    EXPECT_EQ(choose_one(at_points), Technique::cpu);
    at_points.points = points;
    EXPECT_EQ(choose_one(at_points), Technique::compute);
}

TEST_F(TechniqueChoice, OfOneKindOfWorkDoesNotDependOnTheOther) {
    std::vector<AnyQuery> queries(pairs, between<PenetrationQuery>());
    queries.emplace_back(field(cells - 1.0));
    const std::vector<Technique> chosen = choose(queries);
    EXPECT_EQ(chosen.front(), Technique::compute);
    EXPECT_EQ(chosen.back(), Technique::cpu);
    EXPECT_EQ(choose({between<PenetrationQuery>(), field(cells)}),
              (std::vector<Technique>{Technique::cpu, Technique::compute}));
}

TEST_F(TechniqueChoice, IsTheCpuOnSoftwareDevicesHoweverMuchThereIs) {
    std::vector<AnyQuery> queries(100 * pairs, between<PenetrationQuery>());
    queries.emplace_back(field(1e6 * cells));
    expect_all(queries, Technique::cpu, software());
}

TEST_F(TechniqueChoice, LeavesToTheCpuWhatComputeDoesNotAnswerAsWell) {
    std::vector<AnyQuery> queries(pairs, between<PenetrationQuery>());
    queries.emplace_back(between<SeparationQuery>());
    queries.emplace_back(between<ClosestPointQuery>());
    queries.emplace_back(between<IntersectionTestQuery>());
    queries.emplace_back(between<ContainmentQuery>());
    auto gradients = between<ContactQuery>();
    gradients.normals = ContactNormals::gradient;
    queries.emplace_back(gradients);
    constexpr std::size_t others = 5;
    expect_all(queries, Technique::compute, hardware(), others);
    const std::vector<Technique> chosen = choose(queries);
    EXPECT_EQ(std::vector<Technique>(chosen.end() - others, chosen.end()),
              std::vector<Technique>(others, Technique::cpu));
    // Nor do these count.
    queries.erase(queries.begin());
    expect_all(queries, Technique::cpu);
}

TEST_F(TechniqueChoice, LeavesToTheCpuWhatComputeMightRefuse) {
    DistanceFieldQuery of_many = field(100.0 * cells);
    of_many.b.shape = {2, 0};
    EXPECT_EQ(choose_one(of_many), Technique::compute);
    of_many.b.shape = {3, 0};
    EXPECT_EQ(choose({of_many, field(0.5 * cells)}),
              (std::vector<Technique>{Technique::cpu, Technique::cpu}));
    TechniqueRule rule = hardware();
    rule.largest_range = queries::max_shape_bytes(a_, b_);
    const std::vector<AnyQuery> overlaps(pairs, between<IntersectionQuery>());
    expect_all(overlaps, Technique::compute, rule);
    --rule.largest_range;
    expect_all(overlaps, Technique::cpu, rule);
}

TEST_F(TechniqueChoice, OfWhatStaysOnTheDeviceIsComputeAlone) {
    auto points = between<PenetrationQuery>();
    points.on_device = true;
    auto overlap = between<IntersectionQuery>();
    overlap.on_device = true;
    DistanceFieldQuery distances = field(1.0);
    distances.on_device = true;
    for (TechniqueRule rule : {hardware(), software()}) {
        expect_all({points, overlap, distances}, Technique::compute, rule);
        rule.largest_range = queries::max_shape_bytes(a_, b_) - 1;
        EXPECT_EQ(choose_one(overlap, rule), Technique::compute) << "to be refused by name";
        rule.available = {.compute = false};
        expect_all({points, overlap, distances}, Technique::automatic, rule);
    }
}

TEST_F(TechniqueChoice, IsTheRasterForBlendedGradientsAlone) {
    DistanceFieldQuery blended = field(100.0 * cells);
    blended.gradients = true;
    blended.gradient = GradientMethod::blended;
    EXPECT_EQ(choose({blended, field(100.0 * cells)}),
              (std::vector<Technique>{Technique::raster, Technique::compute}));
}

TEST_F(TechniqueChoice, IsLeftOpenWhereNoTechniqueAnswers) {
    DistanceFieldQuery blended = field(1.0);
    blended.gradients = true;
    blended.gradient = GradientMethod::blended;
    TechniqueRule rule = hardware();
    rule.available.raster = false;
    EXPECT_EQ(choose_one(blended, rule), Technique::automatic);
    auto points = between<PenetrationQuery>();
    points.on_device = true;
    rule.available = {.device = false, .draws = false, .raster = false, .compute = false};
    rule.thresholds.reset();
    EXPECT_EQ(choose_one(points, rule), Technique::automatic);
    EXPECT_EQ(choose_one(between<PenetrationQuery>(), rule), Technique::cpu);
}

TEST_F(TechniqueChoice, NeedsTheTechniqueAndLeavesWhatIsNamed) {
    TechniqueRule rule = hardware();
    rule.available.compute = false;
    expect_all(std::vector<AnyQuery>(pairs, between<PenetrationQuery>()), Technique::cpu, rule);
    std::vector<AnyQuery> named(pairs, between<PenetrationQuery>());
    for (AnyQuery& query : named) {
        std::get<PenetrationQuery>(query).technique = Technique::raster;
    }
    expect_all(named, Technique::raster);
    // Nor do these count.
    named.emplace_back(between<PenetrationQuery>());
    EXPECT_EQ(choose(named).back(), Technique::cpu);
}

TEST_F(TechniqueChoice, OfQueriesThatWillBeRejectedKeepsNoOtherFromItsTechnique) {
    auto unknown = between<PenetrationQuery>();
    unknown.b.shape = {7, 0};
    DistanceFieldQuery bad = field(1.0);
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0}) {
        bad.tolerance = value;
        EXPECT_EQ(choose({unknown, bad, field(cells - 2.0)}),
                  std::vector<Technique>(3, Technique::cpu));
    }
    bad = field(0.0);
    bad.rectangle.reset();
    bad.a.shape = {7, 0};
    EXPECT_EQ(choose_one(bad), Technique::cpu);
}

TEST_F(TechniqueChoice, TakesThresholdsAtTheirEnds) {
    TechniqueRule rule = hardware();
    rule.thresholds = DeviceThresholds{.pairs = 0, .cells = 0};
    expect_all({between<PenetrationQuery>(), field(0.1)}, Technique::compute, rule);
    rule.thresholds = DeviceThresholds{.pairs = UINT64_MAX, .cells = UINT64_MAX};
    expect_all({between<PenetrationQuery>(), field(1e9)}, Technique::cpu, rule);
}

}  // namespace
}  // namespace nearfield::batch
