#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

template <class... Queries>
constexpr bool are_aggregates(const std::variant<Queries...>*) {
    return (std::is_aggregate_v<Queries> && ...);
}
static_assert(are_aggregates(static_cast<const AnyQuery*>(nullptr)));
static_assert(std::is_aggregate_v<Results>);

template <class... Queries>
constexpr bool results_match(const std::variant<Queries...>*) {
    return std::is_same_v<AnyResult, std::variant<typename Queries::Result...>>;
}
static_assert(results_match(static_cast<const AnyQuery*>(nullptr)));

/// Of every kind of query: what a handle that names no query of the results finds.
template <class... Queries>
void expect_none(const std::variant<Queries...>* /*kinds*/, const Results& results,
                 std::uint32_t index, const std::string& words) {
    const auto expect = [&](const auto& result) {
        EXPECT_EQ(result.status.code(), StatusCode::invalid_query);
        EXPECT_NE(result.status.message().find(words), std::string::npos) << result.status.text();
    };
    (expect(results[QueryHandle<Queries>{index}]), ...);
}

constexpr const AnyQuery* every_query_kind = nullptr;

TEST(Results, HaveNoneForAHandleOutOfRange) {
    Results results;
    expect_none(every_query_kind, results, 0, "out of range");
    results.results.emplace_back(SeparationResult{});
    expect_none(every_query_kind, results, 1, "out of range");
    expect_none(every_query_kind, results, QueryHandle<SeparationQuery>().index, "out of range");
    EXPECT_TRUE(results[QueryHandle<SeparationQuery>{0}].status.ok());
}

TEST(Results, HaveNoneForAHandleOfAnotherKind) {
    Expected<Context> context = Context::create_cpu();
    ASSERT_TRUE(context.has_value()) << context.error().text();
    const Expected<ShapeHandle> shape =
        context->add_shape(std::vector<Ring>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    ASSERT_TRUE(shape.has_value()) << shape.error().text();
    Batch batch;
    const auto test = batch.add(IntersectionTestQuery{.a = {*shape, {}}, .b = {*shape, {}}});
    Results results;
    ASSERT_TRUE(context->run(batch, results).ok());
    EXPECT_TRUE(results[test].intersects);
    const Results& answered = results;
    EXPECT_EQ(&answered[test], &std::get<IntersectionTestResult>(results.results[0]));
    const SeparationResult& none = results[QueryHandle<SeparationQuery>{test.index}];
    EXPECT_EQ(none.status.code(), StatusCode::invalid_query);
    EXPECT_NE(none.status.message().find("another kind"), std::string::npos) << none.status.text();
    EXPECT_EQ(none.distance, 0.0);
}

TEST(ExpectedValue, IsThereOrAnErrorIs) {
    const Expected<int> seven = 7;
    EXPECT_TRUE(seven);
    EXPECT_TRUE(seven.has_value());
    EXPECT_EQ(*seven, 7);
    EXPECT_TRUE(seven.error().ok());
    const Expected<int> none = Status(StatusCode::too_large, "eight");
    EXPECT_FALSE(none);
    EXPECT_FALSE(none.has_value());
    EXPECT_EQ(none.error().code(), StatusCode::too_large);
    EXPECT_EQ(none.error().message(), "eight");
    static_assert(!std::is_convertible_v<Expected<int>, bool>);
    static_assert(std::is_same_v<decltype(*Expected<std::string>("")), std::string&&>);
    EXPECT_EQ(Expected<std::string>("nine")->size(), 4U);
}

}  // namespace
}  // namespace nearfield::test
