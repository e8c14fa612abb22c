#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

/// Batches with different kinds of resident outputs, each larger than the one before, so that
/// buffers and images are replaced while descriptor sets change from one kind to another.
TEST(DescriptorSets, NameNothingThatIsGone) {
    const test_support::MockDriver driver;
    Settings settings;
    settings.batches_in_flight = 1;
    Expected<Context> context = Context::create(driver.host(), settings);
    ASSERT_TRUE(context.has_value()) << context.error().text();
    const std::vector<Ring> square{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}};
    const Expected<ShapeHandle> shape = context->add_shape(square);
    ASSERT_TRUE(shape.has_value());
    const Instance a{*shape, {}};
    const Instance b{*shape, {{1.0, 1.0}, 0.0}};
    Results results;
    for (int i = 0; i < 24; ++i) {
        const double tolerance = 0.2 / (1.0 + i);
        Batch batch;
        if (i % 2 == 1) {
            DistanceFieldQuery field{{}, b, tolerance};
            field.rectangle = Rectangle{{-1.0, -1.0}, {3.0, 3.0}};
            field.technique = Technique::compute;
            field.on_device = true;
            batch.add(field);
        }
        if (i % 3 != 1) {
            PenetrationQuery penetration{a, b, 0.1 * tolerance};
            penetration.technique = Technique::compute;
            penetration.on_device = true;
            batch.add(penetration);
        }
        if (i % 4 == 2) {
            IntersectionQuery overlap{a, b, tolerance};
            overlap.technique = Technique::compute;
            overlap.on_device = overlap.samples_on_device = true;
            batch.add(overlap);
        }
        const Status status = context->run(batch, results);
        ASSERT_TRUE(status.ok()) << status.text();
        for (const AnyResult& result : results.results) {
            const Status& own =
                std::visit([](const auto& one) -> const Status& { return one.status; }, result);
            EXPECT_TRUE(own.ok()) << own.text();
        }
    }
    EXPECT_EQ(driver.breaches(), std::vector<std::string>());
}

}  // namespace
}  // namespace nearfield::test
