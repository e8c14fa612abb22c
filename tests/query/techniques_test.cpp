#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t techniques_seed = 1618;

class Techniques : public QueryTest {};

// All points touch, so the device leaves all to the CPU, which locates some tens of thousands at
// once.
TEST_F(Techniques, AgreeOnMorePointsThanAreLocatedAtOnce) {
    const NamedRings pentagons{"pentagons", nested_pentagons(300)};
    const Pair pair{pentagons, pentagons, {}, {}, 0.009};
    const PlacedPair cpu(context(), pair, Technique::cpu);
    const ContactResult exact = run_alone(context(), cpu.contacts(1e-3));
    EXPECT_GT(exact.points.size(), 140000U);
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        const PlacedPair device(context(), pair, technique);
        const ContactResult found = run_alone(context(), device.contacts(1e-3));
        ASSERT_EQ(found.points.size(), exact.points.size());
        Report report("contacts");
        for (std::size_t i = 0; i < exact.points.size(); ++i) {
            report.require(found.points[i].distance == exact.points[i].distance &&
                               found.points[i].position == exact.points[i].position,
                           "contact ", i);
        }
    }
}

TEST_F(Techniques, CrossingWithoutAVertexInside) {
    const Rings upright = rectangle({-1, -5}, {1, 5});
    const Rings lying = rectangle({-5, -1}, {5, 1});
    const PlacedPair cross(context(), {{"A", upright}, {"B", lying}, {}, {}, 0.05}, Technique::cpu);
    const auto query = cross.penetration(PenetrationPoints::vertices);
    const PenetrationResult result = run_alone(context(), query);
    EXPECT_EQ(result.count, 0U);
    EXPECT_TRUE(result.intersects);
    // Two shapes that each occur more than once in a batch, at different poses.
    Batch batch;
    Results results;
    std::vector<QueryHandle<PenetrationQuery>> handles;
    for (int i = 0; i < 200; ++i) {
        PenetrationQuery moved = query;
        moved.b.pose.translation.y = 0.1 * (i % 100);
        handles.push_back(batch.add(moved));
    }
    ASSERT_TRUE(context().run(batch, results).ok());
    for (int i = 0; i < 200; ++i) {
        const double y = 0.1 * (i % 100);
        EXPECT_EQ(results[handles[static_cast<std::size_t>(i)]].intersects, y < 6.05) << y;
        EXPECT_EQ(results[handles[static_cast<std::size_t>(i)]].count > 0, y > 4.05 && y < 5.95)
            << y;
    }
}

TEST_F(Techniques, AFrameOfTheCpuLikeTheOneBeforeAllocatesNothing) {
    Random random(techniques_seed);
    std::vector<Rings> rings;
    std::vector<ShapeHandle> shapes;
    for (const int n : {12, 30, 50, 200}) {
        rings.push_back(star(random, n, 0.5));
        shapes.push_back(*context().add_shape(rings.back()));
    }
    const std::vector<Vector2> points{{0.1, 0.2}, {-0.4, 0.9}};
    Batch batch;
    Results results;
    bool good = true;
    const auto frame = [&] {
        batch.clear();
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            good = good && context().update_shape(shapes[i], rings[i]).ok();
        }
        for (std::size_t i = 0; i < 16; ++i) {
            const Instance a{shapes[i % 4], {{0.1, 0.2}, 0.4}};
            const Instance b{shapes[i / 4], {{0.9, 0.1}, 0.0}};
            batch.add(
                PenetrationQuery{a, b, 0.01, PenetrationPoints::vertices, true, Technique::cpu});
            batch.add(
                PenetrationQuery{a, b, 0.01, PenetrationPoints::vertices, false, Technique::cpu});
            batch.add(
                PenetrationQuery{a, b, 0.01, PenetrationPoints::boundary, false, Technique::cpu});
            IntersectionQuery overlap{a, b, 0.01};
            overlap.kind = static_cast<IntersectionKind>(i % 3);
            overlap.technique = Technique::cpu;
            batch.add(overlap);
            DistanceFieldQuery field{a, b, 0.01, std::nullopt};
            field.technique = Technique::cpu;
            batch.add(field);
            field.features = field.gradients = true;
            field.points = points;
            field.rectangle = {{-1, -1}, {1, 1}};
            batch.add(field);
            batch.add(SeparationQuery{a, b, 0.01, Technique::cpu});
            batch.add(IntersectionTestQuery{a, b});
            batch.add(ContainmentQuery{a, b});
            batch.add(ContainmentQuery{a, a});
            batch.add(TimeOfImpactQuery{{a.shape, {{-4, 1}, 0.0}}, b, a.pose, b.pose, 0.01});
            batch.add(SeparationVectorQuery{a, b, 0.01});
            batch.add(SeparationQuery{a, {b.shape, {{4, 4}, 0.0}}, 0.01, Technique::cpu});
            batch.add(
                ContactQuery{a, b, 0.01, 0.02, ContactNormals::analytic, false, Technique::cpu});
        }
        good = good && context().run(batch, results).ok();
    };
    frame();
    frame();
    const std::uint64_t before = test_support::allocation_count();
    frame();
    const std::uint64_t after = test_support::allocation_count();
    EXPECT_EQ(after, before);
    EXPECT_TRUE(good);
    for (const AnyResult& result : results.results) {
        std::visit([](const auto& any) { EXPECT_TRUE(any.status.ok()) << any.status.text(); },
                   result);
    }
    for (const ShapeHandle shape : shapes) {
        EXPECT_TRUE(context().remove_shape(shape).ok());
    }
}

}  // namespace
}  // namespace nearfield::test
