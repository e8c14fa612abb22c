#include "scene.hpp"

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
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

Ends any_ends(Random& random, const Scene& scene, const std::vector<Pose>& poses,
              const Rectangle& box) {
    Ends ends(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) {
        const Pose& start = poses[i];
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

std::vector<Pose> poses_of(const Scene& scene) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        poses.push_back(scene.instance(i).pose);
    }
    return poses;
}

/// As small as double precision resolves at the coordinates of a scene.
double tolerance_of(SceneKind kind, const Rectangle& box) {
    return 1e-9 * std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x),
                            std::abs(box.max.y), kind == SceneKind::far_origin ? 1e8 : 1e7});
}

void expect_equal(const Row& row, const TimeOfImpactResult& expected) {
    EXPECT_EQ(row.intersects, expected.intersects);
    EXPECT_EQ(row.error_bound, expected.error_bound);
    EXPECT_EQ(row.state, expected.state);
    EXPECT_EQ(row.time, expected.time);
    EXPECT_EQ(row.time_error_bound, expected.time_error_bound);
    EXPECT_EQ(row.pose_a, expected.pose_a);
    EXPECT_EQ(row.pose_b, expected.pose_b);
    EXPECT_EQ(row.distance, expected.distance);
    EXPECT_EQ(row.min_distance, expected.min_distance);
    EXPECT_EQ(row.point_a, expected.point_a);
    EXPECT_EQ(row.point_b, expected.point_b);
    EXPECT_EQ(row.direction, expected.direction);
    EXPECT_EQ(row.steps, expected.steps);
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
                expect_equal(rows[next++], *expected);
            } else {
                EXPECT_EQ(expected->state, ImpactState::separated);
                EXPECT_FALSE(expected->intersects);
            }
        }
    }
    EXPECT_EQ(next, rows.size()) << "there are rows in another order, or of no pair";
}

class WorldImpacts : public testing::TestWithParam<int> {};

TEST_P(WorldImpacts, AreThoseOfEveryPair) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(3); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 91U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        const Rectangle box = box_of(scene.placements());
        Random random(seed + 1);
        TimeOfImpactQuery query;
        query.tolerance = tolerance_of(kind, box);
        query.max_steps = 300;
        query.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.3);
        const Ends ends = any_ends(random, scene, poses_of(scene), box);
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
        if (HasFailure()) {
            return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldImpacts, testing::Range(0, scene_kinds));

/// After any steps, a table has the rows of a new one.
TEST(WorldImpactTables, KeepTheRowsOfMotionsThatStay) {
    std::uint32_t kept = 0;
    std::uint32_t hit = 0;
    for (int number = 0; number < world_cases(8); ++number) {
        const auto seed = static_cast<std::uint64_t>(number);
        const SceneKind kind = number % 2 == 0 ? SceneKind::ordinary : SceneKind::grid;
        Scene scene(make_scene(kind, seed));
        const Rectangle box = box_of(scene.placements());
        Random random(seed + 5);
        std::vector<Pose> poses = poses_of(scene);
        Ends ends(scene.size());
        TimeOfImpactQuery query;
        query.tolerance = 1e-3;
        Table table(query);
        for (int step = 0; step < 10; ++step) {
            for (int changes = random.whole(0, 3); changes > 0; --changes) {
                const auto i =
                    static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1));
                switch (random.whole(0, 3)) {
                    case 0:  // it arrives
                        poses[i] = ends[i].value_or(poses[i]);
                        ASSERT_TRUE(scene.world().move(scene.handle(i), poses[i]).ok());
                        break;
                    case 1:
                        ASSERT_TRUE(scene.context()
                                        .update_shape(scene.shape(i), rectangle({0, 0}, {1, 2}))
                                        .ok());
                        break;
                    case 2:
                        ends[i].reset();
                        break;
                    default:
                        ends[i] = any_ends(random, scene, poses, box)[i];
                        break;
                }
            }
            ASSERT_TRUE(update(scene, table, ends).ok());
            Table anew(query);
            ASSERT_TRUE(update(scene, anew, ends).ok());
            ASSERT_EQ(anew.left_to_cpu(), anew.candidates());
            kept += step == 0 ? 0 : table.candidates() - table.left_to_cpu();
            ASSERT_EQ(table.rows().size(), anew.rows().size());
            for (std::size_t i = 0; i < table.rows().size(); ++i) {
                SCOPED_TRACE(testing::Message() << seed << ", step " << step << ", row " << i);
                const Row& row = table.rows()[i];
                const Row& expected = anew.rows()[i];
                ASSERT_EQ(row.a, expected.a);
                ASSERT_EQ(row.b, expected.b);
                ASSERT_EQ(row.state, expected.state);
                ASSERT_EQ(row.time, expected.time);
                ASSERT_EQ(row.point_a, expected.point_a);
                ASSERT_EQ(row.min_distance, expected.min_distance);
                hit += row.state == ImpactState::hit ? 1 : 0;
            }
        }
    }
    EXPECT_GT(kept, 0U) << "nothing was kept";
    EXPECT_GT(hit, 0U) << "nothing was hit";
}

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

TEST(WorldImpactTables, FindWhatATurnReaches) {
    // A bar that turns half a circle about its end; another that turns the other way, elsewhere.
    Scene scene({{"bar", rectangle({0, -0.1}, {10, 0.1}), {}},
                 {"above", rectangle({-0.5, 0}, {0.5, 1}), {{0.0, 9.0}}},
                 {"out of reach", rectangle({-0.5, 0}, {0.5, 1}), {{0.0, 10.5}}}});
    TimeOfImpactQuery query;
    query.tolerance = 1e-9;
    Table table(query, {.reach = 0.0, .hits_only = true});
    Ends ends(3);
    ends[0] = Pose{{0.0, 0.0}, std::numbers::pi};
    ASSERT_TRUE(update(scene, table, ends).ok());
    ASSERT_EQ(table.rows().size(), 1U);
    EXPECT_EQ(table.rows()[0].b, scene.handle(1));
    const double angle = std::atan2(9.0, 0.5) - std::asin(0.1 / std::hypot(0.5, 9.0));
    EXPECT_NEAR(table.rows()[0].time, angle / std::numbers::pi, 1e-8);
}

TEST(WorldImpactTables, ReachAsFarAsTheContactDistance) {
    Scene scene({{"moves", rectangle({0, 0}, {1, 1}), {}},
                 {"beside its path", rectangle({0, 0}, {1, 1}), {{4.0, 1.25}}}});
    Ends ends(2);
    ends[0] = Pose{{8.0, 0.0}};
    TimeOfImpactQuery query;
    query.tolerance = 1e-9;
    for (const double contact_distance : {0.2, 0.25, 0.5}) {
        query.contact_distance = contact_distance;
        Table table(query, {.reach = 0.0, .hits_only = true});
        ASSERT_TRUE(update(scene, table, ends).ok());
        EXPECT_EQ(table.rows().size(), contact_distance < 0.25 ? 0U : 1U) << contact_distance;
    }
    ContactQuery contacts;
    contacts.tolerance = 0.01;
    contacts.contact_distance = 0.5;
    ASSERT_TRUE(scene.world().move(scene.handle(0), {{4.0, 0.0}}).ok());
    PairTable near(contacts, {.reach = 0.0, .hits_only = true});
    ASSERT_TRUE(scene.world().update(near).ok());
    EXPECT_EQ(near.rows().size(), 2U) << "contacts beyond the boxes are missing";
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
