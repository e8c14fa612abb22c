#include <tests/query/query_test.hpp>

#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

class Pairs : public QueryTest {};

TEST_F(Pairs, AreThoseWhoseBoxesAreWithinReach) {
    const auto square = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(square.has_value());
    const std::vector<Instance> instances{{*square, {{0, 0}, 0.0}},
                                          {*square, {{1, 0.5}, 0.0}},  // touches the first
                                          {*square, {{3, 0}, 0.0}},
                                          {*square, {{3.9, 0.2}, 0.0}}};
    const auto pairs_within = [&](std::span<const Instance> all, double reach) {
        const Expected<std::span<const InstancePair>> pairs =
            context().find_overlapping_boxes(all, reach);
        EXPECT_TRUE(pairs.has_value()) << pairs.error().text();
        return std::vector<InstancePair>(pairs->begin(), pairs->end());
    };
    EXPECT_EQ(pairs_within(instances, 0.0), (std::vector<InstancePair>{{0, 1}, {2, 3}}));
    EXPECT_EQ(pairs_within(instances, 1.0), (std::vector<InstancePair>{{0, 1}, {1, 2}, {2, 3}}));
    EXPECT_TRUE(pairs_within({}, 1.0).empty());
    ASSERT_TRUE(context().remove_shape(*square).ok());
}

TEST_F(Pairs, FollowShapesThatChangeAndInstancesThatMove) {
    const auto shape = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(shape.has_value());
    std::vector<Instance> instances{{*shape, {{0, 0}, 0.0}}, {*shape, {{3, 0}, 0.0}}};
    const auto count = [&] {
        const Expected<std::span<const InstancePair>> pairs =
            context().find_overlapping_boxes(instances, 0.0);
        EXPECT_TRUE(pairs.has_value()) << pairs.error().text();
        return pairs->size();
    };
    EXPECT_EQ(count(), 0U);
    ASSERT_TRUE(context().update_shape(*shape, rectangle({0, 0}, {4, 1})).ok());
    EXPECT_EQ(count(), 1U);
    ASSERT_TRUE(context().update_shape(*shape, rectangle({0, 0}, {2, 1})).ok());
    EXPECT_EQ(count(), 0U);
    instances[1].pose.translation.x = 1.5;
    EXPECT_EQ(count(), 1U);
    ASSERT_TRUE(context().remove_shape(*shape).ok());
}

TEST_F(Pairs, OfBadInstancesAreRefusedByPosition) {
    const auto square = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(square.has_value());
    std::vector<Instance> instances(3, {*square, {}});
    instances[1].pose.angle = std::nan("");
    Status status = context().find_overlapping_boxes(instances, 0.0).error();
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("instance 1"), std::string::npos) << status.message();
    instances[1] = {};
    status = context().find_overlapping_boxes(instances, 0.0).error();
    EXPECT_EQ(status.code(), StatusCode::unknown_shape);
    const double bad[] = {-1.0, std::nan(""), std::numeric_limits<double>::infinity()};
    for (const double reach : bad) {
        EXPECT_EQ(context().find_overlapping_boxes({}, reach).error().code(),
                  StatusCode::invalid_query);
    }
    ASSERT_TRUE(context().remove_shape(*square).ok());
}

}  // namespace
}  // namespace nearfield::test
