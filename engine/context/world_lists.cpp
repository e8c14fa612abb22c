// Queries of a world whose answers are lists.

#include <engine/base/interruption.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>

#include <algorithm>
#include <string>

namespace nearfield {

void World::Implementation::cast_rays(std::span<const Segment> segments, RayHits& hits,
                                      const WorldFilter& filter) {
    require_segments("cast_rays", segments);
    prepare(filter, "cast_rays");
    for (Job& job : scratch_) {
        job.rays.begin(instances_, filter);
    }
    expect_answers(segments.size());
    ray_lists_.write(jobs_, segments.size(), hits.offsets, hits.hits,
                     [&](std::uint32_t job, std::size_t i, std::vector<RayHit>& found) {
                         scratch_[job].rays.find_all(segments[i], found);
                         finish_answers(1);
                     });
}

template <class Find>
void World::Implementation::write_lists(std::size_t count, InstanceLists& lists, const Find& find) {
    expect_answers(count);
    instance_lists_.write(jobs_, count, lists.offsets, lists.instances,
                          [&](std::uint32_t job, std::size_t i, std::vector<InstanceHandle>& list) {
                              std::vector<std::uint32_t>& found = scratch_[job].found;
                              found.clear();
                              find(scratch_[job], i, found);
                              std::sort(found.begin(), found.end(),
                                        [this](std::uint32_t a, std::uint32_t b) {
                                            return instances_.number(a) < instances_.number(b);
                                        });
                              for (const std::uint32_t index : found) {
                                  list.push_back(instances_.handle(index));
                              }
                              finish_answers(1);
                          });
}

void World::Implementation::find_overlaps(std::span<const Rectangle> rectangles,
                                          InstanceLists& lists, const WorldFilter& filter) {
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        const Rectangle& rectangle = rectangles[i];
        require_point("find_overlaps", "the low corner of rectangle", i, rectangle.min);
        require_point("find_overlaps", "the high corner of rectangle", i, rectangle.max);
        if (rectangle.max.x < rectangle.min.x || rectangle.max.y < rectangle.min.y) {
            refuse("find_overlaps", "the high corner of rectangle " + std::to_string(i) +
                                        " is below its low corner");
        }
    }
    prepare(filter, "find_overlaps");
    for (Job& job : scratch_) {
        job.overlaps.begin(instances_, filter);
    }
    write_lists(rectangles.size(), lists,
                [&](Job& job, std::size_t i, std::vector<std::uint32_t>& found) {
                    job.overlaps.find(rectangles[i], found);
                });
}

void World::Implementation::find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                                          const WorldFilter& filter) {
    require_points("find_overlaps", points);
    prepare(filter, "find_overlaps");
    for (Job& job : scratch_) {
        job.overlaps.begin(instances_, filter);
    }
    write_lists(points.size(), lists,
                [&](Job& job, std::size_t i, std::vector<std::uint32_t>& found) {
                    job.overlaps.find(points[i], found);
                });
}

void World::Implementation::find_overlaps(const PoseTestQuery& query, std::span<const Pose> poses,
                                          InstanceLists& lists) {
    const geometry::Polygon& polygon = shape(query.shape, "find_overlaps");
    require_poses("find_overlaps", poses);
    prepare(query.filter, "find_overlaps");
    for (Job& job : scratch_) {
        job.poses.begin(instances_, polygon, query.filter);
    }
    write_lists(poses.size(), lists,
                [&](Job& job, std::size_t i, std::vector<std::uint32_t>& found) {
                    job.poses.find_intersecting({polygon, poses[i]}, found);
                });
}

}  // namespace nearfield
