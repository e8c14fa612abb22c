#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

const std::vector<Ring> whole_square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

std::vector<Ring> with_a_bad_number() {
    std::vector<Ring> rings = whole_square;
    rings[0][2].y = std::numeric_limits<double>::quiet_NaN();
    return rings;
}

void expect_reason(const Status& status, const std::string& where, const Status& reason) {
    EXPECT_EQ(status.code(), reason.code()) << status.text();
    EXPECT_NE(status.message().find(where), std::string::npos) << status.text();
    EXPECT_NE(status.message().find(reason.message()), std::string::npos) << status.text();
}

TEST(RefusedShapes, AreNamedByWhatIsAskedAboutThem) {
    Context context;
    const auto good = context.add_shape(whole_square);
    const auto bad = context.add_shape(with_a_bad_number());
    ASSERT_TRUE(good.has_value());
    ASSERT_FALSE(bad.has_value());
    ASSERT_EQ(bad.error().code(), StatusCode::invalid_shape);
    const auto separation = [&](ShapeHandle a, ShapeHandle b) {
        const auto answer =
            context.answer(SeparationQuery{.a = {a}, .b = {b, {{3, 0}, 0}}, .tolerance = 0.1});
        return answer.error();
    };
    EXPECT_TRUE(separation(good, good).ok());
    expect_reason(separation(bad, good), "shape A", bad.error());
    expect_reason(separation(good, bad), "shape B", bad.error());
    expect_reason(context.update_shape(bad, whole_square), "update_shape", bad.error());
    expect_reason(context.remove_shape(bad), "remove_shape", bad.error());
    const std::vector<Instance> instances{{good}, {bad}};
    expect_reason(context.find_overlapping_boxes(instances, 0.0).error(), "instance 1",
                  bad.error());
    Expected<World> world = World::create(context);
    expect_reason(world->add({.shape = bad}).error(), "add", bad.error());
    // Another one has its own reason.
    const auto empty = context.add_shape(std::vector<Ring>());
    expect_reason(separation(empty, good), "shape A", empty.error());
    EXPECT_NE(empty.error().message(), bad.error().message());
    expect_reason(separation(bad, good), "shape A", bad.error());
}

TEST(RefusedShapes, OfLongAgoAreRefusedWithoutWords) {
    Context context;
    const auto first = context.add_shape(with_a_bad_number());
    const auto second = context.add_shape(with_a_bad_number());
    for (int i = 0; i < 63; ++i) {
        EXPECT_FALSE(context.add_shape(std::vector<Ring>()).has_value());
    }
    const Status forgotten = context.update_shape(first, whole_square);
    EXPECT_EQ(forgotten.code(), StatusCode::unknown_shape);
    EXPECT_NE(forgotten.message().find("refused by add_shape"), std::string::npos);
    EXPECT_EQ(context.update_shape(second, whole_square).code(), StatusCode::invalid_shape);
}

TEST(RefusedShapes, OfAnotherContextAreOfAnotherContext) {
    Context context;
    Context other;
    const auto bad = other.add_shape(with_a_bad_number());
    const Status status = context.remove_shape(bad);
    EXPECT_EQ(status.code(), StatusCode::unknown_shape);
    EXPECT_NE(status.message().find("another context"), std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
