#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/run_on_threads.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::test {
namespace {

/// More than several jobs take at a time, so that lists are put together from many parts.
constexpr std::size_t many = 6000;

struct Inputs {
    explicit Inputs(const Scene& scene) {
        Random random(8);
        const Rectangle box = box_of(scene.placements());
        for (std::size_t i = 0; i < many; ++i) {
            const Vector2 point = any_point(random, scene, box);
            points.push_back(point);
            segments.push_back({point, any_point(random, scene, box)});
            rectangles.push_back({point, {point.x + 0.3, point.y + 0.2}});
            poses.push_back({point, random.between(-3.0, 3.0)});
            // Most of them come near nothing.
            const double away = i % 50 == 0 ? 0.0 : 1e5;
            sweeps.push_back({{{point.x + away, point.y}, 0.0}, {{point.x + away, 0.0}, 1.0}});
        }
    }

    std::vector<Vector2> points;
    std::vector<Segment> segments;
    std::vector<Rectangle> rectangles;
    std::vector<Pose> poses;
    std::vector<Sweep> sweeps;
};

/// Lists as numbers that can be compared.
struct Lists {
    std::vector<std::uint32_t> offsets;
    std::vector<double> entries;

    void add(const InstanceLists& lists, const Scene& scene) {
        offsets.insert(offsets.end(), lists.offsets.begin(), lists.offsets.end());
        for (const InstanceHandle handle : lists.instances) {
            entries.push_back(static_cast<double>(*scene.position(handle)));
        }
    }
    void add(const RayHits& hits, const Scene& scene) {
        offsets.insert(offsets.end(), hits.offsets.begin(), hits.offsets.end());
        for (const RayHit& hit : hits.hits) {
            entries.insert(entries.end(),
                           {static_cast<double>(*scene.position(hit.instance)), hit.parameter,
                            hit.point.x, hit.point.y, static_cast<double>(hit.edge)});
        }
    }
    void add(std::span<const ShapeCastHit> hits, const Scene& scene) {
        for (const ShapeCastHit& hit : hits) {
            entries.insert(entries.end(),
                           {static_cast<double>(scene.position(hit.instance).value_or(1000)),
                            hit.time, hit.point.x, hit.point.y});
        }
    }

    [[nodiscard]] bool operator==(const Lists&) const = default;
};

Lists all_lists(Scene& scene, const Inputs& inputs) {
    const ShapeHandle item = scene.add_shape(rectangle({-0.2, -0.1}, {0.2, 0.1}));
    World& world = scene.world();
    Lists lists;
    InstanceLists overlaps;
    EXPECT_TRUE(world.find_overlaps(inputs.points, overlaps).ok());
    lists.add(overlaps, scene);
    EXPECT_TRUE(world.find_overlaps(inputs.rectangles, overlaps).ok());
    lists.add(overlaps, scene);
    EXPECT_TRUE(world.find_overlaps(item, inputs.poses, overlaps).ok());
    lists.add(overlaps, scene);
    RayHits hits;
    EXPECT_TRUE(world.cast_rays(inputs.segments, hits).ok());
    lists.add(hits, scene);
    std::vector<ShapeCastHit> casts(inputs.sweeps.size());
    EXPECT_TRUE(world.cast_shape({item, 1e-3}, inputs.sweeps, casts).ok());
    lists.add(casts, scene);
    return lists;
}

TEST(WorldLists, AreTheSameHoweverManyJobsFindThem) {
    const std::vector<Placement> placements = make_scene(SceneKind::ordinary, 4);
    Scene alone(placements);
    const Inputs inputs(alone);
    const Lists expected = all_lists(alone, inputs);
    ASSERT_GT(expected.entries.size(), many);
    for (const std::uint32_t count : {2U, 3U}) {
        Settings settings;
        settings.jobs = {nullptr, count, run_on_threads};
        Scene scene(placements, settings);
        EXPECT_EQ(all_lists(scene, inputs), expected) << count << " jobs";
    }
}

TEST(WorldLists, OfOneInputAfterTheOtherAreTheSame) {
    Scene scene(make_scene(SceneKind::ordinary, 5));
    const Inputs inputs(scene);
    RayHits together;
    InstanceLists overlaps;
    ASSERT_TRUE(scene.world().cast_rays(inputs.segments, together).ok());
    ASSERT_TRUE(scene.world().find_overlaps(inputs.rectangles, overlaps).ok());
    ASSERT_EQ(together.offsets.size(), many + 1);
    ASSERT_EQ(overlaps.offsets.size(), many + 1);
    EXPECT_EQ(together.offsets[many], together.hits.size());
    EXPECT_EQ(overlaps.offsets[many], overlaps.instances.size());
    for (std::size_t i = 0; i < many; ++i) {
        RayHits hits;
        InstanceLists met;
        ASSERT_TRUE(scene.world().cast_rays({&inputs.segments[i], 1}, hits).ok());
        ASSERT_TRUE(scene.world().find_overlaps({&inputs.rectangles[i], 1}, met).ok());
        ASSERT_EQ(hits.hits.size(), together.offsets[i + 1] - together.offsets[i]);
        ASSERT_EQ(met.instances.size(), overlaps.offsets[i + 1] - overlaps.offsets[i]);
        for (std::size_t k = 0; k < hits.hits.size(); ++k) {
            const RayHit& hit = together.hits[together.offsets[i] + k];
            ASSERT_EQ(hits.hits[k].instance, hit.instance);
            ASSERT_EQ(hits.hits[k].parameter, hit.parameter);
            ASSERT_EQ(hits.hits[k].edge, hit.edge);
        }
        for (std::size_t k = 0; k < met.instances.size(); ++k) {
            ASSERT_EQ(met.instances[k], overlaps.instances[overlaps.offsets[i] + k]);
        }
    }
}

TEST(WorldLists, OfNoInputsAreNone) {
    Scene scene(make_scene(SceneKind::ordinary, 6));
    RayHits hits;
    InstanceLists lists;
    const Segment segment{{0, 0}, {1, 1}};
    ASSERT_TRUE(scene.world().cast_rays({&segment, 1}, hits).ok());
    ASSERT_TRUE(scene.world().cast_rays({}, hits).ok());
    EXPECT_EQ(hits.offsets, std::vector<std::uint32_t>{0});
    EXPECT_TRUE(hits.hits.empty());
    ASSERT_TRUE(scene.world().find_overlaps(std::span<const Vector2>(), lists).ok());
    EXPECT_EQ(lists.offsets, std::vector<std::uint32_t>{0});
    EXPECT_TRUE(lists.instances.empty());
}

}  // namespace
}  // namespace nearfield::test
