#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/techniques.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 2300;
constexpr int cases = 6;

/// Every kind of query of two shapes, by each technique.
Batch every_query(const Instance& a, const Instance& b, double tolerance) {
    Batch batch;
    for (const Technique technique : every_technique) {
        batch.add(PenetrationQuery{a, b, tolerance, PenetrationPoints::boundary, false, technique});
        batch.add(PenetrationQuery{a, b, tolerance, PenetrationPoints::vertices, false, technique});
        batch.add(ContactQuery{a, b, tolerance, tolerance, {}, false, technique});
        batch.add(ClosestPointQuery{a, b, tolerance, technique});
        batch.add(SeparationQuery{a, b, tolerance, technique});
        for (const IntersectionKind kind :
             {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
              IntersectionKind::volume_volume}) {
            batch.add(IntersectionQuery{a, b, tolerance, kind, false, IntersectionStrategy::depth,
                                        technique});
        }
        DistanceFieldQuery field{a, b, tolerance};
        field.rectangle = Rectangle{{-1.0, -0.5}, {0.5, 1.0}};
        field.features = field.gradients = true;
        field.technique = technique;
        batch.add(field);
    }
    batch.add(IntersectionTestQuery{a, b});
    batch.add(ContainmentQuery{a, b});
    batch.add(
        TimeOfImpactQuery{{a.shape, {{-9.0, 1.0}, 0.0}}, b, {{9.0, -1.0}, 9.0}, b.pose, tolerance});
    batch.add(SeparationVectorQuery{a, b, tolerance});
    return batch;
}

/// Planning, submission and decoding of whole queries on random shapes on the mock driver, for
/// memory checkers, which real drivers would disturb. Tests with a device check the results.
TEST(RandomQueries, TouchNoMemoryThatIsNotTheirs) {
    const test_support::MockDriver driver;
    {
        Expected<Context> context = Context::create(driver.host());
        ASSERT_TRUE(context.has_value()) << context.error().text();
        for (int i = 0; i < cases; ++i) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " case " + std::to_string(i));
            Random random(seed + static_cast<std::uint64_t>(i));
            const Expected<ShapeHandle> a = context->add_shape(coast(random, 20 + 60 * i, 0.5));
            const Expected<ShapeHandle> b = context->add_shape(with_holes(random, i % 4));
            ASSERT_TRUE(a.has_value() && b.has_value());
            Results results;
            const Status status = context->run(
                every_query({*a, {{0.1 * i, 0.2}, 0.5 * i}}, {*b, {{0.6, 0.1}, 0.0}}, 0.05),
                results);
            EXPECT_TRUE(status.ok()) << status.text();
            EXPECT_TRUE(context->remove_shape(*a).ok() && context->remove_shape(*b).ok());
        }
    }
    EXPECT_EQ(driver.breaches(), std::vector<std::string>{});
    EXPECT_EQ(driver.alive(), std::vector<std::string>{});
}

}  // namespace
}  // namespace nearfield::test
