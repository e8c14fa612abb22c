#include <tests/query/frames.hpp>

namespace nearfield::test {

Batch Frames::batch(int number) const {
    const Instance here{a_, {}};
    const Instance there{b_, {{0.7, 0.1 * number}, 0.3}};
    const Instance apart{b_, {{3.0, 0.1 * number}, 0.3}};
    Batch batch;
    for (const Technique technique : {device_techniques.front(), Technique::cpu}) {
        batch.add(PenetrationQuery{here, there, 0.04, {}, false, technique});
        batch.add(ContactQuery{here, there, 0.04, 0.05, {}, false, technique});
        batch.add(SeparationQuery{here, apart, 0.04, technique});
        batch.add(ClosestPointQuery{here, apart, 0.04, technique});
    }
    batch.add(drawn(IntersectionQuery{here, there, 0.04}));
    batch.add(drawn(IntersectionQuery{here, there, 0.04, IntersectionKind::boundary_volume}));
    batch.add(drawn(ContactQuery{here, there, 0.04, 0.05, ContactNormals::gradient}));
    DistanceFieldQuery field;
    field.technique = device_techniques.front();
    field.b = there;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    field.features = true;
    field.points = field_points_;
    batch.add(field);
    return batch;
}

}  // namespace nearfield::test
