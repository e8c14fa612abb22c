#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <vector>

// Lengths so small that their products are close to zero.

namespace nearfield::test {
namespace {

constexpr std::uint64_t smallest_shapes_seed = 9100;

/// Scales shapes of size about 2 to slightly above `smallest_extent`; a power of two, so that
/// nothing is rounded.
constexpr int scale = -66;

double scaled(double length) {
    return std::ldexp(length, scale);
}

Vector2 scaled(const Vector2& v) {
    return {scaled(v.x), scaled(v.y)};
}

Rings scaled(Rings rings) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = scaled(vertex);
        }
    }
    return rings;
}

/// The same queries in units that make all lengths small; `points` keeps the fields' points alive.
Batch scaled(const Batch& batch, ShapeHandle a, ShapeHandle b, ShapeHandle small_a,
             ShapeHandle small_b, std::vector<std::vector<Vector2>>& points) {
    const auto small = [&](Instance& instance) {
        if (!(instance.shape == ShapeHandle{})) {
            instance.shape = instance.shape == a ? small_a : small_b;
        }
        EXPECT_FALSE(instance.shape == a || instance.shape == b);
        instance.pose.translation = scaled(instance.pose.translation);
    };
    Batch result;
    for (const AnyQuery& any : batch.queries()) {
        std::visit(
            [&](auto query) {
                small(query.a);
                small(query.b);
                if constexpr (requires { query.tolerance; }) {
                    query.tolerance = scaled(query.tolerance);
                }
                if constexpr (requires { query.contact_distance; }) {
                    query.contact_distance = scaled(query.contact_distance);
                }
                if constexpr (requires { query.end_a; }) {
                    query.end_a.translation = scaled(query.end_a.translation);
                    query.end_b.translation = scaled(query.end_b.translation);
                }
                if constexpr (requires { query.rectangle; }) {
                    query.rectangle = {scaled(query.rectangle->min), scaled(query.rectangle->max)};
                    std::vector<Vector2>& own = points.emplace_back();
                    for (const Vector2& point : query.points) {
                        own.push_back(scaled(point));
                    }
                    query.points = own;
                }
                result.add(query);
            },
            any);
    }
    return result;
}

class SmallestShapes : public QueryTest {};

/// Every number of every result by every technique is the same, or the same length or area in other
/// units, bit for bit.
TEST_F(SmallestShapes, AreAnsweredAsLargerOnes) {
    Random random(smallest_shapes_seed);
    const Rings rings_a = coast(random, 100, 0.5);
    const Rings rings_b = with_holes(random, 3);
    const Expected<ShapeHandle> a = context().add_shape(rings_a);
    const Expected<ShapeHandle> b = context().add_shape(rings_b);
    const Expected<ShapeHandle> small_a = context().add_shape(scaled(rings_a));
    const Expected<ShapeHandle> small_b = context().add_shape(scaled(rings_b));
    ASSERT_TRUE(a.has_value() && b.has_value()) << "as they are";
    ASSERT_TRUE(small_a.has_value() && small_b.has_value()) << small_a.error().text();
    const Batch batch = every_query(*a, *b, 1);
    std::vector<std::vector<Vector2>> points;
    points.reserve(batch.queries().size());
    const Batch small_batch = scaled(batch, *a, *b, *small_a, *small_b, points);
    Results large;
    Results small;
    ASSERT_TRUE(context().run(batch, large).ok());
    ASSERT_TRUE(context().run(small_batch, small).ok());
    ASSERT_EQ(large.results.size(), small.results.size());
    for (std::size_t query = 0; query < large.results.size(); ++query) {
        SCOPED_TRACE(::testing::Message()
                     << "seed " << smallest_shapes_seed << ", query " << query);
        Results one;
        Results other;
        one.results.push_back(large.results[query]);
        other.results.push_back(small.results[query]);
        const std::vector<double> numbers = all_numbers(one);
        const std::vector<double> small_numbers = all_numbers(other);
        ASSERT_EQ(numbers.size(), small_numbers.size());
        ASSERT_GT(numbers.size(), 0U);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const double number = small_numbers[i];
            const bool same = number == numbers[i] || number == std::ldexp(numbers[i], scale) ||
                              number == std::ldexp(numbers[i], 2 * scale);
            ASSERT_TRUE(same) << "number " << i << " is " << number << " for " << numbers[i];
        }
    }
    for (const auto& shape : {*a, *b, *small_a, *small_b}) {
        EXPECT_TRUE(context().remove_shape(shape).ok());
    }
}

}  // namespace
}  // namespace nearfield::test
