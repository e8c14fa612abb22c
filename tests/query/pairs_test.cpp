#include <tests/query/query_test.hpp>

#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

class Pairs : public QueryTest {};

TEST_F(Pairs, AreThoseWhoseBoxesAreWithinReach) {
    const auto square = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(square.ok());
    const std::vector<Instance> instances{{*square, {{0, 0}, 0.0}},
                                          {*square, {{1, 0.5}, 0.0}},  // touches the first
                                          {*square, {{3, 0}, 0.0}},
                                          {*square, {{3.9, 0.2}, 0.0}}};
    std::vector<InstancePair> pairs;
    ASSERT_TRUE(context().find_pairs(instances, 0.0, pairs).ok());
    EXPECT_EQ(pairs, (std::vector<InstancePair>{{0, 1}, {2, 3}}));
    ASSERT_TRUE(context().find_pairs(instances, 1.0, pairs).ok());
    EXPECT_EQ(pairs, (std::vector<InstancePair>{{0, 1}, {1, 2}, {2, 3}}));
    ASSERT_TRUE(context().find_pairs({}, 1.0, pairs).ok());
    EXPECT_TRUE(pairs.empty());
    ASSERT_TRUE(context().remove_shape(*square).ok());
}

TEST_F(Pairs, OfBadInstancesAreRefusedByPosition) {
    const auto square = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(square.ok());
    std::vector<Instance> instances(3, {*square, {}});
    std::vector<InstancePair> pairs;
    instances[1].pose.angle = std::nan("");
    Status status = context().find_pairs(instances, 0.0, pairs);
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("instance 1"), std::string::npos) << status.message();
    instances[1] = {};
    status = context().find_pairs(instances, 0.0, pairs);
    EXPECT_EQ(status.code(), StatusCode::unknown_shape);
    const double bad[] = {-1.0, std::nan(""), std::numeric_limits<double>::infinity()};
    for (const double reach : bad) {
        EXPECT_EQ(context().find_pairs({}, reach, pairs).code(), StatusCode::invalid_query);
    }
    ASSERT_TRUE(context().remove_shape(*square).ok());
}

}  // namespace
}  // namespace nearfield::test
