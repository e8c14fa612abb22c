// The instances that points, rectangles and shapes meet.

#include <engine/batch/call_within.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/world_state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace nearfield {
namespace {

using geometry::Box;
using geometry::Vector;
using world::Instances;

constexpr const char* overlaps_call = "find_overlaps";

/// True if a point is inside, or on the boundary up to rounding.
bool holds(const Instances& all, std::uint32_t index, const Vector& point) {
    const simd::AabbTree& tree = all.tree(index);
    if (simd::kernels::contain(tree, point.x(), point.y())) {
        return true;
    }
    const double rounding = all.rounding(index);
    const double most =
        std::nextafter(rounding * rounding, std::numeric_limits<double>::infinity());
    constexpr std::uint32_t none = UINT32_MAX;
    return simd::kernels::find_nearer(tree, point.x(), point.y(), {none, most}).edge != none;
}

/// True if an edge comes into the rectangle, or the rectangle lies inside.
bool meets(const Instances& all, std::uint32_t index, const Box& box) {
    const simd::TransformedEdges& edges = all.edges(index);
    const simd::AabbTree& tree = all.tree(index);
    const std::array<Vector, 4> corners{box.min(), box.corner(Box::BottomRight), box.max(),
                                        box.corner(Box::TopLeft)};
    const auto comes_in = [&](std::uint32_t edge) {
        const auto meets_side = [&](std::size_t side) {
            return geometry::segments_meet(corners[side], corners[(side + 1) % corners.size()],
                                           edges.start(edge), edges.end(edge), edges.rounding);
        };
        return box.contains(edges.start(edge)) || meets_side(0) || meets_side(1) || meets_side(2) ||
               meets_side(3);
    };
    const double reach = 2.0 * edges.rounding;
    bool found = false;
    simd::for_edges_near(
        tree, geometry::extent_of(box), [&] { return found ? -1.0 : reach * reach; },
        [&](std::uint32_t edge) { found = found || comes_in(edge); });
    return found || simd::kernels::contain(tree, box.min().x(), box.min().y());
}

void require_rectangles(std::span<const Rectangle> rectangles) {
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        const Rectangle& rectangle = rectangles[i];
        require_point(overlaps_call, "the low corner of rectangle", i, rectangle.min);
        require_point(overlaps_call, "the high corner of rectangle", i, rectangle.max);
        if (rectangle.max.x < rectangle.min.x || rectangle.max.y < rectangle.min.y) {
            refuse(overlaps_call, "the high corner of rectangle " + std::to_string(i) +
                                      " is below its low corner");
        }
    }
}

}  // namespace

/// Lists of instances, as one call writes them.
struct World::State::Lists {
    State& world;
    InstanceLists& lists;

    /// Writes one list per entry; `find(job, i, found)` appends the instances of entry i, in any
    /// order.
    template <class Find>
    void write(std::size_t count, const Find& find) {
        expect_answers(count);
        world.instance_lists.write(
            world.jobs, count, lists.offsets, lists.instances,
            [&](std::uint32_t number, std::size_t i, std::vector<InstanceHandle>& list) {
                Job& job = world.scratch[number];
                job.found.clear();
                find(job, i, job.found);
                std::sort(job.found.begin(), job.found.end(),
                          [this](std::uint32_t a, std::uint32_t b) {
                              return world.instances.number(a) < world.instances.number(b);
                          });
                for (const std::uint32_t index : job.found) {
                    list.push_back(world.instances.handle(index));
                }
                finish_answers(1);
            });
    }

    /// Entry i: the instances that meet the box of `box_of(i)`, for which `test(index, box)` is
    /// true.
    template <class BoxOf, class Test>
    void write_meeting(std::size_t count, const WorldFilter& filter, const BoxOf& box_of,
                       const Test& test) {
        const Instances& all = world.instances;
        write(count, [&](Job& /*job*/, std::size_t i, std::vector<std::uint32_t>& found) {
            const Box box = box_of(i);
            all.boxes().for_meeting(geometry::grown(box, all.max_rounding()),
                                    [&](std::uint32_t index) {
                                        if (all.passes(index, filter) && test(index, box)) {
                                            found.push_back(index);
                                        }
                                    });
        });
    }
};

Status World::find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                            const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        require_cpu(overlaps_call, options.technique);
        require_rectangles(rectangles);
        state_->prepare(options.filter, overlaps_call);
        const Instances& all = state_->instances;
        State::Lists{*state_, lists}.write_meeting(
            rectangles.size(), options.filter,
            [&](std::size_t i) {
                return Box(geometry::to_vector(rectangles[i].min),
                           geometry::to_vector(rectangles[i].max));
            },
            [&](std::uint32_t index, const Box& box) {
                return geometry::boxes_meet(all.box(index), box, all.rounding(index)) &&
                       meets(all, index, box);
            });
    });
}

Status World::find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                            const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        require_cpu(overlaps_call, options.technique);
        require_points(overlaps_call, points);
        state_->prepare(options.filter, overlaps_call);
        State::Lists{*state_, lists}.write_meeting(
            points.size(), options.filter,
            [&](std::size_t i) {
                const Vector point = geometry::to_vector(points[i]);
                return Box(point, point);
            },
            [&](std::uint32_t index, const Box& box) {
                return holds(state_->instances, index, box.min());
            });
    });
}

Status World::find_overlaps(ShapeHandle shape, std::span<const Pose> poses, InstanceLists& lists,
                            const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        require_cpu(overlaps_call, options.technique);
        const geometry::Polygon& polygon = state_->shape(shape, overlaps_call);
        require_poses(overlaps_call, poses);
        state_->prepare(options.filter, overlaps_call);
        for (State::Job& job : state_->scratch) {
            job.poses.begin(state_->instances, polygon, options.filter);
        }
        State::Lists{*state_, lists}.write(
            poses.size(), [&](State::Job& job, std::size_t i, std::vector<std::uint32_t>& found) {
                job.poses.find_intersecting({polygon, poses[i]}, found);
            });
    });
}

}  // namespace nearfield
