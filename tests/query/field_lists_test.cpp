#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/field_laws.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

namespace nearfield::test {
namespace {

constexpr std::uint64_t field_lists_seed = 2718;

/// Devices that run on the CPU list the edges near each block by one thread, others by workgroups.
/// Here the device claims to be of the other kind, and both ways have to give the same fields.
class FieldLists : public FieldLaws {
protected:
    void SetUp() override {
        test_support::Lies lies;
        lies.properties = [](VkPhysicalDeviceProperties& properties) {
            properties.deviceType = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
                                        ? VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU
                                        : VK_PHYSICAL_DEVICE_TYPE_CPU;
        };
        loader_.emplace(host_device(), std::move(lies));
        Expected<Context> made = Context::create(loader_->host(), on_demand());
        ASSERT_TRUE(made.has_value()) << made.error().text();
        other_.emplace(std::move(*made));
    }
    void TearDown() override {
        other_.reset();
        loader_.reset();
        FieldLaws::TearDown();
    }

    void check(const Rings& rings, const Pose& pose, double tolerance, const Rectangle& box,
               bool features) {
        SCOPED_TRACE(to_text(rings) + " d = " + std::to_string(tolerance));
        const PlacedShape shape(context(), rings, pose);
        const PlacedShape others(*other_, rings, pose);
        DistanceFieldQuery query;
        query.tolerance = tolerance;
        query.rectangle = box;
        query.features = query.gradients = features;
        query.technique = Technique::compute;
        query.b = shape.instance();
        const DistanceFieldResult expected = run_alone(context(), query);
        query.b = others.instance();
        const DistanceFieldResult result = run_alone(*other_, query);
        EXPECT_NE(*describe_graph(context(), GraphFormat::text),
                  *describe_graph(*other_, GraphFormat::text))
            << "the same passes";
        check_same(expected, result);
        check_field(others.oracle(), tolerance, result, 1000);
        if (features) {
            check_cells(others.oracle(), query, result, 500);
        }
    }

    /// Expects the same bits each time.
    void check_repeats(const Rings& rings, double tolerance, bool features) {
        const PlacedShape shape(*other_, rings, {});
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = tolerance;
        query.rectangle = Rectangle{{-1.5, -1.4}, {1.4, 1.5}};
        query.features = query.gradients = features;
        query.technique = Technique::compute;
        const DistanceFieldResult first = run_alone(*other_, query);
        EXPECT_TRUE(first.status.ok()) << first.status.text();
        for (int i = 0; i < 5; ++i) {
            const DistanceFieldResult next = run_alone(*other_, query);
            EXPECT_EQ(next.values, first.values);
            EXPECT_TRUE(std::equal(next.features.begin(), next.features.end(),
                                   first.features.begin(), first.features.end(),
                                   [](const Feature& a, const Feature& b) {
                                       return a.kind == b.kind && a.index == b.index;
                                   }));
            EXPECT_EQ(next.gradients, first.gradients);
            EXPECT_EQ(next.unique, first.unique);
        }
    }

    static void check_same(const DistanceFieldResult& expected, const DistanceFieldResult& result) {
        ASSERT_TRUE(expected.status.ok()) << expected.status.text();
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        ASSERT_EQ(result.values.size(), expected.values.size());
        Report report("values by other lists");
        for (std::size_t i = 0; i < result.values.size(); ++i) {
            const float most =
                1e-5F * std::max(std::abs(expected.values[i]), static_cast<float>(result.cell));
            report.require(std::abs(result.values[i] - expected.values[i]) <= most, "cell ", i,
                           ": ", result.values[i], " and ", expected.values[i]);
        }
    }

private:
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> other_;
};

TEST_F(FieldLists, OfRandomShapes) {
    for_each_case(field_lists_seed, 20, [&](Random& random) {
        const Pair pair = any_pair(random);
        const Rectangle box = oracle::ShapeOracle(pair.b.rings, pair.pose_b).box();
        const double size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        const Vector2 low{box.min.x + size * random.between(-0.5, 0.8),
                          box.min.y + size * random.between(-0.5, 0.8)};
        const Vector2 high{low.x + size * random.scale(0.02, 1.5),
                           low.y + size * random.scale(0.02, 1.5)};
        check(pair.b.rings, pair.pose_b, size * random.scale(0.004, 0.2), {low, high},
              random.whole(0, 2) == 0);
    });
}

TEST_F(FieldLists, OfEveryFamilyAndDegenerateShapes) {
    for (const auto& [name, rings] : every_family(field_lists_seed)) {
        SCOPED_TRACE(name);
        check(rings, {{1e6, -1e6}, 0.4}, 0.02, {{1e6 - 1.3, -1e6 - 1.2}, {1e6 + 1.2, -1e6 + 1.3}},
              false);
        check(rings, {}, 0.06, {{-1.3, -1.2}, {1.2, 1.3}}, true);
    }
    constexpr std::uint32_t cells = 40;
    for (const auto& [name, rings] : degenerate_shapes(context(), cells, field_lists_seed)) {
        SCOPED_TRACE(name);
        check(rings, {}, 1.0 / std::numbers::sqrt2, {{0, 0}, {cells, cells}}, true);
    }
}

/// Of several levels of boxes, and several rounds of each list.
TEST_F(FieldLists, OfLargeShapes) {
    Random random(field_lists_seed);
    for (const int vertices : {600, 9000, 60000}) {
        check(coast(random, vertices, 0.6), {}, 0.01, {{-1.5, -1.4}, {1.4, 1.5}}, false);
    }
    check(coast(random, 9000, 0.6), {}, 0.03, {{-1.5, -1.4}, {1.4, 1.5}}, true);
    check(star(random, 5000, 0.2), {}, 0.02, {{-1.1, -1.2}, {1.2, 1.1}}, true);
}

TEST_F(FieldLists, AreTheSameEveryTime) {
    Random random(field_lists_seed);
    check_repeats(coast(random, 6000, 0.5), 0.01, false);
    check_repeats(coast(random, 2000, 0.5), 0.03, true);
    check_repeats(star(random, 50, 0.4), 0.02, true);
}

TEST_F(FieldLists, WithoutRoom) {
    // A region without room; a quarter without; blocks with more edges than a workgroup lists.
    check(regular(8000), {}, 0.002, {{-0.04, -0.03}, {0.03, 0.05}}, false);
    check(regular(500), {}, 0.002, {{-0.04, -0.03}, {0.03, 0.05}}, true);
    for (const int teeth : {100, 250, 400, 600}) {
        Ring comb;
        for (int i = 0; i < teeth; ++i) {
            comb.push_back({i * 20.0 / teeth, i % 2 == 0 ? 0.0 : 10.0});
        }
        comb.push_back({20.0, -1.0});
        comb.push_back({0.0, -1.0});
        check({comb}, {{0.3, 0.2}, 0.1}, 0.5, {{-3, -3}, {16, 10}}, true);
    }
}

TEST_F(FieldLists, OfManyRings) {
    Rings crowd;
    constexpr int across = 90;
    for (int i = 0; i < across * across; ++i) {
        const Vector2 low{(i % across) / 100.0 - 0.5,
                          static_cast<double>(i / across) / 100.0 - 0.5};
        crowd.push_back(
            {low, {low.x + 1e-4, low.y}, {low.x + 1e-4, low.y + 1e-4}, {low.x, low.y + 1e-4}});
    }
    check(crowd, {}, 0.01, {{-0.7, -0.6}, {0.5, 0.5}}, true);
    check(crowd, {}, 0.05, {{-0.7, -0.6}, {0.5, 0.5}}, false);
    // Nested squares, each of four long edges.
    Rings nested;
    for (int i = 1; i <= 400; ++i) {
        const double side = i / 400.0;
        nested.push_back({{-side, -side}, {side, -side}, {side, side}, {-side, side}});
    }
    check(nested, {{}, 0.3}, 0.02, {{-1.2, -1.2}, {1.2, 1.2}}, true);
}

TEST_F(FieldLists, WhateverIsLeftOfTheLastBlock) {
    Random random(field_lists_seed);
    const Rings shape = coast(random, 300, 0.5);
    const double d = 0.01;
    const double cell = d * std::numbers::sqrt2;
    for (const int columns : {1, 15, 17, 33, 49, 65}) {
        const int rows = random.whole(1, 70);
        const Vector2 low{random.between(-1.0, 0.5), random.between(-1.0, 0.5)};
        check(shape, {}, d, {low, {low.x + (columns - 0.5) * cell, low.y + (rows - 0.5) * cell}},
              columns % 3 == 0);
    }
    check(scaled_and_moved(shape, 20.0, {}), {}, 0.5, {{500.0, -600.0}, {540.0, -580.0}}, true);
}

}  // namespace
}  // namespace nearfield::test
