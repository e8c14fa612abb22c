#include <engine/base/interruption.hpp>
#include <engine/base/prefetch.hpp>
#include <engine/base/unknown_shape.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/geometry/angle_kernels.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace nearfield {
namespace {

using geometry::number;
using geometry::TransformedPolygon;
using geometry::kernels::angles_at_once;

/// The number of poses that a job takes at a time: neighbours help each other.
constexpr std::size_t part = 128;
/// The same of points or segments, which are in order along a curve.
constexpr std::size_t part_of_places = 1024;
/// Places are sorted this many at a time: the more, the nearer are neighbours to each other, and
/// the farther from each other in memory. Rays hit edges anywhere, so they gain less.
constexpr std::size_t points_at_a_time = std::size_t{1} << 18U;
constexpr std::size_t rays_at_a_time = std::size_t{1} << 16U;

/// `inputs`: the number of poses or points; `hits`: of entries in the caller's memory.
void require_room_for_nearest(std::uint32_t count, const char* what, std::size_t inputs,
                              std::size_t hits) {
    if (count == 0 || hits / count != inputs || hits % count != 0) {
        refuse("find_nearest", "there are " + std::to_string(inputs) + " " + what + ", " +
                                   std::to_string(count) + " hits are wanted of each, and " +
                                   std::to_string(hits) + " have space");
    }
}

/// Places a shape at each of at most `angles_at_once` poses.
void place_at(const geometry::Polygon& shape, std::span<const Pose> poses,
              std::vector<TransformedPolygon>& placed) {
    std::array<double, angles_at_once> angles{};
    std::array<SineCosine, angles_at_once> turns;
    std::transform(poses.begin(), poses.end(), angles.begin(),
                   [](const Pose& pose) { return pose.angle; });
    geometry::kernels::find_sines_cosines(std::span(angles).first(poses.size()), turns);
    placed.clear();
    for (std::size_t i = 0; i < poses.size(); ++i) {
        placed.emplace_back(shape, poses[i], turns[i]);
    }
}

}  // namespace

World::Implementation::Implementation(Context::Implementation& context)
    : context_(&context), jobs_(context.jobs()), scratch_(jobs_.count()) {}

InstanceHandle World::Implementation::add(const WorldInstance& instance) {
    static_cast<void>(shape(instance.shape, "add"));
    if (Status status = plan::check_pose(instance.pose, "the instance"); !status.ok()) {
        refuse("add", status.message());
    }
    return instances_.add(instance);
}

void World::Implementation::move(std::span<const InstanceHandle> instances,
                                 std::span<const Pose> poses) {
    require_moves("move", instances_, instances, poses);
    instances_.move(instances, poses);
}

void World::Implementation::set_filter(InstanceHandle instance, std::uint32_t category,
                                       std::uint32_t mask) {
    instances_.set_filter(instances_.find(instance, "set_filter"), category, mask);
}

void World::Implementation::remove(InstanceHandle instance) {
    instances_.remove(instances_.find(instance, "remove"));
}

WorldInstance World::Implementation::instance(InstanceHandle instance) const {
    return instances_[instances_.find(instance, "instance")];
}

void World::Implementation::prepare() {
    view().prepare();
}

void World::Implementation::prepare(const WorldFilter& filter, const char* call) {
    instances_.require_own(filter.ignored, call);
    prepare();
}

const geometry::Polygon& World::Implementation::shape(ShapeHandle handle, const char* call) const {
    const geometry::Polygon* const polygon = context_->shapes().find(handle);
    if (polygon == nullptr) {
        throw StatusException(unknown_shape(call, handle, context_->shapes().context()));
    }
    return *polygon;
}

template <class Answer>
void World::Implementation::divide_poses(const geometry::Polygon& shape, const WorldFilter& filter,
                                         std::span<const Pose> poses, const Answer& answer) {
    expect_answers(poses.size());
    jobs_.divide(poses.size(), part, [&](std::uint32_t job, std::size_t first, std::size_t end) {
        std::vector<TransformedPolygon>& placed = scratch_[job].placed;
        scratch_[job].poses.begin(instances_, shape, filter);
        for (std::size_t i = first; i < end; ++i) {
            checkpoint();
            const std::size_t number = (i - first) % angles_at_once;
            if (number == 0) {
                place_at(shape, poses.subspan(i, std::min(angles_at_once, end - i)), placed);
            }
            answer(scratch_[job], placed[number], i);
        }
        finish_answers(end - first);
    });
}

void World::Implementation::test_poses(const PoseTestQuery& query, std::span<const Pose> poses,
                                       std::span<std::uint8_t> intersects) {
    require_lengths("test_poses", "poses", poses.size(), intersects.size());
    const geometry::Polygon& polygon = shape(query.shape, "test_poses");
    require_poses("test_poses", poses);
    prepare(query.filter, "test_poses");
    divide_poses(polygon, query.filter, poses,
                 [&](Job& job, const TransformedPolygon& placed, std::size_t i) {
                     intersects[i] = job.poses.intersects(placed) ? 1 : 0;
                 });
}

void World::Implementation::find_clearances(const ClearanceQuery& query,
                                            std::span<const Pose> poses,
                                            std::span<Clearance> clearances) {
    require_lengths("find_clearances", "poses", poses.size(), clearances.size());
    const geometry::Polygon& polygon = shape(query.shape, "find_clearances");
    if (!(query.max_clearance >= 0.0 && query.min_clearance < query.max_clearance)) {
        refuse("find_clearances", "the clearances from " + number(query.min_clearance) + " to " +
                                      number(query.max_clearance) +
                                      " are no range that ends at 0 or above");
    }
    require_poses("find_clearances", poses);
    prepare(query.filter, "find_clearances");
    divide_poses(polygon, query.filter, poses,
                 [&](Job& job, const TransformedPolygon& placed, std::size_t i) {
                     clearances[i] = job.poses.clearance(placed, query);
                 });
}

template <class Place, class Answer>
void World::Implementation::divide_places(std::size_t count, std::size_t at_a_time,
                                          const Place& place, const Answer& answer) {
    expect_answers(count);
    for (std::size_t block = 0; block < count; block += at_a_time) {
        const std::size_t size = std::min(at_a_time, count - block);
        const auto order = hilbert_order_.sort(
            size, [&](std::size_t i) -> const Vector2& { return place(block + i); });
        jobs_.divide(size, part_of_places,
                     [&](std::uint32_t job, std::size_t first, std::size_t end) {
                         answer(scratch_[job], block, order.subspan(first, end - first));
                         finish_answers(end - first);
                     });
    }
}

void World::Implementation::find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                                         std::span<NearestHit> hits) {
    require_room_for_nearest(query.count, "points", points.size(), hits.size());
    require_nearest_query(query);
    require_points("find_nearest", points);
    prepare(query.filter, "find_nearest");
    divide_places(
        points.size(), points_at_a_time, [&](std::size_t i) -> const Vector2& { return points[i]; },
        [&](Job& job, std::size_t block, std::span<const std::uint32_t> numbers) {
            constexpr std::size_t ahead = 8;
            job.nearest.begin(instances_, query);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                checkpoint();
                // Points that are close are not close in memory.
                const std::size_t later = block + numbers[std::min(i + ahead, numbers.size() - 1)];
                prefetch(&points[later]);
                prefetch(&hits[later * query.count]);
                const std::size_t point = block + numbers[i];
                job.nearest.find(points[point], hits.subspan(point * query.count, query.count));
            }
        });
}

void World::Implementation::find_nearest(const ShapeNearestQuery& query,
                                         std::span<const Pose> poses,
                                         std::span<Clearance> nearest) {
    require_room_for_nearest(query.count, "poses", poses.size(), nearest.size());
    require_reach_of_nearest(query.max_distance);
    const geometry::Polygon& polygon = shape(query.shape, "find_nearest");
    require_poses("find_nearest", poses);
    prepare(query.filter, "find_nearest");
    divide_poses(polygon, query.filter, poses,
                 [&](Job& job, const TransformedPolygon& placed, std::size_t i) {
                     job.poses.find_nearest(placed, query.max_distance,
                                            nearest.subspan(i * query.count, query.count));
                 });
}

void World::Implementation::find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                                         std::span<ShapeEdgeHit> hits) {
    require_room_for_nearest(query.count, "poses", poses.size(), hits.size());
    require_reach_of_nearest(query.max_distance);
    const geometry::Polygon& polygon = shape(query.shape, "find_nearest");
    require_poses("find_nearest", poses);
    prepare(query.filter, "find_nearest");
    for (Job& job : scratch_) {
        job.edges.begin(instances_, query.filter);
    }
    divide_poses(polygon, query.filter, poses,
                 [&](Job& job, const TransformedPolygon& placed, std::size_t i) {
                     job.edges.find(placed, query.max_distance,
                                    hits.subspan(i * query.count, query.count));
                 });
}

void World::Implementation::cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                                      const WorldFilter& filter) {
    require_lengths("cast_rays", "segments", segments.size(), hits.size());
    require_segments("cast_rays", segments);
    prepare(filter, "cast_rays");
    divide_places(
        segments.size(), rays_at_a_time,
        [&](std::size_t i) -> const Vector2& { return segments[i].from; },
        [&](Job& job, std::size_t block, std::span<const std::uint32_t> numbers) {
            job.rays.begin(instances_, filter);
            job.rays.find_first(segments.subspan(block), numbers, hits.subspan(block));
        });
}

std::uint64_t World::Implementation::bytes() const {
    return sizeof(*this) + instances_.bytes();
}

void World::Implementation::trim() {
    instances_.trim();
    for (Job& job : scratch_) {
        job = Job();
    }
    batch_ = {};
    results_ = {};
    candidates_ = {};
    hilbert_order_ = {};
    ray_lists_ = {};
    instance_lists_ = {};
    candidate_lists_ = {};
    candidate_offsets_ = {};
    candidates_of_sweeps_ = {};
}

}  // namespace nearfield
