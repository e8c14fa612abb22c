#include "answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

using Table = PairTable<TimeOfImpactQuery>;
using Row = PairRow<TimeOfImpactQuery>;

/// Where instances of a scene move to, by position.
using Ends = std::vector<std::optional<Pose>>;

/// The spans that World::update() takes.
struct Step {
    Step(const Scene& scene, const Ends& ends) {
        for (std::size_t i = ends.size(); i-- > 0;) {
            if (ends[i]) {
                moving.push_back(scene.handle(i));
                poses.push_back(*ends[i]);
            }
        }
    }

    std::vector<InstanceHandle> moving;
    std::vector<Pose> poses;
};

Status update(Scene& scene, Table& table, const Ends& ends) {
    const Step step(scene, ends);
    return scene.world().update(table, {.moving = step.moving, .ends = step.poses});
}

Ends any_ends(Random& random, const Scene& scene) {
    const Rectangle box = scene.box();
    Ends ends(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) {
        const Pose start = scene.instance(i).pose;
        switch (random.whole(0, 5)) {
            case 0:
                ends[i] = Pose{any_point(random, scene, box), start.angle};
                break;
            case 1:
                ends[i] = Pose{any_point(random, scene, box), random.between(-4.0, 4.0)};
                break;
            case 2:
                ends[i] = Pose{start.translation, start.angle + random.between(-7.0, 7.0)};
                break;
            case 3:
                ends[i] = start;
                break;
            default:
                break;  // it stands still
        }
    }
    return ends;
}

bool is_pair(const Placement& a, const Placement& b) {
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

/// All rows against the query asked of every pair: those missing are separated.
void check_all_pairs(Scene& scene, Table& table, const Ends& ends) {
    std::size_t next = 0;
    const auto rows = table.rows();
    for (std::size_t a = 0; a < scene.size(); ++a) {
        for (std::size_t b = a + 1; b < scene.size(); ++b) {
            if (!is_pair(scene.placements()[a], scene.placements()[b])) {
                continue;
            }
            SCOPED_TRACE("instances " + std::to_string(a) + " and " + std::to_string(b));
            TimeOfImpactQuery query = table.query();
            query.a = scene.instance(a);
            query.b = scene.instance(b);
            query.end_a = ends[a].value_or(query.a.pose);
            query.end_b = ends[b].value_or(query.b.pose);
            const auto expected = scene.context().answer(query);
            ASSERT_TRUE(expected.has_value()) << expected.error().text();
            const bool is_listed = next < rows.size() && rows[next].a == scene.handle(a) &&
                                   rows[next].b == scene.handle(b);
            if (is_listed) {
                Numbers found;
                Numbers truth;
                found.add_answer(table, rows[next++]);
                truth.add_answer(*expected);
                EXPECT_EQ(found.list(), truth.list());
            } else {
                EXPECT_EQ(expected->state, ImpactState::separated);
                EXPECT_FALSE(expected->intersects);
            }
        }
    }
    EXPECT_EQ(next, rows.size()) << "there are rows in another order, or of no pair";
}

using WorldImpacts = ScenesTest;

TEST_P(WorldImpacts, AreThoseOfEveryPair) {
    for_each_scene(3, 91, [](Scene& scene, Random& random) {
        TimeOfImpactQuery query;
        query.tolerance = 1e-9 * size_of(GetParam(), scene.box());
        query.max_steps = 300;
        query.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.3);
        const Ends ends = any_ends(random, scene);
        Table all(query);
        Table hits(query, {.reach = 0.0, .hits_only = true});
        Table wide(query, {.reach = 1.0, .hits_only = false});
        for (Table* const table : {&all, &hits, &wide}) {
            const Status status = update(scene, *table, ends);
            ASSERT_TRUE(status.ok()) << status.text();
            check_all_pairs(scene, *table, ends);
        }
        EXPECT_LE(hits.rows().size(), all.rows().size());
        EXPECT_LE(all.rows().size(), wide.rows().size());
        EXPECT_EQ(hits.candidates(), all.rows().size());
        for (const Row& row : hits.rows()) {
            EXPECT_NE(row.state, ImpactState::separated);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldImpacts, testing::ValuesIn(all_scene_kinds()));

TEST(WorldImpactTables, AnswerOnlyPairsOfWhichAMotionChanged) {
    Scene scene({{"left", rectangle({0, 0}, {1, 1}), {{0.0, 0.0}}},
                 {"right", rectangle({0, 0}, {1, 1}), {{5.0, 0.0}}},
                 {"above", rectangle({0, 0}, {1, 1}), {{0.0, 5.0}}}});
    TimeOfImpactQuery query;
    query.tolerance = 1e-9;
    Table table(query, {.reach = 100.0});
    Ends ends(3);
    ends[0] = Pose{{8.0, 0.0}};
    ASSERT_TRUE(update(scene, table, ends).ok());
    EXPECT_EQ(table.left_to_cpu(), 3U);
    EXPECT_EQ(table.rows()[0].state, ImpactState::hit);
    EXPECT_NEAR(table.rows()[0].time, 0.5, 1e-9);
    ASSERT_TRUE(update(scene, table, ends).ok());
    EXPECT_EQ(table.left_to_cpu(), 0U);
    ends[1] = Pose{{-3.0, 0.0}};  // towards each other
    ASSERT_TRUE(update(scene, table, ends).ok());
    EXPECT_EQ(table.left_to_cpu(), 2U);
    EXPECT_NEAR(table.rows()[0].time, 0.25, 1e-9);
    ends[2] = Pose{{0.0, 5.0}};  // where it is already
    ASSERT_TRUE(update(scene, table, ends).ok());
    EXPECT_EQ(table.left_to_cpu(), 0U);
    ends = Ends(3);
    ASSERT_TRUE(update(scene, table, ends).ok());
    EXPECT_EQ(table.left_to_cpu(), 3U);
    EXPECT_EQ(table.rows()[0].state, ImpactState::separated);
}

TEST(WorldImpactTables, TakeTheLaterEndOfAnInstanceNamedTwice) {
    Scene scene({{"moves", rectangle({0, 0}, {1, 1}), {}},
                 {"in its way", rectangle({0, 0}, {1, 1}), {{5.0, 0.0}}}});
    TimeOfImpactQuery query;
    query.tolerance = 1e-9;
    Table table(query, {.reach = 0.0, .hits_only = true});
    const InstanceHandle twice[] = {scene.handle(0), scene.handle(0)};
    const Pose ends[] = {{{0.0, 8.0}}, {{8.0, 0.0}}};
    ASSERT_TRUE(scene.world().update(table, {.moving = twice, .ends = ends}).ok());
    ASSERT_EQ(table.rows().size(), 1U);
    EXPECT_NEAR(table.rows()[0].time, 0.5, 1e-9);
    EXPECT_EQ(scene.world().instance(scene.handle(0))->pose, Pose()) << "an update moves nothing";
}

TEST(WorldImpactTables, RefuseMotionsThatCannotBe) {
    Scene scene({{"moves", rectangle({0, 0}, {1, 1}), {}},
                 {"in its way", rectangle({0, 0}, {1, 1}), {{5.0, 0.0}}}});
    TimeOfImpactQuery query;
    query.tolerance = 1e-9;
    Table table(query);
    const InstanceHandle moving[] = {scene.handle(0)};
    const Pose end[] = {{{8.0, 0.0}}};
    const auto expect = [&](const Status& status, StatusCode code, const std::string& words) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos) << status.message();
        EXPECT_TRUE(table.rows().empty());
        EXPECT_EQ(table.candidates(), 0U);
        ASSERT_TRUE(scene.world().update(table, {.moving = moving, .ends = end}).ok());
        EXPECT_EQ(table.rows().size(), 1U);
    };
    expect(scene.world().update(table, {.moving = moving}), StatusCode::invalid_query, "update");
    const Pose nowhere[] = {{{std::numeric_limits<double>::quiet_NaN(), 0.0}}};
    expect(scene.world().update(table, {.moving = moving, .ends = nowhere}),
           StatusCode::invalid_query, "number 0");
    const InstanceHandle nobody[] = {InstanceHandle()};
    expect(scene.world().update(table, {.moving = nobody, .ends = end}),
           StatusCode::unknown_instance, "update");
    Scene other({{"elsewhere", rectangle({0, 0}, {1, 1}), {}}});
    const InstanceHandle stranger[] = {other.handle(0)};
    expect(scene.world().update(table, {.moving = stranger, .ends = end}),
           StatusCode::unknown_instance, "another world");
    Table wrong{TimeOfImpactQuery{}};
    EXPECT_EQ(scene.world().update(wrong, {.moving = moving, .ends = end}).code(),
              StatusCode::invalid_query);
    // What double precision cannot resolve is the fault of single pairs.
    TimeOfImpactQuery finest;
    finest.tolerance = 1e-300;
    Table too_fine(finest, {.reach = 0.0, .hits_only = true});
    ASSERT_TRUE(scene.world().update(too_fine, {.moving = moving, .ends = end}).ok());
    ASSERT_EQ(too_fine.rows().size(), 1U);
    EXPECT_EQ(too_fine.rows()[0].status, StatusCode::invalid_query);
}

}  // namespace
}  // namespace nearfield::test
