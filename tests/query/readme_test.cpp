#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

/// The examples of README.md, word for word between the lines.
TEST(Readme, TheExampleWorks) {
    const std::vector<nearfield::Ring> rings_of_a{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};
    const std::vector<nearfield::Ring> rings_of_b{{{-60, -60}, {60, -60}, {60, 60}, {-60, 60}}};
    double deepest = 0.0;
    const auto push = [&](nearfield::Vector2, nearfield::Vector2, double depth) {
        deepest = std::max(deepest, depth);
    };
    std::uint32_t shown = 0;
    const auto show = [&](const nearfield::PenetrationResult& result) { shown = result.count; };

    // ----
    auto context = nearfield::Context::create_cpu();  // or create(), with your own Vulkan device
    auto a = context->add_shape(rings_of_a);          // std::vector<nearfield::Ring>
    auto b = context->add_shape(rings_of_b);

    auto answer = context->answer(nearfield::PenetrationQuery{
        .a = {*a, {}}, .b = {*b, {.translation = {120, 20}, .angle = 0.5}}, .tolerance = 0.8});
    if (!answer) {
        std::puts(answer.error().text().c_str());
        return;
    }
    for (const nearfield::PenetrationRecord& record : answer->records) {
        push(record.point, record.direction, record.depth);
    }
    // ----

    EXPECT_TRUE(answer->intersects);
    EXPECT_EQ(deepest, answer->deepest.depth);
    EXPECT_GT(deepest, 10.0);

    // ----
    nearfield::Batch batch;
    auto query = batch.add(nearfield::PenetrationQuery{
        .a = {*a, {}}, .b = {*b, {.translation = {120, 20}, .angle = 0.5}}, .tolerance = 0.8});
    nearfield::Results results;
    auto ticket = context->submit(batch);  // no wait; batch and shapes are free to change
    // ... the rest of the frame; then, when is_ready(*ticket) says so, or at once:
    if (nearfield::Status status = context->collect(*ticket, results); !status.ok()) {
        std::puts(status.text().c_str());
    } else {
        show(results[query]);  // a nearfield::PenetrationResult
    }
    // ----

    EXPECT_TRUE(context->is_ready(*ticket));
    EXPECT_EQ(shown, answer->count);
    EXPECT_EQ(results[query].deepest.depth, answer->deepest.depth);
}

}  // namespace
