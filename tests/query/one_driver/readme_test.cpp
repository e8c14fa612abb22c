#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

namespace {

/// The examples of README.md, word for word between the lines; the first one is examples/hello,
/// which the package tests build and run.
TEST(Readme, TheExamplesWork) {
    const std::vector<nearfield::Ring> arrow_rings{
        {{0, -1}, {4, -1}, {4, -2}, {7, 0}, {4, 2}, {4, 1}, {0, 1}}};
    const std::vector<nearfield::Ring> channel_rings{
        {{0, -5}, {10, -5}, {10, 5}, {0, 5}, {0, 3}, {8, 3}, {8, -3}, {0, -3}}};
    nearfield::Context context;
    const auto arrow = context.add_shape(arrow_rings);
    const auto channel = context.add_shape(channel_rings);
    const nearfield::Pose pose{.translation = {1.5, 0.5}, .angle = 0.0};
    std::uint32_t shown = 0;
    const auto show = [&](const nearfield::PenetrationResult& result) { shown = result.count; };

    // ----
    nearfield::Batch batch;
    auto query = batch.add(
        nearfield::PenetrationQuery{.a = {arrow, pose}, .b = {channel}, .tolerance = 0.1});
    nearfield::Results results;
    auto ticket = context.submit(batch);  // no wait for the device; batch and shapes may change
    // ... the rest of the frame; is_ready(*ticket) polls, collect() waits:
    if (nearfield::Status status = context.collect(*ticket, results); !status.ok()) {
        std::puts(status.text().c_str());
    } else {
        show(results[query]);  // a nearfield::PenetrationResult
    }
    // ----

    EXPECT_TRUE(context.is_ready(*ticket));
    EXPECT_GT(shown, 0U);
    EXPECT_EQ(results[query].deepest.depth, 0.5);

    const std::array<nearfield::Pose, 3> steps{{{{-9.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}, pose}};
    std::size_t solved = 0;
    const auto solve = [&](nearfield::InstanceHandle, nearfield::InstanceHandle,
                           std::span<const nearfield::ContactCluster> manifold) {
        solved += manifold.size();
    };

    // ----
    nearfield::World world(context);
    auto crate = world.add({.shape = arrow, .pose = pose});
    auto wall = world.add({.shape = channel});
    nearfield::PairTable contacts(
        nearfield::ContactQuery{.tolerance = 0.01, .contact_distance = 0.02}, {.hits_only = true});
    for (const nearfield::Pose& step : steps) {
        nearfield::Status status = world.move(*crate, step);
        if (status.ok()) {
            status = world.update(contacts);
        }
        if (!status.ok()) {
            std::puts(status.text().c_str());
            return;
        }
        for (const auto& pair : contacts.rows()) {
            solve(pair.a, pair.b, contacts.manifold(pair));
        }
    }
    // ----

    EXPECT_TRUE(wall.has_value());
    EXPECT_GT(solved, 0U);
}

}  // namespace
