#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/limits/cut.hpp>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using Numbers = std::vector<double>;

void append(Numbers& numbers, const Vector2& point) {
    numbers.insert(numbers.end(), {point.x, point.y});
}

/// A world of stars, its queries, and the numbers of their answers.
class Stars {
public:
    Stars() : context_(*Context::create_cpu()), world_(*World::create(context_)), random_(5) {
        for (int i = 0; i < 30; ++i) {
            WorldInstance instance;
            instance.shape = *context_.add_shape(star(random_, 60, 0.5));
            instance.pose = {{1.3 * (i % 6), 1.3 * (i / 6)}, random_.between(0.0, 6.0)};
            instances_.push_back(*world_.add(instance));
        }
        shape_ = *context_.add_shape(star(random_, 60, 0.5));
        for (int i = 0; i < 40; ++i) {
            const Vector2 at{random_.between(-1.0, 8.0), random_.between(-1.0, 7.0)};
            const Vector2 to{random_.between(-1.0, 8.0), random_.between(-1.0, 7.0)};
            poses_.push_back({at, random_.between(0.0, 6.0)});
            points_.push_back(at);
            segments_.push_back({at, to});
            rectangles_.push_back({at, {at.x + 0.5, at.y + 0.5}});
            sweeps_.push_back({poses_.back(), {to, 0.0}});
        }
    }

    /// A query of the world: writes the numbers of its answer.
    using Query = std::function<Status(Stars&, const Limits&, Numbers&)>;

    Status test_poses(const Limits& limits, Numbers& numbers) {
        std::vector<std::uint8_t> hits(poses_.size());
        Status status = world_.test_poses(shape_, poses_, hits, {.limits = limits});
        numbers.assign(hits.begin(), hits.end());
        return status;
    }
    /// Of each instance and the next.
    template <class Query>
    Status ask_of_list(const Query& query, const Limits& limits, Numbers& numbers) {
        const std::span<const InstanceHandle> all(instances_);
        PairTable table(query, {.listed = true});
        Status status =
            world_.update(table, {.a = all.first(all.size() - 1), .b = all.subspan(1)}, limits);
        for (const auto& row : table.rows()) {
            numbers.insert(numbers.end(), {1.0 * row.intersects, row.error_bound});
            if constexpr (requires { row.deepest; }) {
                numbers.insert(numbers.end(), {static_cast<double>(row.count), row.deepest.depth});
            }
        }
        return status;
    }
    Status find_clearances(const Limits& limits, Numbers& numbers) {
        std::vector<Clearance> clearances(poses_.size());
        ClearanceQuery query;
        query.shape = shape_;
        Status status = world_.find_clearances(query, poses_, clearances, {.limits = limits});
        for (const Clearance& clearance : clearances) {
            numbers.insert(numbers.end(), {clearance.distance, clearance.error_bound});
            append(numbers, clearance.point);
            append(numbers, clearance.nearest);
        }
        return status;
    }
    Status find_nearest(const Limits& limits, Numbers& numbers) {
        std::vector<NearestHit> hits(3 * points_.size());
        NearestQuery query;
        query.count = 3;
        Status status = world_.find_nearest(query, points_, hits, {.limits = limits});
        for (const NearestHit& hit : hits) {
            numbers.push_back(hit.distance);
            append(numbers, hit.nearest);
        }
        return status;
    }
    Status find_nearest_of_shape(const Limits& limits, Numbers& numbers) {
        std::vector<Clearance> nearest(3 * poses_.size());
        ShapeNearestQuery query{shape_};
        query.count = 3;
        Status status = world_.find_nearest(query, poses_, nearest, {.limits = limits});
        for (const Clearance& clearance : nearest) {
            numbers.push_back(clearance.distance);
            append(numbers, clearance.nearest);
        }
        return status;
    }
    Status find_edges_near_shape(const Limits& limits, Numbers& numbers) {
        std::vector<ShapeEdgeHit> hits(3 * poses_.size());
        ShapeEdgeQuery query{shape_};
        query.count = 3;
        Status status = world_.find_nearest(query, poses_, hits, {.limits = limits});
        for (const ShapeEdgeHit& hit : hits) {
            numbers.push_back(hit.distance);
            append(numbers, hit.nearest);
        }
        return status;
    }
    Status cast_rays(const Limits& limits, Numbers& numbers) {
        std::vector<RayHit> hits(segments_.size());
        Status status = world_.cast_rays(segments_, hits, {.limits = limits});
        for (const RayHit& hit : hits) {
            numbers.push_back(hit.parameter);
        }
        return status;
    }
    Status cast_all_rays(const Limits& limits, Numbers& numbers) {
        RayHits hits;
        Status status = world_.cast_rays(segments_, hits, {.limits = limits});
        for (const RayHit& hit : hits.hits) {
            numbers.push_back(hit.parameter);
        }
        return status;
    }
    Status cast_shape(const Limits& limits, Numbers& numbers) {
        std::vector<ShapeCastHit> hits(sweeps_.size());
        Status status = world_.cast_shape({shape_, 1e-4, 0.0}, sweeps_, hits, {.limits = limits});
        for (const ShapeCastHit& hit : hits) {
            numbers.insert(numbers.end(), {hit.time, hit.time_error_bound});
        }
        return status;
    }
    template <class Input>
    Status find_overlaps(const Input& input, const Limits& limits, Numbers& numbers) {
        InstanceLists lists;
        Status status = world_.find_overlaps(input, lists, {.limits = limits});
        return add(lists, std::move(status), numbers);
    }
    Status find_shape_overlaps(const Limits& limits, Numbers& numbers) {
        InstanceLists lists;
        Status status = world_.find_overlaps(shape_, poses_, lists, {.limits = limits});
        return add(lists, std::move(status), numbers);
    }
    template <class Table>
    Status update(Table table, const Limits& limits, Numbers& numbers) {
        Status status = update_table(table, limits);
        if (!status.ok()) {
            EXPECT_TRUE(table.rows().empty());
            EXPECT_EQ(table.size(), 0U);
            EXPECT_EQ(table.candidates(), 0U);
            Status again = update_table(table, {});  // a table that was cut is brought up to date
            EXPECT_TRUE(again.ok()) << again.text();
        }
        for (const auto& row : table.rows()) {
            EXPECT_EQ(row.status, StatusCode::ok);
            numbers.insert(numbers.end(), {1.0 * row.intersects, row.error_bound,
                                           static_cast<double>(row.point_count)});
        }
        return status;
    }

    [[nodiscard]] const std::vector<Vector2>& points() const { return points_; }
    [[nodiscard]] const std::vector<Rectangle>& rectangles() const { return rectangles_; }

private:
    template <class Table>
    Status update_table(Table& table, const Limits& limits) {
        return world_.update(table, {}, limits);
    }
    /// Half of the instances move.
    Status update_table(PairTable<TimeOfImpactQuery>& table, const Limits& limits) {
        return world_.update(
            table, {.moving = {instances_.data(), 15}, .ends = {poses_.data(), 15}}, limits);
    }
    static Status add(const InstanceLists& lists, Status status, Numbers& numbers) {
        numbers.insert(numbers.end(), lists.offsets.begin(), lists.offsets.end());
        for (const InstanceHandle& instance : lists.instances) {
            numbers.push_back(instance.index);
        }
        return status;
    }

    Context context_;
    World world_;
    Random random_;
    ShapeHandle shape_;
    std::vector<InstanceHandle> instances_;
    std::vector<Pose> poses_;
    std::vector<Vector2> points_;
    std::vector<Segment> segments_;
    std::vector<Rectangle> rectangles_;
    std::vector<Sweep> sweeps_;
};

struct NamedQuery {
    std::string name;
    Stars::Query ask;
};

template <class Query>
Stars::Query table_of(const Query& query) {
    return [query](Stars& stars, const Limits& limits, Numbers& numbers) {
        return stars.update(PairTable<Query>(query, {0.1}), limits, numbers);
    };
}

template <class Query>
Stars::Query list_of(const Query& query) {
    return [query](Stars& stars, const Limits& limits, Numbers& numbers) {
        return stars.ask_of_list(query, limits, numbers);
    };
}

std::vector<NamedQuery> all_queries() {
    PenetrationQuery penetration;
    penetration.tolerance = 0.02;
    PenetrationQuery vertices = penetration;
    vertices.points = PenetrationPoints::vertices;
    vertices.summary_only = true;
    ContactQuery contacts;
    contacts.tolerance = 0.02;
    contacts.contact_distance = 0.05;
    IntersectionQuery intersection;
    intersection.tolerance = 0.02;
    ClosestPointQuery closest;
    closest.tolerance = 0.02;
    SeparationQuery separation;
    separation.tolerance = 0.02;
    SeparationVectorQuery vector;
    vector.tolerance = 0.02;
    TimeOfImpactQuery impact;
    impact.tolerance = 1e-3;
    return {
        {"test_poses", &Stars::test_poses},
        {"intersection tests of a list", list_of(IntersectionTestQuery{})},
        {"vertices of a list", list_of(vertices)},
        {"penetrations of a list", list_of(penetration)},
        {"find_clearances", &Stars::find_clearances},
        {"find_nearest", &Stars::find_nearest},
        {"find_nearest of a shape", &Stars::find_nearest_of_shape},
        {"find_nearest of a shape, edges", &Stars::find_edges_near_shape},
        {"cast_rays", &Stars::cast_rays},
        {"cast_rays, all hits", &Stars::cast_all_rays},
        {"cast_shape", &Stars::cast_shape},
        {"find_overlaps of poses", &Stars::find_shape_overlaps},
        {"find_overlaps of points",
         [](Stars& stars, const Limits& limits, Numbers& numbers) {
             return stars.find_overlaps(std::span<const Vector2>(stars.points()), limits, numbers);
         }},
        {"find_overlaps of rectangles",
         [](Stars& stars, const Limits& limits, Numbers& numbers) {
             return stars.find_overlaps(std::span<const Rectangle>(stars.rectangles()), limits,
                                        numbers);
         }},
        {"update of penetration", table_of(penetration)},
        {"update of contacts", table_of(contacts)},
        {"update of intersection", table_of(intersection)},
        {"update of closest points", table_of(closest)},
        {"update of separations", table_of(separation)},
        {"update of intersection tests", table_of(IntersectionTestQuery{})},
        {"update of separation vectors", table_of(vector)},
        {"update of containment", table_of(ContainmentQuery{})},
        {"update of times of impact", table_of(impact)},
    };
}

Numbers whole_answer(Stars& stars, const NamedQuery& query) {
    Numbers numbers;
    const Status status = query.ask(stars, {}, numbers);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_FALSE(numbers.empty());
    return numbers;
}

TEST(WorldLimits, CutEveryQueryAtEveryStage) {
    Stars stars;
    for (const NamedQuery& query : all_queries()) {
        SCOPED_TRACE(query.name);
        const Numbers whole = whole_answer(stars, query);
        const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
            SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
            Cut cut(n);
            Numbers numbers;
            const Status status = query.ask(stars, cut.limits(), numbers);
            if (cut.has_cut()) {
                EXPECT_EQ(status.code(), StatusCode::cancelled) << status.text();
            } else {
                EXPECT_TRUE(status.ok()) << status.text();
                EXPECT_EQ(numbers, whole);
            }
            EXPECT_EQ(whole_answer(stars, query), whole);
            return cut.has_cut() && !HasFailure();
        });
        EXPECT_GE(cuts, 12U);
    }
}

TEST(WorldLimits, OfNoTimeAnswerNothing) {
    Stars stars;
    Limits limits;
    limits.seconds = 0.0;
    for (const NamedQuery& query : all_queries()) {
        SCOPED_TRACE(query.name);
        Numbers numbers;
        const Status status = query.ask(stars, limits, numbers);
        EXPECT_EQ(status.code(), StatusCode::budget_exhausted) << status.text();
    }
    limits.seconds = -1.0;
    for (const NamedQuery& query : all_queries()) {
        SCOPED_TRACE(query.name);
        Numbers numbers;
        const Status status = query.ask(stars, limits, numbers);
        EXPECT_EQ(status.code(), StatusCode::invalid_settings) << status.text();
    }
}

TEST(WorldLimits, CountWhatIsDone) {
    Stars stars;
    Numbers numbers;
    Cut none(0);
    ASSERT_TRUE(stars.cast_all_rays(none.limits(), numbers).ok());
    EXPECT_EQ(none.count(), 40U);
    EXPECT_EQ(none.done(), 39U) << "at the last checkpoint, before the last segment";
}

}  // namespace
}  // namespace nearfield::test
