#include "cli_test.hpp"
#include "contract.hpp"

#include <cstddef>
#include <numbers>

namespace nearfield::test {
namespace {

class Contacts : public CliTest {};

TEST_F(Contacts, OfSquaresSideBySide) {
    const Json json = answer(squares("contacts") + Arguments{"-d", "0.02", "--contact-distance",
                                                             "0.05", "--pose-b", "1.03,0.4,0"});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "contacts", 0.02, 0.02 * std::numbers::sqrt2);
    EXPECT_EQ(json.at("intersects"), false);
    ASSERT_EQ(json.at("count").get<std::size_t>(), json.at("contacts").size());
    std::size_t of_a = 0;
    for (const Json& contact : json.at("contacts")) {
        const bool on_a = contact.at("on") == "a";
        of_a += on_a ? 1U : 0U;
        const double x = contact.at("point").at(0).get<double>();
        if (on_a ? x > 0.999 : x < 1.031) {  // on the sides that face each other
            EXPECT_NEAR(x, on_a ? 1.0 : 1.03, rounding) << contact;
            EXPECT_GE(contact.at("distance").get<double>(), 0.03 - rounding) << contact;
        }
        EXPECT_LE(contact.at("distance").get<double>(), 0.05);
        EXPECT_EQ(contact.at("inside"), false);
        EXPECT_LT(contact.at("normal").at(0).get<double>(), 0.0) << "B is to the right";
    }
    EXPECT_GT(of_a, 0U);
    EXPECT_LT(of_a, json.at("contacts").size());
    ASSERT_EQ(json.at("manifold").size(), 1U);
    const Json& cluster = json.at("manifold").front();
    EXPECT_NEAR(cluster.at("first").at(0).get<double>(), 1.0, rounding);
    EXPECT_NEAR(cluster.at("last").at(0).get<double>(), 1.0, rounding);
    EXPECT_NEAR(cluster.at("extreme").at("distance").get<double>(), 0.03, rounding);
    EXPECT_LT(cluster.at("normal").at(0).get<double>(), -0.99);
}

TEST_F(Contacts, DistanceIsTheToleranceByDefault) {
    for (const auto& [gap, any] : {std::pair{"1.04", true}, std::pair{"1.06", false}}) {
        const Json json = answer(squares("contacts") +
                                 Arguments{"-d", "0.05", "--pose-b", std::string(gap) + ",0.1,0"});
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(json.at("count").get<std::size_t>() > 0, any) << gap;
    }
}

class ClosestPoints : public CliTest {};

TEST_F(ClosestPoints, SeparationOfSquaresByACorner) {
    const Json json = answer(squares("separation") + Arguments{"-d", "0.1", "--pose-b", "4,5,0"});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "separation", 0.1, 0.1 * std::numbers::sqrt2);
    EXPECT_EQ(json.at("intersects"), false);
    EXPECT_DOUBLE_EQ(json.at("distance").get<double>(), 5.0);
    EXPECT_EQ(json.at("point_a"), Json({1.0, 1.0}));
    EXPECT_EQ(json.at("point_b"), Json({4.0, 5.0}));
    EXPECT_NEAR(json.at("direction").at(0).get<double>(), 0.6, rounding);
    EXPECT_NEAR(json.at("direction").at(1).get<double>(), 0.8, rounding);
    EXPECT_EQ(json.at("feature_a").at("vertex"), 2);
    EXPECT_EQ(json.at("feature_b").at("vertex"), 0);
    EXPECT_EQ(json.at("unique"), true);
    EXPECT_FALSE(json.at("regions").empty());
}

TEST_F(ClosestPoints, ClosestPointIsThatOfA) {
    const Json json =
        answer(squares("closest-point") + Arguments{"-d", "0.1", "--pose-b", "4,5,0"});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "closest-point", 0.1, 0.1 * std::numbers::sqrt2);
    EXPECT_EQ(json.at("point"), Json({1.0, 1.0}));
    EXPECT_EQ(json.at("nearest"), Json({4.0, 5.0}));
    EXPECT_DOUBLE_EQ(json.at("distance").get<double>(), 5.0);
}

}  // namespace
}  // namespace nearfield::test
