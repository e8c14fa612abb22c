#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <variant>
#include <vector>

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
    void expect_refused(const std::vector<AnyQuery>& bad, StatusCode code,
                        const std::string& words = {}) {
        Batch batch;
        const auto first = batch.add(pair_.penetration());
        for (const AnyQuery& any : bad) {
            std::visit([&](const auto& query) { batch.add(query); }, any);
        }
        const auto last = batch.add(pair_.intersection(IntersectionKind::volume_volume));
        Results results;
        const Status status = context().run(batch, results);
        ASSERT_TRUE(status.ok()) << status.text();
        for (std::size_t i = 0; i < bad.size(); ++i) {
            SCOPED_TRACE("kind " + std::to_string(bad[i].index()));
            const Status refused = std::visit([](const auto& result) { return result.status; },
                                              results.results[1 + i]);
            EXPECT_EQ(refused.code(), code) << "query " << i << ": " << refused.text();
            EXPECT_FALSE(refused.message().empty()) << "query " << i;
            EXPECT_NE(refused.message().find(words), std::string::npos) << refused.text();
        }
        check_penetration(pair_, PenetrationPoints::boundary, results[first]);
        check_intersection(pair_, IntersectionKind::volume_volume, results[last]);
    }
    /// The same for each kind of query that `spoil` applies to.
    template <class Spoil>
    void expect_each_refused(const Spoil& spoil, StatusCode code, const std::string& words = {}) {
        const Instance a = pair_.instance_a();
        const Instance b = pair_.instance_b();
        std::vector<AnyQuery> bad;
        for (AnyQuery any : std::initializer_list<AnyQuery>{
                 pair_.penetration(), pair_.intersection(IntersectionKind::boundary_volume),
                 DistanceFieldQuery{a, b, 0.1, std::nullopt}, pair_.contacts(0.1),
                 pair_.separation(), pair_.closest_point(), IntersectionTestQuery{a, b},
                 TimeOfImpactQuery{a, b, {{5.0, 0.0}, 0.0}, {}, 0.1},
                 SeparationVectorQuery{a, b, 0.1}, ContainmentQuery{a, b}}) {
            std::visit(
                [&](auto& query) {
                    if constexpr (requires { spoil(query); }) {
                        spoil(query);
                        bad.push_back(any);
                    }
                },
                any);
        }
        ASSERT_FALSE(bad.empty());
        expect_refused(bad, code, words);
    }

    PlacedPair pair_;
};

TEST_F(Refusal, OfTolerances) {
    for (const double tolerance : {0.0, -1.0, not_a_number, infinity, -infinity}) {
        expect_each_refused(
            [=](auto& query) requires requires { query.tolerance; } {
                query.tolerance = tolerance;
            },
            StatusCode::invalid_query, "tolerance");
    }
}

TEST_F(Refusal, OfPoses) {
    for (const double bad : {not_a_number, infinity, -infinity, 1e300}) {
        const auto refuse = [&](const auto& spoil) {
            expect_each_refused(spoil, StatusCode::invalid_query);
        };
        refuse([=](auto& query) { query.a.pose.translation.x = bad; });
        refuse([=](auto& query) { query.b.pose.translation.y = bad; });
        if (bad != 1e300) {  // an angle of any size
            refuse([=](auto& query) { query.a.pose.angle = bad; });
            refuse([=](auto& query) { query.b.pose.angle = bad; });
        }
    }
}

TEST_F(Refusal, OfContactDistances) {
    for (const double distance : {-1.0, not_a_number, infinity}) {
        expect_each_refused(
            [=](auto& query) requires requires { query.contact_distance; } {
                query.contact_distance = distance;
            },
            StatusCode::invalid_query, "contact distance");
    }
    expect_refused({pair_.contacts(0.0)}, StatusCode::invalid_query, "contact distance");
}

TEST_F(Refusal, OfUnknownShapes) {
    const auto refuse = [&](const auto& spoil) {
        expect_each_refused(spoil, StatusCode::unknown_shape);
    };
    refuse([](auto& query) { query.a.shape.generation += 1000; });
    refuse([](auto& query) { query.b.shape = {}; });
    refuse([](auto& query) { query.b.shape.generation += 1000; });
    // Neither A nor a rectangle determines the area of the field.
    const DistanceFieldQuery field{{}, pair_.instance_b(), 0.1, std::nullopt};
    EXPECT_FALSE(run_alone(context(), field).status.ok());
}

TEST_F(Refusal, OfTechniquesThatDoNotAnswer) {
    for (const Technique technique : device_techniques) {
        const auto refuse = [&]<class Query>(Query query, const std::string& what) {
            query.a = pair_.instance_a();
            query.b = pair_.instance_b();
            query.technique = technique;
            expect_refused({query}, StatusCode::invalid_query,
                           std::string(to_string(technique)) + " does not answer " + what);
        };
        refuse(IntersectionTestQuery{}, "intersection tests");
        refuse(TimeOfImpactQuery{.tolerance = 0.1}, "times of impact");
        refuse(SeparationVectorQuery{.tolerance = 0.1}, "separation vectors");
        refuse(ContainmentQuery{}, "containment");
    }
}

TEST_F(Refusal, OfRectangles) {
    std::vector<AnyQuery> queries;
    for (const Rectangle& rectangle :
         {Rectangle{{1, 0}, {0, 1}}, Rectangle{{0, 1}, {1, 0}},
          Rectangle{{not_a_number, 0}, {1, 1}}, Rectangle{{0, 0}, {1, infinity}}}) {
        queries.emplace_back(DistanceFieldQuery{{}, pair_.instance_b(), 0.1, rectangle});
    }
    expect_refused(queries, StatusCode::invalid_query);
}

TEST_F(Refusal, OfFieldsThatAskForNothing) {
    DistanceFieldQuery query{{}, pair_.instance_b(), 0.1, Rectangle{{0, 0}, {1, 1}}};
    query.values = false;
    expect_refused({query}, StatusCode::invalid_query);
    EXPECT_NE(run_alone(context(), query).status.message().find("asks for nothing"),
              std::string::npos);
}

TEST_F(Refusal, OfPointsOutsideTheField) {
    for (const Vector2& bad : {Vector2{-0.3, 0.5}, Vector2{0.5, 1.3}, Vector2{not_a_number, 0.5},
                               Vector2{0.5, -infinity}, Vector2{0.5, 1e300}}) {
        const std::vector<Vector2> points{{0.5, 0.5}, bad};
        DistanceFieldQuery query{{}, pair_.instance_b(), 0.1, Rectangle{{0, 0}, {1, 1}}};
        query.points = points;
        expect_refused({query}, StatusCode::invalid_query);
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
