#include <nearfield/portable_math.hpp>

#include <tools/hash/questions.hpp>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace nearfield::hash {
namespace {

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

}  // namespace

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

namespace {

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

}  // namespace

void ask_everything(const PlacedPair& pair, std::span<const Vector2> points, std::uint64_t max_work,
                    Batch& batch) {
    ask_of_points(pair, batch);
    ask_of_cells(pair, points, batch);
    ask_of_shapes(pair, max_work, batch);
}

}  // namespace nearfield::hash
