#include <nearfield/curve.hpp>
#include <nearfield/fill.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <embedded/austria_50m.hpp>
#include <embedded/cuba_50m.hpp>
#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <embedded/sri_lanka_10m.hpp>
#include <embedded/sweden_50m.hpp>
#include <tools/common/library.hpp>
#include <tools/hash/answer_hash.hpp>
#include <tools/hash/sections.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/simulation/scenes.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <numbers>
#include <utility>
#include <vector>

namespace nearfield::hash {
namespace {

/// Random numbers by integer arithmetic alone (splitmix64), so that they are the same everywhere.
class Integers {
public:
    explicit Integers(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27U) * 0x94D049BB133111EB;
        return z ^ z >> 31U;
    }
    /// From 0 to `count` - 1.
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>((next() >> 32U) * count >> 32U);
    }
    /// A multiple of 2^-52 in [low, low + length).
    double from(double low, double length) {
        return low + length * (static_cast<double>(next() >> 12U) * 0x1p-52);
    }

private:
    std::uint64_t state_;
};

/// Two shapes, and how large their details are.
struct Pair {
    std::vector<Ring> a;
    std::vector<Ring> b;
    Pose pose_a;
    Pose pose_b;
    double tolerance = 0.0;
};

constexpr double turn = 2.0 * std::numbers::pi;

/// Vertices at equal angles and random distances, from `least` to 1.
Ring star(Integers& integers, std::uint32_t count, double least) {
    Ring ring;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto [sine, cosine] = sine_cosine(turn * i / count);
        const double radius = integers.from(least, 1.0 - least);
        ring.push_back({radius * cosine, radius * sine});
    }
    return ring;
}

Ring scaled(Ring ring, double factor) {
    for (Vector2& vertex : ring) {
        vertex = {factor * vertex.x, factor * vertex.y};
    }
    return ring;
}

/// A staircase on a lattice of eighths: edges of different shapes lie on common lines.
Ring staircase(Integers& integers) {
    const std::uint32_t steps = 1 + integers.below(6);
    Ring ring{{-0.5, -0.5}};
    double x = -0.5;
    double y = -0.5 + 0.125 * (steps + integers.below(3));
    ring.push_back({x + 0.125 * (2 * steps), -0.5});
    for (std::uint32_t i = steps; i > 0; --i) {
        x = -0.5 + 0.25 * i;
        ring.push_back({x, y});
        ring.push_back({x - 0.25 + 0.125 * integers.below(2), y});
        y += 0.125 * integers.below(2);
    }
    ring.push_back({-0.5, y + 0.125});
    return ring;
}

/// Random vertices, so edges cross.
Ring tangle(Integers& integers) {
    Ring ring;
    for (std::uint32_t i = 4 + integers.below(9); i > 0; --i) {
        const double x = integers.from(-1.0, 2.0);
        ring.push_back({x, integers.from(-1.0, 2.0)});
    }
    return ring;
}

/// A random shape of up to about 40 vertices, within 1 or so of the origin: a star, a spiky star,
/// one with a hole, a ring that crosses itself, or a polygon on a lattice.
std::vector<Ring> any_shape(Integers& integers) {
    switch (integers.below(6)) {
        case 0:
            return {star(integers, 3 + integers.below(4), 0.7)};
        case 1:
            return {star(integers, 5 + integers.below(36), 0.05)};
        case 2: {
            const Ring outer = star(integers, 5 + integers.below(12), 0.7);
            return {outer, scaled(star(integers, 3 + integers.below(6), 0.6), 0.6)};
        }
        case 3:
            return {tangle(integers)};
        case 4:
            return {staircase(integers)};
        default:
            return {star(integers, 5 + integers.below(20), 0.5)};
    }
}

/// A random pair that overlaps, touches or is close. Half of the pairs are degenerate: a shape with
/// itself, also moved by its own coordinates or by almost nothing, and shapes on one lattice. Some
/// are far from the origin.
Pair any_pair(Integers& integers) {
    Pair pair;
    pair.a = any_shape(integers);
    pair.tolerance = integers.from(0.02, 0.08);
    const auto kind = integers.below(8);
    const bool same = kind < 3;
    pair.b = same ? pair.a : any_shape(integers);
    if (same) {  // by an edge, by almost nothing, or not at all
        const Ring& ring = pair.a.front();
        const std::size_t i = integers.below(static_cast<std::uint32_t>(ring.size()));
        const Vector2 from = ring[i];
        const Vector2 to = ring[(i + 1) % ring.size()];
        const double part = kind == 0 ? 1.0 : kind == 1 ? 1e-9 : 0.0;
        pair.pose_b.translation = {part * (to.x - from.x), part * (to.y - from.y)};
    } else if (kind == 3) {
        pair.a = {staircase(integers)};
        pair.b = {staircase(integers)};
        const double x = 0.125 * integers.below(7);
        pair.pose_b.translation = {x, 0.125 * integers.below(7)};
        pair.pose_b.angle = 0.25 * turn * integers.below(4);
    } else {
        pair.pose_a.angle = integers.from(-4.0, 8.0);
        pair.pose_b.angle = integers.from(-1e3, 2e3);
        const double x = integers.from(-1.6, 3.2);
        pair.pose_b.translation = {x, integers.from(-1.6, 3.2)};
    }
    if (integers.below(8) == 0) {
        for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
            pose->translation.x += 1e6;
            pose->translation.y -= 3e5;
        }
    }
    return pair;
}

/// Two shapes of a context at their poses.
struct PlacedPair {
    Instance a;
    Instance b;
    double tolerance = 0.0;
};

constexpr Technique cpu = Technique::cpu;

void ask_of_points(const PlacedPair& pair, Batch& batch) {
    for (const PenetrationPoints points :
         {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
        for (const bool records : {true, false}) {
            batch.add(PenetrationQuery{.a = pair.a,
                                       .b = pair.b,
                                       .tolerance = pair.tolerance,
                                       .points = points,
                                       .summary_only = !records,
                                       .technique = cpu});
        }
    }
    for (const ContactNormals normals : {ContactNormals::analytic, ContactNormals::gradient}) {
        batch.add(ContactQuery{.a = pair.a,
                               .b = pair.b,
                               .tolerance = pair.tolerance,
                               .contact_distance = 2.0 * pair.tolerance,
                               .normals = normals,
                               .technique = cpu});
    }
}

void ask_of_cells(const PlacedPair& pair, std::span<const Vector2> points, Batch& batch) {
    for (const IntersectionKind kind :
         {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
          IntersectionKind::volume_volume}) {
        batch.add(IntersectionQuery{
            .a = pair.a, .b = pair.b, .tolerance = pair.tolerance, .kind = kind, .technique = cpu});
    }
    DistanceFieldQuery field{
        .a = pair.a, .b = pair.b, .tolerance = pair.tolerance, .technique = cpu};
    batch.add(field);
    field.features = true;
    field.gradients = true;
    batch.add(field);
    field.gradient = GradientMethod::central_differences;
    field.features = false;
    batch.add(field);
    const Vector2 middle = pair.b.pose.translation;
    field.rectangle = Rectangle{{middle.x - 1.0, middle.y - 1.0}, {middle.x + 1.0, middle.y + 1.0}};
    field.points = points;
    batch.add(field);
}

void ask_of_shapes(const PlacedPair& pair, std::uint64_t max_work, Batch& batch) {
    batch.add(
        ClosestPointQuery{.a = pair.a, .b = pair.b, .tolerance = pair.tolerance, .technique = cpu});
    batch.add(
        SeparationQuery{.a = pair.a, .b = pair.b, .tolerance = pair.tolerance, .technique = cpu});
    batch.add(IntersectionTestQuery{.a = pair.a, .b = pair.b, .technique = cpu});
    batch.add(ContainmentQuery{.a = pair.a, .b = pair.b, .technique = cpu});
    batch.add(SeparationVectorQuery{.a = pair.a,
                                    .b = pair.b,
                                    .tolerance = pair.tolerance,
                                    .max_work = max_work,
                                    .technique = cpu});
    // From apart, past each other.
    TimeOfImpactQuery impact{
        .a = pair.a, .b = pair.b, .tolerance = 0.01 * pair.tolerance, .technique = cpu};
    impact.a.pose.translation.x -= 5.0;
    impact.end_a = impact.a.pose;
    impact.end_a.translation.x += 10.0;
    impact.end_a.angle += 1.0;
    impact.end_b = impact.b.pose;
    impact.end_b.angle -= 0.5;
    batch.add(impact);
    impact.contact_distance = pair.tolerance;
    batch.add(impact);
}

/// Appends every kind of query that Technique::cpu answers, with every option that makes a
/// difference to it. `points`: where fields are asked at points; they must outlive the batch.
/// `max_work`: of separation vectors.
void ask_everything(const PlacedPair& pair, std::span<const Vector2> points, std::uint64_t max_work,
                    Batch& batch) {
    ask_of_points(pair, batch);
    ask_of_cells(pair, points, batch);
    ask_of_shapes(pair, max_work, batch);
}

/// Runs a batch and adds its answers.
void add_answers(Context& context, const Batch& batch, Results& results, AnswerHash& hash) {
    tools::require(context.run(batch, results));
    for (const AnyResult& result : results.results) {
        hash.add(result);
    }
}

ShapeHandle add_shape(Context& context, std::span<const Ring> rings, double deviation = 0.0) {
    return tools::take(context.add_shape(rings, deviation));
}

/// Curves of every kind, as rings.
std::vector<Ring> curves(double deviation) {
    CurvePath path;
    path.move_to({-1.0, 0.0})
        .cubic_to({-1.5, 1.0}, {0.0, 1.2}, {0.1, 0.6})
        .quadratic_to({1.0, 1.5}, {1.2, 0.1})
        .arc_to({.radius_x = 0.9, .radius_y = 0.4, .rotation = 0.7, .large = true}, {0.3, -0.8})
        .arc_about({-0.2, -0.7}, 2.5)
        .close()
        .circle({0.1, 0.2}, 0.25)
        .ellipse({-0.5, 0.1}, 0.3, 0.1, 1.1);
    return tools::take(tessellate(path, deviation));
}

/// The rings of a GeoJSON text, scaled to a width of 2 around the origin.
std::vector<Ring> outline(const char* text) {
    std::vector<Ring> rings = tools::parse_geojson(text, "outline");
    Vector2 low = rings.front().front();
    Vector2 high = low;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
        }
    }
    const double scale = 2.0 / (high.x - low.x);
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {scale * (vertex.x - 0.5 * (low.x + high.x)),
                      scale * (vertex.y - 0.5 * (low.y + high.y))};
        }
    }
    return rings;
}

}  // namespace

std::uint64_t hash_pairs(const MakeContext& make_context, std::uint32_t first,
                         std::uint32_t count) {
    constexpr std::uint32_t pairs_of_batch = 25;
    AnswerHash hash;
    Context context = make_context({});
    Results results;
    Batch batch;
    std::vector<ShapeHandle> shapes;
    const std::vector<Vector2> points{{0.1, 0.2}, {-0.4, 0.3}, {0.5, -0.6}};
    std::vector<std::vector<Vector2>> moved(pairs_of_batch);
    for (std::uint32_t begin = first; begin < first + count; begin += pairs_of_batch) {
        batch.clear();
        shapes.clear();
        const std::uint32_t end = std::min(begin + pairs_of_batch, first + count);
        for (std::uint32_t i = begin; i < end; ++i) {
            Integers integers(i);
            const Pair pair = any_pair(integers);
            const ShapeHandle a = shapes.emplace_back(add_shape(context, pair.a));
            const ShapeHandle b = shapes.emplace_back(add_shape(context, pair.b));
            std::vector<Vector2>& around = moved[i - begin];
            around = points;
            for (Vector2& point : around) {
                point = {point.x + pair.pose_b.translation.x, point.y + pair.pose_b.translation.y};
            }
            ask_everything({{a, pair.pose_a}, {b, pair.pose_b}, pair.tolerance}, around, 5'000,
                           batch);
        }
        add_answers(context, batch, results, hash);
        for (const ShapeHandle shape : shapes) {
            tools::require(context.remove_shape(shape));
        }
    }
    return hash.value();
}

namespace {

/// The outlines of tests/data with each other, their fills and tessellated curves.
std::uint64_t hash_outlines(const MakeContext& make_context) {
    constexpr double deviation = 1e-3;
    AnswerHash hash;
    const std::vector<Vector2> points{{0.1, 0.2}, {-0.4, 0.3}, {0.5, -0.6}};
    for (const BoundingVolume volume : {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
        Context context = make_context({.bounding_volume = volume});
        std::vector<ShapeHandle> shapes;
        for (const char* text :
             {embedded::iceland_10m, embedded::ireland_10m, embedded::sri_lanka_10m,
              embedded::austria_50m, embedded::cuba_50m, embedded::sweden_50m}) {
            shapes.push_back(add_shape(context, outline(text)));
        }
        const std::vector<Ring> rings = curves(deviation);
        for (const Ring& ring : rings) {
            hash.add(std::span<const Vector2>(ring));
        }
        shapes.push_back(add_shape(context, rings, deviation));
        Batch batch;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const Instance a{shapes[i], {{0.3, -0.1}, 0.4}};
            const Instance b{shapes[(i + 1) % shapes.size()], {{-0.2, 0.1}, -1.3}};
            ask_everything({a, b, 0.02}, points, 20'000, batch);
            ask_everything({b, b, 0.02}, points, 20'000, batch);
        }
        Results results;
        add_answers(context, batch, results, hash);
    }
    Integers integers(3);
    for (int i = 0; i < 200; ++i) {
        const ResolvedFill filled =
            tools::take(resolve_fill(any_shape(integers), FillRule::nonzero));
        for (const Ring& ring : filled.rings) {
            hash.add(std::span<const Vector2>(ring));
        }
    }
    return hash.value();
}

void add_frames(Context& context, simulation::Scene scene, simulation::Response response,
                AnswerHash& hash) {
    constexpr int frames = 120;
    simulation::World world(context, std::move(scene), response, Technique::cpu);
    for (int i = 0; i < frames; ++i) {
        const simulation::FrameReport report = world.advance();
        const simulation::Energies& energies = report.energies;
        for (const double number : {energies.kinetic, energies.potential, energies.elastic,
                                    energies.contact, report.worst_penetration}) {
            hash.add(number);
        }
        hash.add(report.contacts);
        hash.add(report.events);
        for (const auto& body : world.scene().bodies) {
            hash.add(body->pose());
            if (body->deforms()) {
                for (const Ring& ring : body->rings()) {
                    hash.add(std::span<const Vector2>(ring));
                }
            }
        }
    }
}

/// A simulation of the paper, by both responses if its bodies are rigid.
std::uint64_t hash_simulation(const MakeContext& make_context, std::size_t scene) {
    const auto make_scene = simulation::paper_scenes()[scene].make;
    AnswerHash hash;
    Context context = make_context({});
    add_frames(context, make_scene(), simulation::Response::penalty, hash);
    const simulation::Scene again = make_scene();
    const bool rigid = std::none_of(again.bodies.begin(), again.bodies.end(),
                                    [](const auto& body) { return body->deforms(); });
    if (rigid) {
        Context fresh = make_context({});
        add_frames(fresh, make_scene(), simulation::Response::backtracking, hash);
    }
    return hash.value();
}

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

namespace {

constexpr std::uint32_t quick_pairs = 1'000;
constexpr std::uint32_t all_pairs = 100'000;

std::vector<Section> make_sections() {
    std::vector<Section> all{
        {"pairs", [](const MakeContext& make) { return hash_pairs(make, 0, quick_pairs); }},
        {"outlines", hash_outlines},
        {"world", hash_world},
        {"more_pairs",
         [](const MakeContext& make) {
             return hash_pairs(make, quick_pairs, all_pairs - quick_pairs);
         },
         false}};
    const auto scenes = simulation::paper_scenes();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        all.push_back({scenes[i].name,
                       [i](const MakeContext& make) { return hash_simulation(make, i); }, false});
    }
    return all;
}

}  // namespace

std::span<const Section> sections() {
    static const std::vector<Section> all = make_sections();
    return all;
}

void print_hashes(const MakeContext& make_context, bool quick, std::ostream& stream) {
    for (const Section& section : sections()) {
        if (section.quick || !quick) {
            stream << std::left << std::setfill(' ') << std::setw(12) << section.name << std::right
                   << std::hex << std::setfill('0') << std::setw(16) << section.hash(make_context)
                   << std::dec << std::endl;
        }
    }
}

Context cpu_context(const Settings& settings) {
    return tools::take(Context::create_cpu(settings));
}

}  // namespace nearfield::hash
