#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::test {
namespace {

/// A round shape of many edges that is simplified by far, at every phase another.
Rings wavy(int edges, double phase) {
    Ring ring;
    for (int i = 0; i < edges; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / edges;
        const double radius = 0.8 + 0.15 * std::sin(5.0 * angle + phase);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return {ring};
}

class DeformedShapes : public QueryTest {
protected:
    /// What a context that knows no other shapes says.
    static std::vector<double> of_fresh_shapes(const Rings& rings_a, const Rings& rings_b) {
        Context fresh = *Context::create(host_device(), on_demand());
        const ShapeHandle a = *fresh.add_shape(rings_a);
        const ShapeHandle b = *fresh.add_shape(rings_b);
        return answers(fresh, a, b);
    }
    static std::vector<double> answers(Context& context, ShapeHandle a, ShapeHandle b) {
        Results results;
        Batch batch = every_query(a, b, 1);
        batch.add(distances(b));
        const Status status = context.run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    }
    /// Without features, so that the technique cpu simplifies the shape as well.
    static DistanceFieldQuery distances(ShapeHandle shape) {
        DistanceFieldQuery field;
        field.b = {shape, {}};
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        field.technique = Technique::cpu;
        return field;
    }
};

TEST_F(DeformedShapes, AreAnsweredAsFreshOnesFromBatchToBatch) {
    Context kept = *Context::create(host_device(), on_demand());
    const ShapeHandle a = *kept.add_shape(wavy(200, 0.0));
    const ShapeHandle b = *kept.add_shape(wavy(200, 1.0));
    std::vector<double> last;
    const auto check = [&](int edges, double phase) {
        SCOPED_TRACE(std::to_string(edges) + " edges, phase " + std::to_string(phase));
        const Rings next_a = wavy(edges, phase);
        const Rings next_b = wavy(edges, 1.0 + phase);
        ASSERT_TRUE(kept.update_shape(a, next_a).ok());
        ASSERT_TRUE(kept.update_shape(b, next_b).ok());
        const std::vector<double> found = answers(kept, a, b);
        EXPECT_TRUE(found == of_fresh_shapes(next_a, next_b));
        EXPECT_TRUE(found != last);
        last = found;
    };
    // Tiles see few edges as a whole, many by windows.
    for (const int edges : {200, 600}) {
        // As many vertices as before: nothing but their places tells old from new.
        for (const double phase : {0.0, 0.5, 2.0}) {
            check(edges, phase);
        }
    }
    // They grow and shrink.
    for (const int edges : {5, 3000, 40, 7}) {
        check(edges, 0.3);
    }
}

}  // namespace
}  // namespace nearfield::test
