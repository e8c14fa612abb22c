#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/common/library_error.hpp>
#include <tools/hash/answer_hash.hpp>
#include <tools/hash/pairs.hpp>
#include <tools/hash/sections.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::hash {
namespace {

constexpr double side = 10.0;
constexpr double tolerance = 0.03;

Vector2 any_place(Integers& integers) {
    const double x = integers.from(0.0, side);
    return {x, integers.from(0.0, side)};
}

Pose any_pose(Integers& integers) {
    return {any_place(integers), integers.from(-4.0, 8.0)};
}

/// A table of each kind.
struct Tables {
    PairTable<PenetrationQuery> penetration{{.tolerance = tolerance}};
    PairTable<ContactQuery> contacts{{.tolerance = tolerance, .contact_distance = 0.1},
                                     {.reach = 0.1}};
    PairTable<IntersectionQuery> intersection{{.tolerance = tolerance}};
    PairTable<ClosestPointQuery> closest{{.tolerance = tolerance}, {.reach = 0.3}};
    PairTable<SeparationQuery> separation{{.tolerance = tolerance}, {.reach = 0.3}};
    PairTable<IntersectionTestQuery> test{{}};
    PairTable<SeparationVectorQuery> vector{{.tolerance = tolerance, .max_work = 2'000}};

    void add_to(World& world, AnswerHash& hash) {
        const auto add = [&](auto& table) {
            tools::require(world.update(table));
            hash.add(table);
        };
        add(penetration);
        add(contacts);
        add(intersection);
        add(closest);
        add(separation);
        add(test);
        add(vector);
    }
};

void ask_of_shape(World& world, ShapeHandle shape, Integers& integers, AnswerHash& hash) {
    std::vector<Pose> poses;
    std::vector<Sweep> sweeps;
    for (int i = 0; i < 8; ++i) {
        poses.push_back(any_pose(integers));
        const Pose start = any_pose(integers);
        sweeps.push_back({start, any_pose(integers)});
    }
    std::vector<std::uint8_t> intersects(poses.size());
    tools::require(world.test_poses(shape, poses, intersects));
    hash.add(intersects);
    std::vector<Clearance> clearances(poses.size());
    tools::require(world.find_clearances({.shape = shape}, poses, clearances));
    hash.add(clearances);
    std::vector<Clearance> nearest(3 * poses.size());
    tools::require(
        world.find_nearest(ShapeNearestQuery{.shape = shape, .count = 3}, poses, nearest));
    hash.add(nearest);
    std::vector<ShapeEdgeHit> edges(3 * poses.size());
    tools::require(world.find_nearest(ShapeEdgeQuery{.shape = shape, .count = 3}, poses, edges));
    hash.add(edges);
    std::vector<ShapeCastHit> casts(sweeps.size());
    tools::require(world.cast_shape({.shape = shape, .tolerance = 1e-4}, sweeps, casts));
    hash.add(casts);
    InstanceLists lists;
    tools::require(world.find_overlaps(shape, poses, lists));
    hash.add(lists);
}

void ask_of_points(World& world, Integers& integers, AnswerHash& hash) {
    std::vector<Vector2> points;
    std::vector<Segment> segments;
    std::vector<Rectangle> rectangles;
    for (int i = 0; i < 8; ++i) {
        const Vector2 point = points.emplace_back(any_place(integers));
        segments.push_back({point, any_place(integers)});
        rectangles.push_back({point, {point.x + 0.7, point.y + 0.9}});
    }
    for (const NearestKind kind : {NearestKind::instances, NearestKind::edges}) {
        std::vector<NearestHit> nearest(3 * points.size());
        tools::require(world.find_nearest({.count = 3, .kind = kind}, points, nearest));
        hash.add(nearest);
    }
    std::vector<RayHit> first(segments.size());
    tools::require(world.cast_rays(segments, first));
    hash.add(first);
    RayHits all;
    tools::require(world.cast_rays(segments, all));
    hash.add(all.offsets);
    hash.add(all.hits);
    InstanceLists lists;
    tools::require(world.find_overlaps(rectangles, lists));
    hash.add(lists);
    tools::require(world.find_overlaps(points, lists));
    hash.add(lists);
}

}  // namespace

std::uint64_t hash_world(const MakeContext& make_context) {
    constexpr int steps = 40;
    constexpr std::size_t moves_of_step = 10;
    AnswerHash hash;
    Integers integers(11);
    Context context = make_context({});
    World world = tools::take(World::create(context));
    constexpr int shape_count = 8;
    std::vector<ShapeHandle> shapes;
    shapes.reserve(shape_count);
    for (int i = 0; i < shape_count; ++i) {
        shapes.push_back(tools::take(context.add_shape(any_shape(integers))));
    }
    std::vector<InstanceHandle> members;
    const auto any_below = [&](std::size_t count) {
        return integers.below(static_cast<std::uint32_t>(count));
    };
    const auto add = [&] {
        const ShapeHandle shape = shapes[any_below(shapes.size())];
        members.push_back(tools::take(world.add({.shape = shape, .pose = any_pose(integers)})));
    };
    for (int i = 0; i < 50; ++i) {
        add();
    }
    Tables tables;
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < moves_of_step; ++i) {
            const InstanceHandle member = members[any_below(members.size())];
            tools::require(world.move(member, any_pose(integers)));
        }
        const std::size_t gone = any_below(members.size());
        tools::require(world.remove(members[gone]));
        members.erase(members.begin() + static_cast<std::ptrdiff_t>(gone));
        add();
        const ShapeHandle changed = shapes[any_below(shapes.size())];
        tools::require(context.update_shape(changed, any_shape(integers)));
        tables.add_to(world, hash);
        ask_of_shape(world, shapes[any_below(shapes.size())], integers, hash);
        ask_of_points(world, integers, hash);
    }
    return hash.value();
}

}  // namespace nearfield::hash
