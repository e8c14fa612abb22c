#include <engine/queries/empty_result.hpp>

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace nearfield::queries {
namespace {

/// A result with something in every member that an answer may leave alone.
template <class Result>
AnyResult full() {
    Result result;
    result.status = Status(StatusCode::invalid_query, "earlier");
    result.error_bound = 1.0;
    result.intersects = true;
    result.regions.resize(2);
    result.localization.nodes_evaluated = 3;
    result.localization.pairs_rejected = 4;
    return result;
}

template <class Result>
void expect_empty_summary(const Result& result) {
    EXPECT_TRUE(result.status.ok());
    EXPECT_EQ(result.error_bound, 0.0);
    EXPECT_FALSE(result.intersects);
    EXPECT_TRUE(result.regions.empty());
    EXPECT_EQ(result.localization.nodes_evaluated, 0U);
    EXPECT_EQ(result.localization.pairs_rejected, 0U);
}

TEST(MakeEmpty, OfPenetration) {
    AnyResult any = full<PenetrationResult>();
    auto& before = std::get<PenetrationResult>(any);
    before.count = 7;
    before.deepest.depth = 5.0;
    before.points.resize(7);
    const auto& result = make_empty<PenetrationResult>(any);
    expect_empty_summary(result);
    EXPECT_EQ(result.count, 0U);
    EXPECT_EQ(result.deepest.depth, 0.0);
    EXPECT_TRUE(result.points.empty());
    EXPECT_GE(result.points.capacity(), 7U) << "its memory is kept";
}

TEST(MakeEmpty, OfIntersection) {
    AnyResult any = full<IntersectionResult>();
    auto& before = std::get<IntersectionResult>(any);
    before.count = 7;
    before.area = 5.0;
    before.box = {{1.0, 2.0}, {3.0, 4.0}};
    before.samples.resize(7);
    const auto& result = make_empty<IntersectionResult>(any);
    expect_empty_summary(result);
    EXPECT_EQ(result.count, 0U);
    EXPECT_EQ(result.area, 0.0);
    EXPECT_EQ(result.box.max.x, Rectangle{}.max.x);
    EXPECT_TRUE(result.samples.empty());
}

TEST(MakeEmpty, OfADistanceField) {
    AnyResult any = full<DistanceFieldResult>();
    auto& before = std::get<DistanceFieldResult>(any);
    before.origin = {1.0, 2.0};
    before.width = before.height = 3;
    before.values.resize(9);
    before.features.resize(9);
    before.gradients.resize(18);
    before.unique.resize(9);
    before.points.resize(2);
    before.gradient_error_bound = 0.5;
    before.gradient_format = "earlier";
    const auto& result = make_empty<DistanceFieldResult>(any);
    expect_empty_summary(result);
    EXPECT_EQ(result.origin.x, 0.0);
    EXPECT_EQ(result.width, 0U);
    EXPECT_EQ(result.height, 0U);
    EXPECT_TRUE(result.values.empty());
    EXPECT_TRUE(result.features.empty());
    EXPECT_TRUE(result.gradients.empty());
    EXPECT_TRUE(result.unique.empty());
    EXPECT_TRUE(result.points.empty());
    EXPECT_EQ(result.gradient_error_bound, 0.0);
    EXPECT_EQ(std::string(result.gradient_format), "");
}

TEST(MakeEmpty, OfContacts) {
    AnyResult any = full<ContactResult>();
    auto& before = std::get<ContactResult>(any);
    before.count = 7;
    before.manifold.resize(2);
    before.points.resize(7);
    const auto& result = make_empty<ContactResult>(any);
    expect_empty_summary(result);
    EXPECT_EQ(result.count, 0U);
    EXPECT_TRUE(result.manifold.empty());
    EXPECT_TRUE(result.points.empty());
}

TEST(MakeEmpty, OfTheOthers) {
    AnyResult separation = full<SeparationResult>();
    std::get<SeparationResult>(separation).distance = 2.0;
    expect_empty_summary(make_empty<SeparationResult>(separation));
    EXPECT_EQ(std::get<SeparationResult>(separation).distance, 0.0);
    AnyResult impact = full<TimeOfImpactResult>();
    std::get<TimeOfImpactResult>(impact).time = 0.5;
    expect_empty_summary(make_empty<TimeOfImpactResult>(impact));
    EXPECT_EQ(std::get<TimeOfImpactResult>(impact).time, TimeOfImpactResult{}.time);
}

TEST(MakeEmpty, ReplacesAResultOfAnotherKind) {
    AnyResult any = full<ContactResult>();
    expect_empty_summary(make_empty<PenetrationResult>(any));
    EXPECT_TRUE(std::holds_alternative<PenetrationResult>(any));
}

TEST(CutShort, LeavesAStatusAlone) {
    AnyResult any = full<PenetrationResult>();
    std::get<PenetrationResult>(any).count = 7;
    cut_short(Status(StatusCode::cancelled, "now"), any);
    const auto& result = std::get<PenetrationResult>(any);
    EXPECT_EQ(result.status.code(), StatusCode::cancelled);
    EXPECT_EQ(result.count, 0U);
    EXPECT_TRUE(result.regions.empty());
}

}  // namespace
}  // namespace nearfield::queries
