#include "scene.hpp"

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace nearfield::test {
namespace {

using Numbers = std::vector<double>;

void add(Numbers& to, const Vector2& v) {
    to.insert(to.end(), {v.x, v.y});
}
void add(Numbers& to, const Feature& feature) {
    to.insert(to.end(), {static_cast<double>(feature.kind), static_cast<double>(feature.index)});
}
void add(Numbers& to, const PenetratingPoint& record) {
    add(to, record.position);
    add(to, record.direction);
    add(to, record.nearest);
    add(to, record.feature);
    to.insert(to.end(), {record.depth, record.unique ? 1.0 : 0.0});
}
void add(Numbers& to, const ContactPoint& record) {
    add(to, record.position);
    add(to, record.normal);
    add(to, record.nearest);
    add(to, record.feature);
    to.insert(to.end(), {record.distance, static_cast<double>(record.on), record.inside ? 1.0 : 0.0,
                         record.unique ? 1.0 : 0.0});
}
void add(Numbers& to, const IntersectionSample& sample) {
    add(to, sample.position);
    to.push_back(sample.edge);
}
void add(Numbers& to, const ContactCluster& cluster) {
    add(to, cluster.first);
    add(to, cluster.last);
    add(to, cluster.normal);
    add(to, cluster.extreme);
    to.push_back(cluster.count);
}
void add(Numbers& /*to*/, const NoPoint& /*none*/) {}
void add(Numbers& to, const PenetrationValues& values) {
    to.push_back(values.count);
    if (values.count > 0) {
        add(to, values.deepest);
    }
}
void add(Numbers& to, const ContactValues& values) {
    to.push_back(values.count);
}
void add(Numbers& to, const IntersectionValues& values) {
    to.insert(to.end(), {static_cast<double>(values.count), values.area});
}
void add(Numbers& to, const SeparationValues& values) {
    to.push_back(values.distance);
    add(to, values.point_a);
    add(to, values.point_b);
    add(to, values.direction);
    add(to, values.feature_a);
    add(to, values.feature_b);
    to.push_back(values.unique ? 1.0 : 0.0);
}
void add(Numbers& to, const ClosestPointValues& values) {
    to.push_back(values.distance);
    add(to, values.point);
    add(to, values.nearest);
    add(to, values.direction);
}
void add(Numbers& /*to*/, const IntersectionTestValues& /*none*/) {}
void add(Numbers& to, const ContainmentValues& values) {
    to.insert(to.end(), {values.inside ? 1.0 : 0.0, values.clearance, values.unique ? 1.0 : 0.0});
    add(to, values.point_a);
    add(to, values.point_b);
    add(to, values.direction);
    add(to, values.feature_a);
    add(to, values.feature_b);
}
void add(Numbers& to, const SeparationVectorValues& values) {
    add(to, values.vector);
    to.insert(to.end(), {values.length, values.lower_bound});
}

template <class Query>
Numbers numbers_of(PairTable<Query>& table) {
    Numbers numbers;
    for (const PairRow<Query>& row : table.rows()) {
        numbers.insert(numbers.end(),
                       {static_cast<double>(row.a.index), static_cast<double>(row.a.generation),
                        static_cast<double>(row.b.index), static_cast<double>(row.b.generation),
                        static_cast<double>(row.status), row.intersects ? 1.0 : 0.0,
                        row.error_bound, static_cast<double>(row.point_count)});
        add(numbers, static_cast<const typename Query::Result::Values&>(row));
        for (const auto& record : table.points(row)) {
            add(numbers, record);
        }
        if constexpr (std::is_same_v<Query, ContactQuery>) {
            for (const ContactCluster& cluster : table.manifold(row)) {
                add(numbers, cluster);
            }
        }
    }
    return numbers;
}

template <class Result>
auto records_of(const Result& result) {
    if constexpr (requires { result.samples; }) {
        return std::span(result.samples);
    } else if constexpr (requires { result.points; }) {
        return std::span(result.points);
    } else {
        return std::span<const NoPoint>();
    }
}

/// A world to which things happen: instances move, deform, come and go.
class ChangingScene : public Scene {
public:
    explicit ChangingScene(std::uint64_t seed)
        : Scene(make_scene(kind_of(seed), seed)), random_(seed + 7) {
        for (std::size_t i = 0; i < size(); ++i) {
            present_.push_back(i);
            poses_.push_back(placements()[i].pose);
        }
    }

    void step() {
        for (int moves = random_.whole(0, 3); moves > 0 && !present_.empty(); --moves) {
            const std::size_t i = any();
            poses_[i].translation.x += random_.between(-0.3, 0.3);
            poses_[i].angle += random_.between(-0.3, 0.3);
            ASSERT_TRUE(world().move(handle(i), poses_[i]).ok());
        }
        if (random_.whole(0, 2) == 0) {
            Rings rings = placements()[any()].rings;
            for (Ring& ring : rings) {
                for (Vector2& vertex : ring) {
                    vertex.y *= random_.between(1.0, 1.05);
                }
            }
            ASSERT_TRUE(context().update_shape(shape(any()), rings).ok());
        }
        if (random_.whole(0, 3) == 0 && present_.size() > 4) {
            const auto at = static_cast<std::ptrdiff_t>(random_.whole(0, 3));
            ASSERT_TRUE(world().remove(handle(present_[static_cast<std::size_t>(at)])).ok());
            present_.erase(present_.begin() + at);
        }
        if (random_.whole(0, 5) == 0) {
            ASSERT_TRUE(
                world().set_filter(handle(any()), 1, random_.whole(0, 1) == 0 ? 2 : 1).ok());
        }
    }

private:
    static SceneKind kind_of(std::uint64_t seed) {
        constexpr SceneKind kinds[] = {SceneKind::every_family, SceneKind::grid, SceneKind::holes,
                                       SceneKind::ordinary};
        return kinds[seed % std::size(kinds)];
    }

    [[nodiscard]] std::size_t any() {
        return present_[static_cast<std::size_t>(
            random_.whole(0, static_cast<int>(present_.size()) - 1))];
    }

    Random random_;
    std::vector<std::size_t> present_;
    std::vector<Pose> poses_;
};

/// Every row is the answer to the query of its pair, and no candidate that is hit is missing.
template <class Query>
void check_against_batch(ChangingScene& scene, PairTable<Query>& table) {
    for (const PairRow<Query>& row : table.rows()) {
        Query query = table.query();
        query.technique = Technique::cpu;
        const WorldInstance a = *scene.world().instance(row.a);
        const WorldInstance b = *scene.world().instance(row.b);
        query.a = {a.shape, a.pose};
        query.b = {b.shape, b.pose};
        ASSERT_TRUE((a.category & b.mask) != 0 && (b.category & a.mask) != 0);
        const auto answer = scene.context().answer(query);
        ASSERT_EQ(answer.has_value() ? StatusCode::ok : answer.error().code(), row.status);
        if (!answer.has_value()) {
            continue;
        }
        Numbers expected;
        Numbers found;
        add(expected, static_cast<const typename Query::Result::Values&>(*answer));
        add(found, static_cast<const typename Query::Result::Values&>(row));
        for (const auto& record : records_of(*answer)) {
            add(expected, record);
        }
        for (const auto& record : table.points(row)) {
            add(found, record);
        }
        if constexpr (requires { answer->manifold; }) {
            for (const ContactCluster& cluster : answer->manifold) {
                add(expected, cluster);
            }
            for (const ContactCluster& cluster : table.manifold(row)) {
                add(found, cluster);
            }
        }
        EXPECT_EQ(expected, found);
        EXPECT_EQ(answer->intersects, row.intersects);
        EXPECT_EQ(answer->error_bound, row.error_bound);
    }
}

template <class Query>
void follow(const Query& query, double reach) {
    std::uint32_t kept = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        ChangingScene scene(seed);
        PairTable all(query, {reach, false});
        PairTable hits(query, {reach, true});
        for (int frame = 0; frame < 12; ++frame) {
            scene.step();
            ASSERT_TRUE(scene.world().update(all).ok());
            ASSERT_TRUE(scene.world().update(hits).ok());
            PairTable anew(query, {reach, false});
            ASSERT_TRUE(scene.world().update(anew).ok());
            ASSERT_EQ(anew.left_to_cpu(), anew.candidates());
            ASSERT_EQ(numbers_of(all), numbers_of(anew)) << "seed " << seed << " frame " << frame;
            PairTable hits_anew(query, {reach, true});
            ASSERT_TRUE(scene.world().update(hits_anew).ok());
            ASSERT_EQ(numbers_of(hits), numbers_of(hits_anew));
            ASSERT_LE(hits.rows().size(), all.rows().size());
            kept += frame == 0 ? 0 : all.candidates() - all.left_to_cpu();
            if (frame % 4 == 0) {
                check_against_batch(scene, all);
            }
        }
    }
    EXPECT_GT(kept, 0U) << "nothing was kept";
}

TEST(PairTables, FollowPenetrations) {
    PenetrationQuery query;
    query.tolerance = 0.05;
    follow(query, 0.0);
    query.points = PenetrationPoints::vertices;
    follow(query, 0.0);
}

TEST(PairTables, FollowContacts) {
    ContactQuery query;
    query.tolerance = 0.05;
    query.contact_distance = 0.1;
    follow(query, 0.1);
}

TEST(PairTables, FollowIntersections) {
    IntersectionQuery query;
    query.tolerance = 0.05;
    follow(query, 0.0);
}

TEST(PairTables, FollowClosestPointsAndSeparations) {
    ClosestPointQuery closest;
    closest.tolerance = 0.05;
    follow(closest, 0.5);
    SeparationQuery separation;
    separation.tolerance = 0.05;
    follow(separation, 0.5);
}

TEST(PairTables, FollowIntersectionTestsAndSeparationVectors) {
    follow(IntersectionTestQuery{}, 0.0);
    SeparationVectorQuery vector;
    vector.tolerance = 0.1;
    vector.max_work = 20'000;
    follow(vector, 0.0);
}

TEST(PairTables, FollowContainment) {
    follow(ContainmentQuery{}, 0.0);
}

TEST(PairTables, HaveOnlyWhatIsInsideIfHitsAreWanted) {
    Scene scene({{"bin", rectangle({0, 0}, {10, 10}), {}},
                 {"inside", rectangle({0, 0}, {1, 1}), {{2.0, 4.0}}},
                 {"partly", rectangle({0, 0}, {1, 1}), {{9.5, 4.0}}},
                 {"outside", rectangle({0, 0}, {1, 1}), {{20.0, 4.0}}}});
    PairTable table(ContainmentQuery{}, {0.0, true});
    ASSERT_TRUE(scene.world().update(table).ok());
    EXPECT_EQ(table.candidates(), 4U);
    ASSERT_EQ(table.rows().size(), 1U);
    EXPECT_EQ(table.rows()[0].a, scene.handle(1));
    EXPECT_EQ(table.rows()[0].b, scene.handle(0));
    EXPECT_EQ(table.rows()[0].clearance, 2.0);
}

TEST(PairTables, HaveTheRowsOfTheBroadPhaseInOrder) {
    Scene scene(make_scene(SceneKind::ordinary, 3));
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        instances.push_back(scene.instance(i));
    }
    const auto pairs = scene.context().find_overlapping_boxes(instances, 0.25);
    ASSERT_TRUE(pairs.has_value());
    PairTable once(IntersectionTestQuery{}, {0.25, false});
    ASSERT_TRUE(scene.world().update(once).ok());
    ASSERT_EQ(once.rows().size(), pairs->size());
    for (std::size_t i = 0; i < pairs->size(); ++i) {
        EXPECT_EQ(scene.position(once.rows()[i].a), (*pairs)[i].first);
        EXPECT_EQ(scene.position(once.rows()[i].b), (*pairs)[i].second);
    }
    SeparationVectorQuery query;
    query.tolerance = 0.1;
    PairTable both_ways(query, {0.25, false});
    ASSERT_TRUE(scene.world().update(both_ways).ok());
    EXPECT_EQ(both_ways.rows().size(), 2 * pairs->size());
    EXPECT_TRUE(std::is_sorted(
        both_ways.rows().begin(), both_ways.rows().end(), [&](const auto& one, const auto& other) {
            return std::pair(scene.position(one.a), scene.position(one.b)) <
                   std::pair(scene.position(other.a), scene.position(other.b));
        }));
}

TEST(PairTables, StartAnewInAnotherWorld) {
    PairTable table(IntersectionTestQuery{});
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        // Each world comes to have the address of the one before.
        Scene scene(make_scene(SceneKind::ordinary, seed));
        ASSERT_TRUE(scene.world().update(table).ok());
        EXPECT_EQ(table.left_to_cpu(), table.candidates());
        PairTable anew(IntersectionTestQuery{});
        ASSERT_TRUE(scene.world().update(anew).ok());
        EXPECT_EQ(numbers_of(table), numbers_of(anew));
    }
}

/// As tables that the device fills: there are rows once they are collected, of the world as it was.
TEST(PairTables, AreSubmittedAndCollected) {
    Scene scene(make_scene(SceneKind::ordinary, 2));
    const PenetrationQuery query{.tolerance = 0.05};
    PairTable at_once(query);
    ASSERT_TRUE(scene.world().update(at_once).ok());
    ASSERT_GT(at_once.size(), 0U);
    PairTable table(query);
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
    EXPECT_FALSE(table.is_ready());
    ASSERT_TRUE(scene.world().submit(table).ok());
    EXPECT_TRUE(table.is_ready());
    EXPECT_EQ(table.size(), 0U);
    EXPECT_EQ(table.candidates(), 0U);
    EXPECT_TRUE(table.rows().empty());
    EXPECT_EQ(table.row(0).error().code(), StatusCode::invalid_query);
    ASSERT_TRUE(scene.world().move(scene.handle(0), {{1e3, 1e3}}).ok());
    for (const Status& status : {scene.world().submit(table), scene.world().update(table)}) {
        EXPECT_EQ(status.code(), StatusCode::not_ready);
        EXPECT_NE(status.message().find("has not been collected"), std::string::npos);
    }
    ASSERT_TRUE(table.collect().ok());
    EXPECT_FALSE(table.is_ready());
    EXPECT_EQ(numbers_of(table), numbers_of(at_once));
    EXPECT_EQ(table.left_to_cpu(), table.candidates());
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        EXPECT_EQ(table.row(i)->index, i);
        EXPECT_EQ(table.row(i)->count, table.rows()[i].count);
    }
    EXPECT_FALSE(table.row(table.size()).has_value());
    EXPECT_GE(table.timings().total, table.timings().decode);
    EXPECT_EQ(scene.world().record(table, {}).code(), StatusCode::invalid_submission);
    EXPECT_EQ(table.on_device().error().code(), StatusCode::invalid_query);
}

/// Reach is no property of a hit, but of distances.
TEST(PairTables, OfHitsDoNotDependOnTheReach) {
    Scene scene({{"left", rectangle({0, 0}, {1, 1}), {}},
                 {"right", rectangle({0, 0}, {1, 1}), {{0.5, 0.0}}},
                 {"near", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}}});
    for (const double reach : {0.0, 0.25, 0.5, 10.0}) {
        PairTable tests(IntersectionTestQuery{}, {.reach = reach, .hits_only = true});
        ASSERT_TRUE(scene.world().update(tests).ok());
        EXPECT_EQ(tests.size(), 1U);
        EXPECT_EQ(tests.candidates(), 1U);
        PairTable separations(SeparationQuery{.tolerance = 0.01},
                              {.reach = reach, .hits_only = true});
        ASSERT_TRUE(scene.world().update(separations).ok());
        EXPECT_EQ(separations.size(), reach < 0.5 ? 1U : reach < 1.0 ? 2U : 3U);
    }
}

TEST(PairTables, RefuseWhatAWorldCannotAnswer) {
    Scene scene(make_scene(SceneKind::ordinary, 0));
    PairTable far(IntersectionTestQuery{}, {-1.0, false});
    EXPECT_EQ(scene.world().update(far).code(), StatusCode::invalid_query);
    PenetrationQuery query;
    query.tolerance = 0.05;
    query.technique = Technique::compute;
    PairTable on_device(query);
    EXPECT_EQ(scene.world().update(on_device).code(), StatusCode::invalid_query);
    PairTable by_raster(query, {.technique = Technique::raster});
    EXPECT_EQ(scene.world().update(by_raster).code(), StatusCode::invalid_query);
    PairTable all_by_device(PenetrationQuery{.tolerance = 0.05}, {.technique = Technique::compute});
    EXPECT_NE(scene.world().update(all_by_device).message().find("hits_only = false"),
              std::string::npos);
    PairTable contained(ContainmentQuery{}, {.hits_only = true, .technique = Technique::compute});
    EXPECT_NE(scene.world().update(contained).message().find("does not answer this query"),
              std::string::npos);
    PairTable still(IntersectionTestQuery{});
    const InstanceHandle moving[] = {scene.handle(0)};
    const Pose end[] = {{}};
    EXPECT_NE(
        scene.world().update(still, {.moving = moving, .ends = end}).message().find("motions"),
        std::string::npos);
    query.technique = Technique::automatic;
    query.on_device = true;
    PairTable resident(query);
    EXPECT_EQ(scene.world().update(resident).code(), StatusCode::invalid_query);
    query.on_device = false;
    query.tolerance = -1.0;
    PairTable wrong(query);
    const Status status = scene.world().update(wrong);
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("tolerance"), std::string::npos) << status.message();
    EXPECT_TRUE(wrong.rows().empty());
}

}  // namespace
}  // namespace nearfield::test
