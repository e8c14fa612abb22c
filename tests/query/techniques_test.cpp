#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/match.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/scanline_reference.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nearfield::test {
namespace {

constexpr std::uint64_t techniques_seed = 1618;

/// Compares the CPU's answers with the oracle, and all techniques with each other.
class Techniques : public QueryTest {
protected:
    static void check(const Pair& pair) {
        const PlacedPair cpu(context(), pair, Technique::cpu);
        const CorpusKeeper keeper(pair, 2.0 * pair.tolerance);
        SCOPED_TRACE(describe(pair));
        for (const Technique technique : device_techniques) {
            SCOPED_TRACE(to_string(technique));
            const PlacedPair device(context(), pair, technique);
            check_penetrations(device, cpu);
            check_all_contacts(device, cpu);
            check_closest(device, cpu);
        }
    }

    /// The same for answers with a value at every cell; the tests of fields and strategies cover
    /// other pairs.
    static void check_dense(const Pair& pair) {
        const PlacedPair raster(context(), pair, Technique::raster);
        const PlacedPair cpu(context(), pair, Technique::cpu);
        SCOPED_TRACE(describe(pair));
        check_intersections(raster, cpu);
        check_fields(raster, cpu);
    }

    static void check_intersections(const PlacedPair& raster, const PlacedPair& cpu) {
        for (const auto kind :
             {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
              IntersectionKind::volume_volume}) {
            const IntersectionResult exact = run_alone(context(), cpu.intersection(kind));
            const IntersectionResult drawn = run_alone(context(), raster.intersection(kind));
            ASSERT_TRUE(exact.status.ok()) << exact.status.text();
            EXPECT_EQ(exact.technique, Technique::cpu);
            EXPECT_EQ(exact.intersects, drawn.intersects);
            if (grid_of(host_device()).steps != geometry::cpu_grid.steps) {
                continue;  // other samples; the tests of strategies compare each with a scan
            }
            EXPECT_EQ(exact.count, drawn.count);
            EXPECT_EQ(exact.box.min, drawn.box.min);
            EXPECT_EQ(exact.box.max, drawn.box.max);
            ASSERT_EQ(exact.samples.size(), drawn.samples.size());
            Report report("samples of kind " + std::to_string(static_cast<int>(kind)));
            for (std::size_t i = 0; i < exact.samples.size(); ++i) {
                report.require(exact.samples[i].position == drawn.samples[i].position &&
                                   exact.samples[i].edge == drawn.samples[i].edge,
                               "sample ", i);
            }
        }
    }

    static void check_fields(const PlacedPair& raster, const PlacedPair& cpu) {
        DistanceFieldQuery query;
        query.a = raster.instance_a();
        query.b = raster.instance_b();
        query.tolerance = raster.tolerance();
        const DistanceFieldResult drawn = run_alone(context(), query);
        query.a = cpu.instance_a();
        query.b = cpu.instance_b();
        query.technique = Technique::cpu;
        const DistanceFieldResult exact = run_alone(context(), query);
        EXPECT_EQ(exact.status.code(), drawn.status.code()) << exact.status.text();
        EXPECT_EQ(exact.intersects, drawn.intersects);
        ASSERT_EQ(exact.values.size(), drawn.values.size());
        Report report("values");
        const double most = drawn.error_bound + exact.error_bound + cpu.rounding();
        for (std::size_t i = 0; i < exact.values.size(); ++i) {
            const double difference = std::abs(static_cast<double>(exact.values[i]) -
                                               static_cast<double>(drawn.values[i]));
            report.require(difference <= most, "cell ", i, ": ", exact.values[i], " and ",
                           drawn.values[i]);
        }
    }

    static void check_penetrations(const PlacedPair& device, const PlacedPair& cpu) {
        for (const PenetrationPoints points : both_ways) {
            PenetrationQuery query = cpu.penetration(points);
            const PenetrationResult exact = run_alone(context(), query);
            check_penetration(cpu, points, exact);
            EXPECT_EQ(exact.technique, Technique::cpu);
            const PenetrationResult drawn = run_alone(context(), device.penetration(points));
            EXPECT_EQ(drawn.technique, device.penetration().technique);
            EXPECT_EQ(exact.intersects, drawn.intersects);
            const double d = cpu.tolerance();
            match(
                exact.points, drawn.points,
                [&](const PenetratingPoint& i, const PenetratingPoint& j) {
                    EXPECT_LE(std::abs(i.depth - j.depth), 1e-3 * d);
                },
                [&](const PenetratingPoint& touching) {
                    EXPECT_LE(touching.depth, 1e-3 * d)
                        << touching.position.x << ", " << touching.position.y;
                });

            query.summary_only = true;
            const PenetrationResult summary = run_alone(context(), query);
            EXPECT_TRUE(summary.points.empty());
            EXPECT_EQ(summary.count, exact.count);
            EXPECT_EQ(summary.intersects, exact.intersects);
            EXPECT_EQ(summary.deepest.depth, exact.deepest.depth);
            EXPECT_EQ(summary.deepest.unique, exact.deepest.unique);
        }
    }

    static void check_all_contacts(const PlacedPair& device, const PlacedPair& cpu) {
        const double d = cpu.tolerance();
        const double near = 2.0 * d;
        const ContactResult exact = run_alone(context(), cpu.contacts(near));
        check_contacts(cpu, near, exact);
        EXPECT_EQ(exact.technique, Technique::cpu);
        const ContactResult drawn = run_alone(context(), device.contacts(near));
        for (const Side side : {Side::a, Side::b}) {
            const auto of_side = [side](const ContactResult& result) {
                std::vector<ContactPoint> records;
                std::copy_if(result.points.begin(), result.points.end(),
                             std::back_inserter(records),
                             [side](const ContactPoint& record) { return record.on == side; });
                return records;
            };
            match(
                of_side(exact), of_side(drawn),
                [&](const ContactPoint& i, const ContactPoint& j) {
                    EXPECT_LE(std::abs(i.distance - j.distance), 1e-3 * d);
                    EXPECT_TRUE(i.inside == j.inside || i.distance <= 1e-3 * d)
                        << i.position.x << ", " << i.position.y << " at " << i.distance;
                },
                [&](const ContactPoint& on_the_limit) {
                    EXPECT_GE(on_the_limit.distance, near - 1e-3 * d);
                });
        }
    }

    static void check_closest(const PlacedPair& device, const PlacedPair& cpu) {
        const SeparationResult exact = run_alone(context(), cpu.separation());
        check_separation(cpu, exact);
        check_same(exact, run_alone(context(), cpu.closest_point()));
        EXPECT_EQ(exact.technique, Technique::cpu);
        const SeparationResult drawn = run_alone(context(), device.separation());
        EXPECT_EQ(exact.distance, drawn.distance);
        EXPECT_EQ(exact.intersects, drawn.intersects);
        EXPECT_EQ(exact.unique, drawn.unique);
    }
};

TEST_F(Techniques, AgreeOnRandomPairs) {
    for_each_case(techniques_seed, 60, [&](Random& random) {
        Pair pair = any_pair(random);
        if (random.whole(0, 2) == 0) {  // apart
            pair.pose_b.translation.x += random.scale(0.1, 100.0) * 10.0 * pair.tolerance;
        }
        check(pair);
    });
}

TEST_F(Techniques, AgreeOnEveryFamily) {
    for (const Pair& pair : family_pairs(techniques_seed)) {
        check(pair);
    }
}

TEST_F(Techniques, AgreeOnDegeneratePolygons) {
    constexpr std::uint32_t cells = 40;
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), cells, techniques_seed);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Pair pair{shapes[i], shapes[(i + 5) % shapes.size()], {}, {{1.3, -0.7}, 0.1}, 0.7};
        check(pair);
        check_dense(pair);
    }
}

/// Regular pentagons inside each other: boxes do not tell their edges apart.
Rings nested_pentagons(int rings) {
    Rings all;
    for (int i = 0; i < rings; ++i) {
        all.push_back(scaled_and_moved(regular(5), 1.0 - 0.95 * i / rings, {}).front());
    }
    return all;
}

// So many edges in a tile that it is left to the CPU, and so many boxes around each point that the
// device's walks give up.
TEST_F(Techniques, AgreeOnCrowds) {
    const NamedRings pentagons{"pentagons", nested_pentagons(260)};
    check({pentagons, pentagons, {}, {}, 0.4});
    check({pentagons, pentagons, {{0.3, 0.2}, 0.4}, {{-100.0, 3.0}, 2.0}, 0.4});
    NamedRings specks{"specks", {}};
    Random random(techniques_seed);
    for (int i = 0; i < 400; ++i) {
        specks.rings.push_back(
            scaled_and_moved(regular(4), 0.001,
                             {random.between(-0.1, 0.1), random.between(-0.1, 0.1)})
                .front());
    }
    check({pentagons, specks, {}, {}, 0.4});
}

TEST_F(Techniques, AgreeOnSpikes) {
    NamedRings spikes{"spikes", {{}}};
    for (int i = 0; i < 1200; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 1200;
        const double radius = i % 2 == 0 ? 0.3 : 1.0;
        spikes.rings.front().push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    check({spikes, spikes, {}, {{0.3, 0.2}, 0.0}, 0.1});
}

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

TEST_F(Techniques, AgreeOnOutlines) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    ASSERT_GE(outlines.size(), 2U);
    const Pair pair{outlines[0], outlines[1], {}, {{60.0, 30.0}, 0.4}, 2.0};
    check(pair);
    check_dense(pair);
}

TEST_F(Techniques, AgreeAroundTheSizeFromWhichThereIsATree) {
    Random random(techniques_seed);
    for (const int n : {3, 63, 64, 65, 130}) {
        SCOPED_TRACE(n);
        const Rings a = star(random, n, 0.5);
        const Rings b = star(random, n, 0.6);
        check({{"A", a}, {"B", b}, {}, {{0.9, 0.4}, 0.3}, 0.02});
        check({{"A", scaled_and_moved(a, 0.1, {0.1, 0.1})}, {"B", b}, {}, {}, 0.02});
        check({{"A", a}, {"B", scaled_and_moved(b, 0.1, {0.1, 0.1})}, {}, {}, 0.02});
        check({{"A", a}, {"B", a}, {}, {}, 0.02});
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

/// Normals from the gradient of B's field, with the field by each technique.
TEST_F(Techniques, AgreeOnNormalsByGradient) {
    Random random(techniques_seed);
    const Pair pair{
        {"A", star(random, 20, 0.4)}, {"B", star(random, 25, 0.3)}, {}, {{1.2, 0.3}, 0.2}, 0.02};
    const PlacedPair raster(context(), pair, Technique::raster);
    const PlacedPair cpu(context(), pair, Technique::cpu);
    ContactQuery query = raster.contacts(0.03);
    query.normals = ContactNormals::gradient;
    const ContactResult drawn = run_alone(context(), query);
    query = cpu.contacts(0.03);
    query.normals = ContactNormals::gradient;
    const ContactResult exact = run_alone(context(), query);
    EXPECT_EQ(exact.technique, Technique::cpu);
    ASSERT_TRUE(exact.status.ok()) << exact.status.text();
    ASSERT_GT(exact.points.size(), 10U);
    int compared = 0;
    match(
        exact.points, drawn.points,
        [&](const ContactPoint& i, const ContactPoint& j) {
            // Only where the differences are meaningful: each component has an error of up to 0.31
            // of a cell's side on the device (docs/error_budget.md), and almost none on the CPU.
            EXPECT_GT(oracle::dot(i.normal, j.normal), 0.5);
            ++compared;
        },
        [](const ContactPoint&) {});
    EXPECT_GT(compared, 10);
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
