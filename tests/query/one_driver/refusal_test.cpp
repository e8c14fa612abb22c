#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <limits>
#include <sstream>

namespace nearfield::test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class Refusal : public QueryTest {
protected:
    Refusal()
        : pair_(context(),
                {{"A", rectangle({0, 0}, {4, 4})}, {"B", rectangle({2, 2}, {6, 6})}, {}, {}, 0.1}) {
    }

    /// Runs queries that must be rejected between two valid ones, which must be answered.
    template <class Query>
    void expect_refused(const std::vector<Query>& bad, StatusCode code) {
        Batch batch;
        const auto first = batch.add(pair_.penetration());
        std::vector<QueryHandle<Query>> handles;
        for (const Query& query : bad) {
            handles.push_back(batch.add(query));
        }
        const auto last = batch.add(pair_.intersection(IntersectionKind::volume_volume));
        Results results;
        const Status status = context().run(batch, results);
        ASSERT_TRUE(status.ok()) << status.text();
        for (std::size_t i = 0; i < bad.size(); ++i) {
            const Status& refused = results[handles[i]].status;
            EXPECT_EQ(refused.code(), code) << "query " << i << ": " << refused.text();
            EXPECT_FALSE(refused.message().empty()) << "query " << i;
        }
        check_penetration(pair_, PenetrationPoints::boundary, results[first]);
        check_intersection(pair_, IntersectionKind::volume_volume, results[last]);
    }

    PlacedPair pair_;
};

TEST_F(Refusal, OfTolerances) {
    std::vector<PenetrationQuery> penetrations;
    std::vector<IntersectionQuery> intersections;
    std::vector<DistanceFieldQuery> fields;
    for (const double tolerance : {0.0, -1.0, not_a_number, infinity, -infinity}) {
        penetrations.push_back(pair_.penetration());
        penetrations.back().tolerance = tolerance;
        intersections.push_back(pair_.intersection(IntersectionKind::boundary_volume));
        intersections.back().tolerance = tolerance;
        fields.push_back({pair_.instance_a(), pair_.instance_b(), tolerance, std::nullopt});
    }
    expect_refused(penetrations, StatusCode::invalid_query);
    expect_refused(intersections, StatusCode::invalid_query);
    expect_refused(fields, StatusCode::invalid_query);
}

TEST_F(Refusal, OfPoses) {
    std::vector<PenetrationQuery> queries(6, pair_.penetration());
    queries[0].a.pose.translation.x = not_a_number;
    queries[1].b.pose.translation.y = infinity;
    queries[2].a.pose.angle = not_a_number;
    queries[3].b.pose.angle = -infinity;
    queries[4].b.pose.translation.x = not_a_number;
    queries[5].a.pose.translation.y = -infinity;
    expect_refused(queries, StatusCode::invalid_query);
}

TEST_F(Refusal, OfRectangles) {
    std::vector<DistanceFieldQuery> queries;
    for (const Rectangle& rectangle :
         {Rectangle{{1, 0}, {0, 1}}, Rectangle{{0, 1}, {1, 0}},
          Rectangle{{not_a_number, 0}, {1, 1}}, Rectangle{{0, 0}, {1, infinity}}}) {
        queries.push_back({{}, pair_.instance_b(), 0.1, rectangle});
    }
    expect_refused(queries, StatusCode::invalid_query);
}

TEST_F(Refusal, OfFieldsThatAskForNothing) {
    DistanceFieldQuery query{{}, pair_.instance_b(), 0.1, Rectangle{{0, 0}, {1, 1}}};
    query.values = false;
    expect_refused(std::vector{query}, StatusCode::invalid_query);
    EXPECT_NE(run_alone(context(), query).status.message().find("asks for nothing"),
              std::string::npos);
}

TEST_F(Refusal, OfPointsOutsideTheField) {
    for (const Vector2& bad : {Vector2{-0.3, 0.5}, Vector2{0.5, 1.3}, Vector2{not_a_number, 0.5},
                               Vector2{0.5, -infinity}, Vector2{0.5, 1e300}}) {
        const std::vector<Vector2> points{{0.5, 0.5}, bad};
        DistanceFieldQuery query{{}, pair_.instance_b(), 0.1, Rectangle{{0, 0}, {1, 1}}};
        query.points = points;
        expect_refused(std::vector{query}, StatusCode::invalid_query);
        const DistanceFieldResult result = run_alone(context(), query);
        EXPECT_NE(result.status.message().find("point 1"), std::string::npos)
            << result.status.text();
        EXPECT_TRUE(result.points.empty());
    }
}

TEST_F(Refusal, OfFieldsThatNeedTooMuch) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const Expected<ShapeHandle> shape = small->add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(shape.has_value());
    // A size that fits for distances alone does not fit with features and gradients.
    DistanceFieldQuery query{{}, {*shape, {}}, 0.0005, Rectangle{{0, 0}, {1, 1}}};
    query.technique = Technique::raster;
    EXPECT_TRUE(run_alone(*small, query).status.ok());
    query.features = query.gradients = true;
    EXPECT_EQ(run_alone(*small, query).status.code(), StatusCode::too_large);
    const std::vector<Vector2> points(1'000'000, Vector2{0.5, 0.5});
    query = {{}, {*shape, {}}, 0.01, Rectangle{{0, 0}, {1, 1}}};
    query.technique = Technique::raster;
    query.points = points;
    EXPECT_EQ(run_alone(*small, query).status.code(), StatusCode::too_large);
}

TEST_F(Refusal, OfUnknownShapes) {
    std::vector<PenetrationQuery> queries(3, pair_.penetration());
    queries[0].a.shape = {};
    queries[1].b.shape = {};
    queries[2].b.shape.generation += 1000;
    expect_refused(queries, StatusCode::unknown_shape);
    // Neither A nor a rectangle determines the area of the field.
    Batch batch;
    const auto field = batch.add(DistanceFieldQuery{{}, pair_.instance_b(), 0.1, std::nullopt});
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    EXPECT_FALSE(results[field].status.ok());
}

TEST_F(Refusal, OfShapes) {
    const std::vector<Rings> bad = {
        {},
        {{}},
        {{{0, 0}, {1, 1}}},
        {{{0, 0}, {1, 1}, {0, 0}, {1, 1}}},
        {{{0, 0}, {1, 1}, {2, 2}, {5, 5}}},
        {{{0, 0}, {1, 0}, {not_a_number, 1}}},
        {{{0, 0}, {1, 0}, {0, infinity}}},
        {{{0, 0}, {1, 0}, {0, 2 * largest_coordinate}}},
        {{{0, 0}, {1, 0}, {0, 1}}, {{0, 0}, {1, 1}}},
    };
    const ShapeHandle before = pair_.instance_a().shape;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        SCOPED_TRACE(i);
        const auto handle = context().add_shape(bad[i]);
        EXPECT_EQ(handle.error().code(), StatusCode::invalid_shape);
        EXPECT_FALSE(handle.error().message().empty());
        EXPECT_EQ(context().update_shape(before, bad[i]).code(), StatusCode::invalid_shape);
    }
    // A rejected update leaves the shape as it was.
    check_penetration(pair_, PenetrationPoints::boundary,
                      run_alone(context(), pair_.penetration()));
}

/// All numbers that a text contains.
std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < text.size();) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str() + i, &end);
        const auto used = static_cast<std::size_t>(end - (text.c_str() + i));
        if (used > 0) {
            numbers.push_back(value);
        }
        i += std::max<std::size_t>(used, 1);
    }
    return numbers;
}

TEST_F(Refusal, OfTolerancesTooSmallNamesTheSmallestPossible) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    Random random(1);
    const PlacedPair pair(
        *small,
        {{"A", star(random, 20, 0.5)}, {"B", star(random, 20, 0.5)}, {}, {{0.4, 0.2}, 0.5}, 1e-9});
    const auto refuse_then_run = [&](auto query) {
        Batch batch;
        batch.add(query);
        Results results;
        const Status refused = small->run(batch, results);
        ASSERT_EQ(refused.code(), StatusCode::too_large) << refused.text();
        EXPECT_EQ(results.timings.device + results.timings.decode, 0.0) << "refused after the work";
        bool works = false;
        std::string tried;
        for (const double named : numbers_in(refused.text())) {
            if (named > query.tolerance && named < 1.0 && !works) {
                query.tolerance = named * 1.01;
                const Status status = run_alone(*small, query).status;
                works = status.ok();
                tried += "\n  with " + std::to_string(query.tolerance) + ": " + status.text();
                query.tolerance = 1e-9;
            }
        }
        EXPECT_TRUE(works) << "no tolerance named that works: " << refused.text() << tried;
    };
    refuse_then_run(pair.penetration());
    for (const auto kind : {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
                            IntersectionKind::volume_volume}) {
        refuse_then_run(pair.intersection(kind));
    }
    refuse_then_run(DistanceFieldQuery{pair.instance_a(), pair.instance_b(), 1e-9, std::nullopt});
}

}  // namespace
}  // namespace nearfield::test
