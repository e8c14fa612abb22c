#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
const double bad_numbers[] = {nan_value, infinity, -infinity, 1.1 * largest_coordinate,
                              -1.1 * largest_coordinate};

/// Two squares, one of which is in the way of an item.
class WorldRefusals : public testing::Test {
protected:
    WorldRefusals()
        : scene_({{"square", rectangle({0, 0}, {1, 1}), {}},
                  {"another", rectangle({0, 0}, {1, 1}), {{3.0, 0.0}}}}),
          item_(scene_.add_shape(rectangle({0, 0}, {1, 1}))) {
        Random random(1);
        questions_ = any_questions(random, {{-1.0, -1.0}, {5.0, 3.0}}, 20);
        before_.emplace(answers());
    }

    Answers answers() {
        Answers answers([this](InstanceHandle handle) {
            const auto position = scene_.position(handle);
            return position ? static_cast<double>(*position) : -1.0;
        });
        answers.ask(world(), item_, questions_);
        EXPECT_TRUE(answers.status().ok()) << answers.status().text();
        return answers;
    }

    World& world() { return scene_.world(); }

    /// The call failed as it should, said which it was, and changed nothing.
    void expect(const Status& status, StatusCode code, const std::string& words) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos)
            << "'" << status.message() << "' does not say '" << words << "'";
        EXPECT_EQ(world().size(), 2U);
        EXPECT_EQ(answers().difference_from(*before_), "");
    }

    Scene scene_;
    ShapeHandle item_;
    Questions questions_;
    std::optional<Answers> before_;
};

TEST_F(WorldRefusals, OfPoses) {
    const InstanceHandle first = scene_.handle(0);
    for (const double bad : bad_numbers) {
        const bool is_angle_bad = !std::isfinite(bad);
        for (const Pose& pose : {Pose{{bad, 0.0}, 0.0}, Pose{{0.0, bad}, 0.0},
                                 Pose{{0.0, 0.0}, is_angle_bad ? bad : nan_value}}) {
            const std::vector<Pose> poses{{}, pose};
            std::vector<std::uint8_t> intersects(2);
            std::vector<Clearance> clearances(2);
            std::vector<ShapeCastHit> casts(2);
            InstanceLists lists;
            expect(world().add({item_, pose}).error(), StatusCode::invalid_query, "add");
            expect(world().move(first, pose), StatusCode::invalid_query, "move");
            const InstanceHandle both[] = {scene_.handle(1), first};
            const Pose other[] = {{{9.0, 9.0}, 1.0}, pose};
            expect(world().move(both, other), StatusCode::invalid_query, "move");
            expect(world().test_poses(item_, poses, intersects), StatusCode::invalid_query,
                   "test_poses");
            expect(world().find_clearances({item_}, poses, clearances), StatusCode::invalid_query,
                   "find_clearances");
            expect(world().find_overlaps(item_, poses, lists), StatusCode::invalid_query,
                   "find_overlaps");
            ShapeCastQuery cast{item_};
            cast.tolerance = 1e-3;
            for (const Sweep& sweep : {Sweep{pose, {}}, Sweep{{}, pose}}) {
                const Sweep sweeps[] = {{}, sweep};
                expect(world().cast_shape(cast, sweeps, casts), StatusCode::invalid_query,
                       "cast_shape");
            }
        }
    }
}

TEST_F(WorldRefusals, OfPointsAndSegmentsNameTheFirst) {
    for (const double bad : bad_numbers) {
        const std::vector<Vector2> points{{}, {bad, 0.0}, {0.0, bad}};
        std::vector<NearestHit> nearest(3);
        InstanceLists lists;
        expect(world().find_nearest({}, points, nearest), StatusCode::invalid_query, "point 1");
        expect(world().find_overlaps(points, lists), StatusCode::invalid_query, "point 1");
        for (const Segment& segment : {Segment{{bad, 0.0}, {}}, Segment{{}, {0.0, bad}}}) {
            const std::vector<Segment> segments{{}, {}, segment};
            std::vector<RayHit> hits(3);
            RayHits all;
            expect(world().cast_rays(segments, hits), StatusCode::invalid_query, "segment 2");
            expect(world().cast_rays(segments, all), StatusCode::invalid_query, "segment 2");
        }
        for (const Rectangle& rectangle :
             {Rectangle{{bad, 0.0}, {1.0, 1.0}}, Rectangle{{0.0, 0.0}, {1.0, bad}}}) {
            const std::vector<Rectangle> rectangles{{}, rectangle};
            expect(world().find_overlaps(rectangles, lists), StatusCode::invalid_query,
                   "rectangle 1");
        }
    }
    InstanceLists lists;
    for (const Rectangle& reversed :
         {Rectangle{{1.0, 0.0}, {0.0, 1.0}}, Rectangle{{0.0, 1.0}, {1.0, 0.0}}}) {
        expect(world().find_overlaps({&reversed, 1}, lists), StatusCode::invalid_query,
               "rectangle 0");
    }
}

TEST_F(WorldRefusals, OfSpansOfDifferentLength) {
    const std::vector<Pose> poses(3);
    const std::vector<Vector2> points(3);
    const std::vector<Segment> segments(3);
    const std::vector<Sweep> sweeps(3);
    ShapeCastQuery cast{item_};
    cast.tolerance = 1e-3;
    for (const std::size_t space : {0U, 2U, 4U}) {
        std::vector<std::uint8_t> intersects(space);
        std::vector<Clearance> clearances(space);
        std::vector<NearestHit> nearest(space);
        std::vector<RayHit> hits(space);
        std::vector<ShapeCastHit> casts(space);
        const std::vector<InstanceHandle> handles(space, scene_.handle(0));
        expect(world().move(handles, poses), StatusCode::invalid_query, "3 poses");
        expect(world().test_poses(item_, poses, intersects), StatusCode::invalid_query, "3");
        expect(world().find_clearances({item_}, poses, clearances), StatusCode::invalid_query, "3");
        expect(world().find_nearest({}, points, nearest), StatusCode::invalid_query, "3");
        expect(world().cast_rays(segments, hits), StatusCode::invalid_query, "3");
        expect(world().cast_shape(cast, sweeps, casts), StatusCode::invalid_query, "3");
    }
    NearestQuery two;
    two.count = 2;
    for (const std::size_t space : {3U, 5U, 7U}) {
        std::vector<NearestHit> nearest(space);
        expect(world().find_nearest(two, points, nearest), StatusCode::invalid_query, "2 hits");
    }
}

TEST_F(WorldRefusals, OfNumbersInQueries) {
    const std::vector<Vector2> points(1);
    std::vector<NearestHit> nearest(1);
    NearestQuery none;
    none.count = 0;
    expect(world().find_nearest(none, points, {}), StatusCode::invalid_query, "0 hits");
    expect(world().find_nearest(none, {}, {}), StatusCode::invalid_query, "0 hits");
    for (const double bad : {-1.0, nan_value, -infinity}) {
        NearestQuery query;
        query.max_distance = bad;
        expect(world().find_nearest(query, points, nearest), StatusCode::invalid_query, "distance");
    }
    NearestQuery query;
    query.kind = static_cast<NearestKind>(7);
    expect(world().find_nearest(query, points, nearest), StatusCode::invalid_query, "kind");
    const std::vector<Pose> poses(1);
    std::vector<Clearance> clearances(1);
    const double ranges[][2] = {{0.0, -1.0},         {1.0, 1.0},       {2.0, 1.0},
                                {nan_value, 1.0},    {0.0, nan_value}, {-2.0, -1.0},
                                {infinity, infinity}};
    for (const auto& [low, high] : ranges) {
        expect(world().find_clearances({item_, low, high}, poses, clearances),
               StatusCode::invalid_query, "find_clearances");
    }
    const std::vector<Sweep> sweeps(1);
    std::vector<ShapeCastHit> casts(1);
    for (const double bad : {0.0, -1.0, nan_value, infinity, 2.0 * largest_coordinate}) {
        expect(world().cast_shape({item_, bad, 0.0}, sweeps, casts), StatusCode::invalid_query,
               "tolerance");
    }
    for (const double bad : {-1.0, nan_value, infinity, 2.0 * largest_coordinate}) {
        expect(world().cast_shape({item_, 1e-3, bad}, sweeps, casts), StatusCode::invalid_query,
               "contact distance");
    }
}

TEST_F(WorldRefusals, OfShapesThatAreNotThere) {
    const ShapeHandle removed = scene_.add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(scene_.context().remove_shape(removed).ok());
    const ShapeHandle successor = scene_.add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_EQ(successor.index, removed.index);
    const std::vector<Pose> poses(1);
    const std::vector<Sweep> sweeps(1);
    std::vector<std::uint8_t> intersects(1);
    std::vector<Clearance> clearances(1);
    std::vector<ShapeCastHit> casts(1);
    InstanceLists lists;
    for (const ShapeHandle shape : {removed, ShapeHandle(), ShapeHandle{77, 0}}) {
        constexpr StatusCode code = StatusCode::unknown_shape;
        expect(world().add({shape, {}}).error(), code, "add");
        expect(world().test_poses(shape, poses, intersects), code, "test_poses");
        expect(world().find_clearances({shape}, poses, clearances), code, "find_clearances");
        expect(world().find_overlaps(shape, poses, lists), code, "find_overlaps");
        expect(world().cast_shape({shape, 1e-3}, sweeps, casts), code, "cast_shape");
    }
}

TEST_F(WorldRefusals, OfInstancesThatAreNotThere) {
    const InstanceHandle removed = *world().add({item_, {}});
    ASSERT_TRUE(world().remove(removed).ok());
    const InstanceHandle successor = *world().add({item_, {{50.0, 0.0}}});
    EXPECT_EQ(successor.index, removed.index);
    EXPECT_FALSE(successor == removed);
    ASSERT_TRUE(world().remove(successor).ok());
    const Pose pose{{9.0, 9.0}, 0.0};
    for (const InstanceHandle handle :
         {removed, successor, InstanceHandle(), InstanceHandle{99, 0}}) {
        constexpr StatusCode code = StatusCode::unknown_instance;
        expect(world().move(handle, pose), code, "move");
        const InstanceHandle both[] = {scene_.handle(0), handle};
        const Pose poses[] = {pose, pose};
        expect(world().move(both, poses), code, "move");
        expect(world().set_filter(handle, 2, 2), code, "set_filter");
        expect(world().remove(handle), code, "remove");
        expect(world().instance(handle).error(), code, "instance");
        const InstanceHandle good[] = {scene_.handle(0), scene_.handle(1)};
        PairTable tests(IntersectionTestQuery{}, of_list);
        expect(world().update(tests, {.a = both, .b = good}), code, "update");
        expect(world().update(tests, {.a = good, .b = both}), code, "update");
        PairTable penetrations(PenetrationQuery{.tolerance = 0.1}, of_list);
        expect(world().update(penetrations, {.a = both, .b = good}), code, "update");
        expect(world().submit(penetrations, {.a = good, .b = both}), code, "submit");
    }
}

TEST_F(WorldRefusals, OfHandlesOfAnotherWorld) {
    Scene other({{"square", rectangle({0, 0}, {1, 1}), {}}});
    const InstanceHandle foreign = other.handle(0);
    ASSERT_EQ(foreign.index, scene_.handle(0).index);
    ASSERT_EQ(foreign.generation, scene_.handle(0).generation);
    const std::string words = ": the instance of index 0 is of another world";
    constexpr StatusCode code = StatusCode::unknown_instance;
    expect(world().move(foreign, {}), code, "move" + words);
    expect(world().set_filter(foreign, 2, 2), code, "set_filter" + words);
    expect(world().remove(foreign), code, "remove" + words);
    expect(world().instance(foreign).error(), code, "instance" + words);
    PairTable tests(IntersectionTestQuery{}, of_list);
    expect(world().update(tests, {.a = {&foreign, 1}, .b = {&foreign, 1}}), code, "update" + words);
    // The shapes of another context, in a world of this one.
    expect(world().add({other.add_shape(rectangle({0, 0}, {1, 1})), {}}).error(),
           StatusCode::unknown_shape, "is of another context");
    // An instance to ignore, which would otherwise be another one here.
    const WorldOptions options{.filter = {.ignored = foreign}};
    const std::vector<Pose> poses(1);
    const std::vector<Vector2> points(1);
    const std::vector<Segment> segments(1);
    const std::vector<Sweep> sweeps(1);
    const std::vector<Rectangle> rectangles(1);
    std::vector<std::uint8_t> intersects(1);
    std::vector<Clearance> clearances(1);
    std::vector<NearestHit> nearest(1);
    std::vector<RayHit> rays(1);
    std::vector<ShapeCastHit> casts(1);
    RayHits all;
    InstanceLists lists;
    World& asked = world();
    expect(asked.test_poses(item_, poses, intersects, options), code, "test_poses" + words);
    expect(asked.find_clearances({item_}, poses, clearances, options), code,
           "find_clearances" + words);
    expect(asked.find_nearest({}, points, nearest, options), code, "find_nearest" + words);
    expect(asked.cast_rays(segments, rays, options), code, "cast_rays" + words);
    expect(asked.cast_rays(segments, all, options), code, "cast_rays" + words);
    expect(asked.cast_shape({item_, 1e-3}, sweeps, casts, options), code, "cast_shape" + words);
    expect(asked.find_overlaps(rectangles, lists, options), code, "find_overlaps" + words);
    expect(asked.find_overlaps(points, lists, options), code, "find_overlaps" + words);
    expect(asked.find_overlaps(item_, poses, lists, options), code, "find_overlaps" + words);
}

TEST_F(WorldRefusals, NothingIsAskedOfNothing) {
    RayHits rays;
    InstanceLists lists;
    EXPECT_TRUE(world().move(std::span<const InstanceHandle>(), {}).ok());
    EXPECT_TRUE(world().test_poses(item_, {}, {}).ok());
    PairTable tests(IntersectionTestQuery{}, of_list);
    EXPECT_TRUE(world().update(tests).ok());
    EXPECT_TRUE(tests.rows().empty());
    EXPECT_TRUE(world().find_clearances({item_}, {}, {}).ok());
    EXPECT_TRUE(world().find_nearest(NearestQuery{}, {}, {}).ok());
    EXPECT_TRUE(world().find_nearest(ShapeNearestQuery{item_}, {}, {}).ok());
    EXPECT_TRUE(world().cast_rays({}, std::span<RayHit>()).ok());
    EXPECT_TRUE(world().cast_rays({}, rays).ok());
    EXPECT_TRUE(world().cast_shape({item_, 1e-3}, {}, {}).ok());
    EXPECT_TRUE(world().find_overlaps(std::span<const Vector2>(), lists).ok());
    EXPECT_EQ(rays.offsets, std::vector<std::uint32_t>{0});
    EXPECT_EQ(lists.offsets, std::vector<std::uint32_t>{0});
    EXPECT_EQ(answers().difference_from(*before_), "");
}

TEST_F(WorldRefusals, AnEmptyWorldAnswers) {
    ASSERT_TRUE(world().remove(scene_.handle(0)).ok());
    ASSERT_TRUE(world().remove(scene_.handle(1)).ok());
    EXPECT_EQ(world().size(), 0U);
    const Answers empty = answers();
    Scene nothing({});
    Answers expected([](InstanceHandle) { return -1.0; });
    expected.ask(nothing.world(), nothing.add_shape(rectangle({0, 0}, {1, 1})), questions_);
    EXPECT_TRUE(expected.status().ok()) << expected.status().text();
    EXPECT_EQ(empty.difference_from(expected), "");
}

/// A shape that is removed takes its instances out of all answers; they can only be removed.
TEST_F(WorldRefusals, RemovedShapesTakeTheirInstancesAlong) {
    ASSERT_TRUE(scene_.context().remove_shape(scene_.shape(0)).ok());
    Scene other({{"another", rectangle({0, 0}, {1, 1}), {{3.0, 0.0}}}});
    Answers expected([&](InstanceHandle handle) { return handle == other.handle(0) ? 1.0 : -1.0; });
    expected.ask(other.world(), other.add_shape(rectangle({0, 0}, {1, 1})), questions_);
    EXPECT_EQ(answers().difference_from(expected), "");
    // Nor does a shape that takes the removed one's place bring them back.
    const ShapeHandle successor = scene_.add_shape(rectangle({0, 0}, {9, 9}));
    ASSERT_EQ(successor.index, scene_.shape(0).index);
    EXPECT_EQ(answers().difference_from(expected), "");
    EXPECT_TRUE(world().remove(scene_.handle(0)).ok());
    EXPECT_EQ(world().size(), 1U);
    EXPECT_EQ(answers().difference_from(expected), "");
}

}  // namespace
}  // namespace nearfield::test
