#include <tools/hash/questions.hpp>

namespace nearfield::hash {
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
