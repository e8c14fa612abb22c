#include <tests/query/every_query.hpp>
#include <tests/support/techniques.hpp>

namespace nearfield::test {
namespace {

constexpr Vector2 field_points[] = {{0.1, 0.2}, {-0.3, 0.4}};

void add_points(Batch& batch, const Instance& a, const Instance& b) {
    const Instance apart{b.shape, {{3.0, b.pose.translation.y}, b.pose.angle}};
    for (const Technique technique : every_technique) {
        for (const PenetrationPoints points :
             {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            batch.add(PenetrationQuery{a, b, 0.05, points, false, technique});
        }
        batch.add(ContactQuery{a, b, 0.05, 0.05, ContactNormals::analytic, false, technique});
        batch.add(ContactQuery{a, b, 0.05, 0.05, ContactNormals::gradient, false, technique});
        batch.add(SeparationQuery{a, apart, 0.05, technique});
        batch.add(ClosestPointQuery{a, apart, 0.05, technique});
    }
    batch.add(IntersectionTestQuery{a, b, Technique::cpu});
    batch.add(TimeOfImpactQuery{a, apart, {{5.0, 0.0}, 1.0}, apart.pose, 0.05});
    batch.add(SeparationVectorQuery{a, b, 0.05});
    batch.add(ContainmentQuery{a, b});
    batch.add(ContainmentQuery{a, a});
}

void add_intersections(Batch& batch, const Instance& a, const Instance& b) {
    for (const IntersectionKind kind :
         {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
          IntersectionKind::boundary_boundary}) {
        for (const Technique technique : every_technique) {
            batch.add(IntersectionQuery{a, b, 0.05, kind, false, IntersectionStrategy::stencil,
                                        technique});
        }
    }
}

/// With all that a field can state.
DistanceFieldQuery every_field(const Instance& b) {
    DistanceFieldQuery field;
    field.b = b;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    field.features = true;
    field.gradients = true;
    field.points = field_points;
    return field;
}

void add_fields(Batch& batch, const Instance& b) {
    DistanceFieldQuery field = every_field(b);
    for (const Technique technique : every_technique) {
        field.technique = technique;
        for (const GradientMethod gradient :
             {GradientMethod::analytic, GradientMethod::central_differences}) {
            field.gradient = gradient;
            batch.add(field);
        }
    }
    for (const Technique technique : device_techniques) {
        DistanceFieldQuery values;
        values.b = b;
        values.tolerance = 0.1;
        values.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        values.technique = technique;
        batch.add(values);
    }
}

/// What only technique raster answers in several ways.
void add_drawn(Batch& batch, const Instance& a, const Instance& b) {
    for (const IntersectionKind kind :
         {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
          IntersectionKind::boundary_boundary}) {
        for (const IntersectionStrategy strategy :
             {IntersectionStrategy::blend, IntersectionStrategy::depth}) {
            batch.add(IntersectionQuery{a, b, 0.05, kind, false, strategy, Technique::raster});
        }
    }
    DistanceFieldQuery field = every_field(b);
    field.technique = Technique::raster;
    field.gradient = GradientMethod::blended;
    for (const SignEncoding sign :
         {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
        field.sign = sign;
        batch.add(field);
    }
}

}  // namespace

Batch every_query(ShapeHandle a, ShapeHandle b, int number) {
    Batch batch;
    const Instance here{a, {}};
    const Instance there{b, {{0.7, 0.1 * number}, 0.3}};
    add_points(batch, here, there);
    add_intersections(batch, here, there);
    add_fields(batch, there);
    if (has_raster) {
        add_drawn(batch, here, there);
    }
    return batch;
}

Batch resident_queries(const Batch& every) {
    Batch batch;
    for (const AnyQuery& query : every.queries()) {
        std::visit(
            [&](auto kept) {
                if constexpr (requires { kept.on_device; }) {
                    bool can_stay = kept.technique == Technique::compute;
                    if constexpr (requires { kept.normals; }) {
                        can_stay = can_stay && kept.normals == ContactNormals::analytic;
                    }
                    if (can_stay) {
                        kept.on_device = true;
                        batch.add(kept);
                    }
                }
            },
            query);
    }
    return batch;
}

}  // namespace nearfield::test
