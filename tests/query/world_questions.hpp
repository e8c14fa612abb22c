#pragma once

#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::test {

/// What a world is asked about many inputs, whoever answers.
enum class QuestionKind { rays, points, poses };

/// Inputs of all kinds, and what else is asked about them.
struct Inputs {
    std::vector<Segment> segments = {};
    std::vector<Vector2> points = {};
    std::vector<Pose> poses = {};
    NearestQuery query = {};  // of points
    ShapeHandle shape = {};   // at the poses
};

/// Those to inputs of one kind.
struct Answers {
    std::vector<RayHit> hits;
    std::vector<NearestHit> nearest;
    std::vector<std::uint8_t> meets;
};

inline const WorldOptions by_device{.technique = Technique::compute};

/// Worlds that are asked, and answers that are compared with those of the CPU bit for bit.
class WorldQuestionsTest : public DevicePairsTest {
protected:
    static bool is_met(std::uint8_t answer) { return answer != 0; }
    template <class Hit>
    static bool is_met(const Hit& hit) {
        return !(hit.instance == InstanceHandle{});
    }
    /// Returns how many name an instance.
    template <class Answer>
    static std::size_t expect_equal(const std::vector<Answer>& found,
                                    const std::vector<Answer>& expected) {
        std::size_t met = 0;
        EXPECT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size() && !HasFailure(); ++i) {
            SCOPED_TRACE("question " + std::to_string(i));
            EXPECT_EQ(numbers_of(found[i]), numbers_of(expected[i]));
            met += is_met(expected[i]) ? 1U : 0U;
        }
        return met;
    }
    static void expect_ok(const Status& status) { EXPECT_TRUE(status.ok()) << status.text(); }

    static std::size_t expect_same(const Answers& found, const Answers& expected) {
        return expect_equal(found.hits, expected.hits) +
               expect_equal(found.nearest, expected.nearest) +
               expect_equal(found.meets, expected.meets);
    }

    static Status submit(QuestionKind kind, World& world, WorldRequest& request,
                         const Inputs& inputs, const WorldOptions& options) {
        switch (kind) {
            case QuestionKind::rays:
                return world.submit(request, inputs.segments, options);
            case QuestionKind::points:
                return world.submit(request, inputs.query, inputs.points, options);
            case QuestionKind::poses:
                break;
        }
        return world.submit(request, inputs.shape, inputs.poses, options);
    }
    static Status collect(QuestionKind kind, WorldRequest& request, Answers& answers,
                          const Limits& limits = {}) {
        answers = {};
        switch (kind) {
            case QuestionKind::rays:
                answers.hits.resize(request.size());
                return request.collect(answers.hits, limits);
            case QuestionKind::points:
                answers.nearest.resize(request.size());
                return request.collect(answers.nearest, limits);
            case QuestionKind::poses:
                break;
        }
        answers.meets.resize(request.size(), 7);
        return request.collect(answers.meets, limits);
    }
    /// The answers at once, by the CPU unless the options say otherwise.
    static Answers answers_to(QuestionKind kind, World& world, const Inputs& inputs,
                              const WorldOptions& options = {}) {
        Answers answers;
        switch (kind) {
            case QuestionKind::rays:
                answers.hits.resize(inputs.segments.size());
                expect_ok(world.cast_rays(inputs.segments, answers.hits, options));
                break;
            case QuestionKind::points:
                answers.nearest.resize(inputs.points.size());
                expect_ok(
                    world.find_nearest(inputs.query, inputs.points, answers.nearest, options));
                break;
            case QuestionKind::poses:
                answers.meets.resize(inputs.poses.size());
                expect_ok(world.test_poses(inputs.shape, inputs.poses, answers.meets, options));
                break;
        }
        return answers;
    }
    /// Submits and collects, and compares with the CPU. Returns how many name an instance.
    std::size_t compare(QuestionKind kind, const Inputs& inputs,
                        const WorldOptions& options = by_device) {
        Answers found;
        expect_ok(submit(kind, world(), request_, inputs, options));
        expect_ok(collect(kind, request_, found));
        return expect_same(found, answers_to(kind, world(), inputs, {.filter = options.filter}));
    }

    static Vector2 any_place(Random& random, double extent, const Vector2& around = {}) {
        return {around.x + random.between(-extent, extent),
                around.y + random.between(-extent, extent)};
    }
    /// Segments of all lengths around a place.
    static std::vector<Segment> some_segments(Random& random, int count, double extent,
                                              const Vector2& around = {}) {
        std::vector<Segment> segments;
        for (int i = 0; i < count; ++i) {
            const double length = random.scale(1e-4, 3.0) * extent;
            const double angle = random.between(-4.0, 4.0);
            const Vector2 from = any_place(random, extent, around);
            segments.push_back(
                {from, {from.x + length * std::cos(angle), from.y + length * std::sin(angle)}});
        }
        return segments;
    }
    static std::vector<Vector2> some_points(Random& random, int count, double extent,
                                            const Vector2& around = {}) {
        std::vector<Vector2> points;
        for (int i = 0; i < count; ++i) {
            points.push_back(any_place(random, extent, around));
        }
        return points;
    }

    static std::vector<Pose> some_poses(Random& random, int count, double extent,
                                        const Vector2& around = {}) {
        std::vector<Pose> poses;
        for (int i = 0; i < count; ++i) {
            poses.push_back({any_place(random, extent, around), random.between(-4.0, 4.0)});
        }
        return poses;
    }
    static Inputs some_inputs(Random& random, int count, double extent,
                              const Vector2& around = {}) {
        return {some_segments(random, count, extent, around),
                some_points(random, count, extent, around),
                some_poses(random, count, extent, around)};
    }

    /// Shapes of all kinds, some times each.
    std::vector<InstanceHandle> add_some(Random& random, double extent,
                                         const Vector2& around = {}) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = random.whole(1, 5); i > 0; --i) {
                Pose pose = any_pose(random, extent);
                pose.translation.x += around.x;
                pose.translation.y += around.y;
                added.push_back(add(shape, pose));
            }
        }
        return added;
    }

    /// Squares in several categories; `compare(filter)` asks about those that filters consider.
    template <class Compare>
    std::vector<InstanceHandle> consider_filters(Random& random, const Compare& compare) {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 100; ++i) {
            added.push_back(add(square, any_pose(random, 7.0)));
            const auto bits = static_cast<std::uint32_t>(1 << random.whole(0, 2));
            EXPECT_TRUE(world().set_filter(added.back(), bits, 7 - bits).ok());
        }
        for (std::uint32_t bits = 0; bits < 8; ++bits) {
            compare(WorldFilter{.category = 7 - bits / 2, .mask = bits, .ignored = added[bits]});
        }
        return added;
    }

    /// Squares of side 1 that share edges and vertices, from (0, 0) to (6, 6), with tiny holes in
    /// some; one of them twice; and needles along some of their edges.
    std::vector<InstanceHandle> add_tiles(const Vector2& at = {}) {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        Rings holed = rectangle({0.0, 0.0}, {1.0, 1.0});
        holed.push_back({{0.5, 0.5}, {0.5, 0.5 + 1e-9}, {0.5 + 1e-9, 0.5}});
        const ShapeHandle with_hole = add_shape(holed);
        const ShapeHandle needle = add_shape({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1e-9}}});
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 36; ++i) {
            const Vector2 place{at.x + i % 6, at.y + i / 6};
            added.push_back(add(i % 5 == 0 ? with_hole : square, {place, 0.0}));
            if (i % 7 == 0) {
                added.push_back(add(needle, {place, 0.0}));
                added.push_back(add(square, {place, 0.0}));
            }
        }
        return added;
    }
    /// Places on a raster, where tiles have vertices, middles of edges and centres.
    static Vector2 place_of_tiles(Random& random, const Vector2& at = {}) {
        return {at.x + 0.5 * random.whole(-1, 13), at.y + 0.5 * random.whole(-1, 13)};
    }
    static Inputs inputs_of_tiles(Random& random, int count, const Vector2& at = {}) {
        Inputs inputs;
        for (int i = 0; i < count; ++i) {
            inputs.segments.push_back({place_of_tiles(random, at), place_of_tiles(random, at)});
            inputs.points.push_back(place_of_tiles(random, at));
            inputs.poses.push_back({place_of_tiles(random, at), 0.0});
            inputs.poses.back().translation.x -= random.whole(0, 1) * 1.5;
            inputs.poses.back().translation.y += random.whole(0, 1) * 4.0;
        }
        return inputs;
    }

    WorldRequest request_;
};

}  // namespace nearfield::test
