#include <tests/limits/cut.hpp>
#include <tests/query/world_questions.hpp>
#include <tests/support/run_on_threads.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <tuple>

namespace nearfield::test {
namespace {

constexpr std::uint64_t world_questions_seed = 31000;

/// Rays, nearest points and pose tests, submitted and answered by each technique: the answers are
/// those of the CPU, given at once.
class WorldQuestions : public WorldQuestionsTest,
                       public testing::WithParamInterface<std::tuple<QuestionKind, Technique>> {
protected:
    [[nodiscard]] static QuestionKind kind() { return std::get<0>(GetParam()); }
    [[nodiscard]] static bool is_by_device() {
        return std::get<1>(GetParam()) == Technique::compute;
    }
    [[nodiscard]] static WorldOptions options(const WorldFilter& filter = {}) {
        return {.filter = filter, .technique = std::get<1>(GetParam())};
    }

    void SetUp() override {
        WorldQuestionsTest::SetUp();
        Random random(world_questions_seed);
        square_ = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        star_ = add_shape(star(random, 15, 0.4));
    }

    using WorldQuestionsTest::compare;
    /// Returns at how many inputs an instance is met, or found, of all that is asked about them.
    std::size_t compare(Inputs inputs, const WorldFilter& filter = {}) {
        std::size_t met = 0;
        left_ = 0;
        const auto compare_once = [&] {
            met += compare(kind(), inputs, options(filter));
            left_ += request_.left_to_cpu();
        };
        switch (kind()) {
            case QuestionKind::rays:
                compare_once();
                break;
            case QuestionKind::points:
                for (const double reach : {infinity, 0.7, 0.05, 0.0}) {
                    for (const NearestKind searched :
                         {NearestKind::instances, NearestKind::edges}) {
                        inputs.query = {.kind = searched, .max_distance = reach};
                        compare_once();
                    }
                }
                break;
            case QuestionKind::poses:
                for (const ShapeHandle shape : {square_, star_}) {
                    inputs.shape = shape;
                    compare_once();
                }
                break;
        }
        return met;
    }
    Status submit(WorldRequest& request, const Inputs& inputs, const WorldOptions& how) {
        return WorldQuestionsTest::submit(kind(), world(), request, inputs, how);
    }
    static Status collect(WorldRequest& request, Answers& answers, const Limits& limits = {}) {
        return WorldQuestionsTest::collect(kind(), request, answers, limits);
    }
    /// Those of the CPU, at once.
    Answers answers_to(const Inputs& inputs) {
        return WorldQuestionsTest::answers_to(kind(), world(), inputs);
    }
    void expect_collected(WorldRequest& request, const Answers& expected) {
        Answers found;
        expect_ok(collect(request, found));
        EXPECT_GT(expect_same(found, expected), 0U);
    }
    /// Some that single precision cannot tell, and some that it can.
    [[nodiscard]] Inputs any_of_tiles(Random& random) const {
        Inputs inputs = inputs_of_tiles(random, 200);
        inputs.shape = square_;
        const Inputs more = some_inputs(random, 200, 6.0);
        inputs.segments.insert(inputs.segments.end(), more.segments.begin(), more.segments.end());
        inputs.points.insert(inputs.points.end(), more.points.begin(), more.points.end());
        inputs.poses.insert(inputs.poses.end(), more.poses.begin(), more.poses.end());
        return inputs;
    }
    /// The CPU answers everything that it is to answer, and few of the rest.
    void expect_left(std::size_t at_most) const {
        EXPECT_TRUE(!is_by_device() || left_ < at_most) << left_;
    }

    std::size_t left_ = 0;  // to the CPU, of the last comparison
    ShapeHandle square_;
    ShapeHandle star_;
};

TEST_P(WorldQuestions, AreAnsweredAsByTheCpuAtOnce) {
    for_each_case(world_questions_seed, 6, [&](Random& random) {
        const std::vector<InstanceHandle> added = add_some(random, 8.0);
        Inputs inputs = some_inputs(random, 1000, 12.0);
        EXPECT_GT(compare(inputs), 100U);
        expect_left(200);
        inputs.shape = square_;
        expect_same(WorldQuestionsTest::answers_to(kind(), world(), inputs, options()),
                    answers_to(inputs));
        remove(added);
    });
}

TEST_P(WorldQuestions, DoNotShowTheirHistory) {
    for_each_case(world_questions_seed + 1000, 2, [&](Random& random) {
        run_history(random, {.steps = 12, .instances = 150, .extent = 25.0},
                    [&] { EXPECT_GT(compare(some_inputs(random, 200, 25.0)), 20U); });
    });
}

/// More instances than three levels of boxes hold, sizes from 1/1000 to 10, and one below them all.
TEST_P(WorldQuestions, AmongManyInstancesOfAllSizes) {
    Random random(world_questions_seed + 2000);
    std::vector<ShapeHandle> shapes;
    for (const double size : {0.001, 0.01, 0.1, 1.0}) {
        shapes.push_back(add_shape(scaled_and_moved(star(random, 12, 0.5), size, {0.0, 0.0})));
    }
    for (int i = 0; i < 700; ++i) {
        add(shapes[static_cast<std::size_t>(i % 4)], any_pose(random, 10.0));
    }
    const Inputs inputs = some_inputs(random, 1000, 12.0);
    EXPECT_GT(compare(inputs), 300U);
    add(add_shape(rectangle({-100.0, -100.0}, {100.0, 100.0})), {});
    EXPECT_GT(compare(inputs), 300U);
    expect_left(400);
}

TEST_P(WorldQuestions, FarFromTheOrigin) {
    for_each_case(world_questions_seed + 3000, 3, [&](Random& random) {
        const Vector2 far{1e6, -3e6};
        const std::vector<InstanceHandle> added = add_some(random, 8.0, far);
        EXPECT_GT(compare(some_inputs(random, 500, 12.0, far)), 50U);
        Inputs away = some_inputs(random, 100, 12.0);  // millions away
        for (Segment& segment : away.segments) {
            // So long that single precision cannot tell.
            segment.to.x += far.x;
            segment.to.y += far.y;
        }
        compare(away);
        remove(added);
    });
}

/// Along shared edges, through vertices and on boundaries, as near to several, and without any
/// length.
TEST_P(WorldQuestions, AmongTilesThatTouch) {
    for (const Vector2& at : {Vector2{0.0, 0.0}, Vector2{1e6, 2e6}, Vector2{0.1, 0.7}}) {
        Random random(world_questions_seed + 4000);
        const std::vector<InstanceHandle> added = add_tiles(at);
        EXPECT_GT(compare(inputs_of_tiles(random, 500, at)), 200U);
        EXPECT_GT(left_, 0U);
        compare(some_inputs(random, 200, 6.0, at));
        remove(added);
    }
}

TEST_P(WorldQuestions, ConsiderFilters) {
    Random random(world_questions_seed + 5000);
    const auto added = consider_filters(random, [&](const WorldFilter& filter) {
        compare(some_inputs(random, 100, 8.0), filter);
        // Two of them may be left to the CPU, which has to ignore the same instance.
        compare(inputs_of_tiles(random, 50), filter);
    });
    ASSERT_TRUE(world().remove(added[3]).ok());
    compare(some_inputs(random, 100, 8.0), {.ignored = added[3]});
}

/// A hierarchy of one box, and of none.
TEST_P(WorldQuestions, OfSmallWorlds) {
    Random random(world_questions_seed + 6000);
    EXPECT_EQ(compare(some_inputs(random, 10, 2.0)), 0U);
    EXPECT_EQ(compare({}), 0U);
    const InstanceHandle only = add(add_shape(star(random, 5, 0.5)), {});
    EXPECT_GT(compare(some_inputs(random, 200, 2.0)), 5U);
    EXPECT_EQ(compare({}), 0U);
    ASSERT_TRUE(world().remove(only).ok());
    EXPECT_EQ(compare(some_inputs(random, 10, 2.0)), 0U);
}

/// Shapes that are too small for single precision.
TEST_P(WorldQuestions, OfTinyShapesAreLeftToTheCpu) {
    Random random(world_questions_seed + 7000);
    const ShapeHandle tiny = add_shape(scaled_and_moved(star(random, 9, 0.5), 1e-11, {}));
    for (int i = 0; i < 20; ++i) {
        add(tiny, any_pose(random, 1e-10));
    }
    EXPECT_GT(compare(some_inputs(random, 200, 1e-10)), 20U);
    EXPECT_GT(left_, 20U);
}

/// Also where the CPU answers by itself, and of a shape that is removed.
TEST_P(WorldQuestions, TellOfTheWorldAsItWas) {
    Random random(world_questions_seed + 8000);
    std::vector<InstanceHandle> added = add_tiles();
    const ShapeHandle deforming = add_shape(star(random, 30, 0.5));
    added.push_back(add(deforming, {{3.0, 3.0}, 0.0}));
    WorldRequest request;
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE(i);
        Inputs inputs = any_of_tiles(random);
        const Answers expected = answers_to(inputs);
        ASSERT_TRUE(submit(request, inputs, options()).ok());
        EXPECT_EQ(request.size(), inputs.points.size());
        // All that may change, some of it in each turn.
        if (i != 1) {
            ASSERT_TRUE(world().move(added[static_cast<std::size_t>(i)], {{0.1, 0.2}, 0.3}).ok());
            ASSERT_TRUE(world().set_filter(added[20], 1U << (i % 2), UINT32_MAX).ok());
        }
        if (i % 3 == 2) {
            ASSERT_TRUE(context().update_shape(deforming, star(random, 40, 0.4)).ok());
            ASSERT_TRUE(context().update_shape(square_, rectangle({0.0, 0.0}, {1.0, 1.5})).ok());
            ASSERT_TRUE(world().remove(added.back()).ok());
            added.back() = add(deforming, any_pose(random, 5.0));
        }
        inputs = {};
        expect_collected(request, expected);
        EXPECT_GT(request.left_to_cpu(), 0U);
        EXPECT_GT(request.timings().total, 0.0);
    }
    const Inputs inputs = any_of_tiles(random);
    const Answers expected = answers_to(inputs);
    ASSERT_TRUE(submit(request, inputs, options()).ok());
    remove(added);
    expect_collected(request, expected);
}

TEST_P(WorldQuestions, AreReadyInTime) {
    add_tiles();
    Random random(world_questions_seed + 9000);
    const Inputs inputs = any_of_tiles(random);
    WorldRequest request;
    EXPECT_FALSE(request.is_ready());
    ASSERT_TRUE(submit(request, inputs, options()).ok());
    while (!request.is_ready()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    WorldRequest moved = std::move(request);
    expect_collected(moved, answers_to(inputs));
    EXPECT_FALSE(moved.is_ready());
    // What is not collected is waited for by the destructor.
    ASSERT_TRUE(submit(moved, inputs, options()).ok());
}

/// What was uploaded of one is of no use for the other.
TEST_P(WorldQuestions, OfTwoWorldsInTurns) {
    Random random(world_questions_seed + 10000);
    add_tiles();
    const Inputs inputs = any_of_tiles(random);
    Expected<World> other = World::create(context());
    ASSERT_TRUE(other.has_value()) << other.error().text();
    for (int i = 0; i < 43; ++i) {
        ASSERT_TRUE(other->add({.shape = star_, .pose = any_pose(random, 6.0)}).has_value());
    }
    for (int i = 0; i < 3; ++i) {
        compare(inputs);
        const Answers expected = WorldQuestionsTest::answers_to(kind(), *other, inputs);
        expect_ok(WorldQuestionsTest::submit(kind(), *other, request_, inputs, options()));
        expect_collected(request_, expected);
    }
}

TEST_P(WorldQuestions, DoNotDependOnJobs) {
    Settings settings = on_demand();
    settings.jobs = {nullptr, 3, run_on_threads};
    Expected<Context> context = Context::create(host_device(), settings);
    ASSERT_TRUE(context.has_value()) << context.error().text();
    Expected<World> world = World::create(*context);
    ASSERT_TRUE(world.has_value()) << world.error().text();
    Random random(world_questions_seed + 11000);
    ShapeHandle last;
    for (const Rings& rings : some_shapes(random)) {
        last = *context->add_shape(rings);
        for (int i = 0; i < 4; ++i) {
            const Pose pose = any_pose(random, 8.0);
            ASSERT_TRUE(world->add({.shape = last, .pose = pose}).has_value());
        }
    }
    Inputs inputs = some_inputs(random, 5000, 12.0);
    inputs.shape = last;
    const Answers found = WorldQuestionsTest::answers_to(kind(), *world, inputs, options());
    const Answers expected = WorldQuestionsTest::answers_to(kind(), *world, inputs);
    EXPECT_GT(expect_same(found, expected), 500U);
}

TEST_P(WorldQuestions, AreRefusedByName) {
    add_tiles();
    Random random(world_questions_seed + 12000);
    const Inputs inputs = any_of_tiles(random);
    const char* const names[] = {"cast_rays", "find_nearest", "test_poses"};
    const std::string name = names[static_cast<std::size_t>(kind())];
    const auto expect = [](const Status& status, StatusCode code, const std::string& call) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_EQ(status.message().find(call + ": "), 0U) << status.text();
    };
    constexpr StatusCode invalid = StatusCode::invalid_query;
    Answers answers;
    expect(collect(request_, answers), StatusCode::not_ready, "collect");
    const Inputs far{.segments = {{{0.0, 0.0}, {1e300, 0.0}}},
                     .points = {{0.0, std::nan("")}},
                     .poses = {{{0.0, 1e300}, 0.0}},
                     .shape = square_};
    expect(submit(request_, far, options()), invalid, name);
    WorldOptions of_another = options();
    of_another.filter.ignored = {.index = 0, .generation = 0, .world = 1U << 30};
    expect(submit(request_, inputs, of_another), StatusCode::unknown_instance, name);
    expect(submit(request_, inputs, {.technique = Technique::raster}),
           StatusCode::unsupported_technique, name);
    expect(collect(request_, answers), StatusCode::not_ready, "collect");
    ASSERT_TRUE(submit(request_, inputs, options()).ok());
    expect(submit(request_, inputs, options()), StatusCode::not_ready, name);
    // Nor is what was submitted lost to a question of another kind, nor for want of room.
    const std::vector<Pose> poses(1);
    const std::vector<Segment> segments(1);
    if (kind() == QuestionKind::poses) {
        expect(world().submit(request_, segments, options()), StatusCode::not_ready, "cast_rays");
        expect(request_.collect(std::span<RayHit>()), StatusCode::not_ready, "collect");
        expect(request_.collect(std::span<std::uint8_t>()), invalid, "collect");
    } else {
        expect(world().submit(request_, square_, poses, options()), StatusCode::not_ready,
               "test_poses");
        expect(request_.collect(std::span<std::uint8_t>()), StatusCode::not_ready, "collect");
        expect(kind() == QuestionKind::rays ? request_.collect(std::span<RayHit>())
                                            : request_.collect(std::span<NearestHit>()),
               invalid, "collect");
    }
    expect_collected(request_, answers_to(inputs));
    expect(collect(request_, answers), StatusCode::not_ready, "collect");
    // A request that is collected takes questions of any kind.
    expect_ok(world().submit(request_, square_, poses, options()));
    std::vector<std::uint8_t> meets(poses.size());
    expect_ok(request_.collect(meets));
}

/// A call that limits end fails as a whole, and the next one answers as if nothing had been.
TEST_P(WorldQuestions, EndAtTheirLimits) {
    add_tiles();
    Random random(world_questions_seed + 13000);
    const Inputs inputs = any_of_tiles(random);
    const Answers expected = answers_to(inputs);
    const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t at) {
        const Cut cut(at);
        Answers found;
        WorldOptions limited = options();
        limited.limits = cut.limits();
        Status status = submit(request_, inputs, limited);
        status = status.ok() ? collect(request_, found, cut.limits()) : status;
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok);
        if (cut.has_cut()) {
            EXPECT_FALSE(request_.is_ready());
        } else {
            expect_same(found, expected);
        }
        return cut.has_cut();
    });
    EXPECT_GT(cuts, 3U);
    compare(inputs);
}

INSTANTIATE_TEST_SUITE_P(Kinds, WorldQuestions,
                         testing::Combine(testing::Values(QuestionKind::rays, QuestionKind::points,
                                                          QuestionKind::poses),
                                          testing::Values(Technique::cpu, Technique::compute)));

class WorldQuestionsByDevice : public WorldQuestionsTest {};

TEST_F(WorldQuestionsByDevice, AreRefusedWithoutMemoryOrCompute) {
    const auto cast = [](Context& context) {
        const ShapeHandle shape = *context.add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        World world = *World::create(context);
        EXPECT_TRUE(world.add({.shape = shape}).has_value());
        const std::vector<Segment> segments(20000, Segment{{-1.0, 0.5}, {2.0, 0.5}});
        std::vector<RayHit> hits(segments.size());
        Status status = world.cast_rays(segments, hits, by_device);
        // After a refusal everything works that is not refused.
        const Status fewer =
            world.cast_rays(std::span(segments).first(10), std::span(hits).first(10), by_device);
        EXPECT_EQ(fewer.ok(), status.code() != StatusCode::unsupported_technique);
        expect_ok(world.cast_rays(segments, hits, {.technique = Technique::automatic}));
        EXPECT_EQ(hits.back().parameter, 1.0 / 3.0);
        return status;
    };
    Settings settings = on_demand();
    settings.memory_limit = 1U << 20U;
    Expected<Context> small = Context::create(host_device(), settings);
    ASSERT_TRUE(small.has_value()) << small.error().text();
    EXPECT_EQ(cast(*small).code(), StatusCode::too_large);
    settings = on_demand();
    settings.techniques.compute = false;
    Expected<Context> drawing_only = Context::create(host_device(), settings);
    ASSERT_TRUE(drawing_only.has_value()) << drawing_only.error().text();
    EXPECT_EQ(cast(*drawing_only).code(), StatusCode::unsupported_technique);
    Expected<Context> without_device = Context::create_cpu();
    ASSERT_TRUE(without_device.has_value()) << without_device.error().text();
    EXPECT_EQ(cast(*without_device).code(), StatusCode::unsupported_technique);
}

/// What only the CPU answers, and what is wrong with a query.
TEST_F(WorldQuestionsByDevice, AreRefusedWhereThereIsNoDeviceWay) {
    const ShapeHandle shape = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(shape, {});
    const std::vector<Vector2> points(1);
    const std::vector<Pose> poses(1);
    const std::vector<Sweep> sweeps(1);
    const std::vector<Segment> segments(1);
    const std::vector<Rectangle> rectangles(1);
    std::vector<NearestHit> near(2);
    std::vector<Clearance> clearances(1);
    std::vector<ShapeEdgeHit> edges(1);
    std::vector<ShapeCastHit> casts(1);
    RayHits all;
    InstanceLists lists;
    const auto expect = [](const Status& status, StatusCode code, const std::string& call) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_EQ(status.message().find(call + ": "), 0U) << status.text();
    };
    for (const Technique technique : {Technique::compute, Technique::raster}) {
        constexpr StatusCode code = StatusCode::unsupported_technique;
        const WorldOptions how{.technique = technique};
        World& w = world();
        expect(w.cast_rays(segments, all, how), code, "cast_rays");
        expect(w.find_clearances({shape}, poses, clearances, how), code, "find_clearances");
        expect(w.find_nearest(ShapeNearestQuery{shape}, poses, clearances, how), code,
               "find_nearest");
        expect(w.find_nearest(ShapeEdgeQuery{shape}, poses, edges, how), code, "find_nearest");
        expect(w.cast_shape({shape, 1e-3}, sweeps, casts, how), code, "cast_shape");
        expect(w.find_overlaps(rectangles, lists, how), code, "find_overlaps");
        expect(w.find_overlaps(points, lists, how), code, "find_overlaps");
        expect(w.find_overlaps(shape, poses, lists, how), code, "find_overlaps");
    }
    constexpr StatusCode invalid = StatusCode::invalid_query;
    WorldRequest request;
    expect(world().find_nearest({.count = 2}, points, near, by_device), invalid, "find_nearest");
    expect(world().submit(request, {.count = 2}, points, by_device), invalid, "find_nearest");
    expect(world().submit(request, {.count = 0}, points), invalid, "find_nearest");
    expect(world().submit(request, {.max_distance = -1.0}, points, by_device), invalid,
           "find_nearest");
    expect(world().submit(request, {.kind = static_cast<NearestKind>(7)}, points, by_device),
           invalid, "find_nearest");
    expect(world().submit(request, ShapeHandle(), poses, by_device), StatusCode::unknown_shape,
           "test_poses");
    // The CPU finds several also when they are collected later.
    expect_ok(world().submit(request, {.count = 2}, points, {.technique = Technique::automatic}));
    expect_ok(request.collect(near));
    EXPECT_EQ(near[0].distance, 0.0);
    EXPECT_EQ(near[1].instance, InstanceHandle());
}

}  // namespace
}  // namespace nearfield::test
