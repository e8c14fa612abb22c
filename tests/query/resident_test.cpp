#include <tests/query/resident_test.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nearfield::test {

double distance_between(const Vector2& a, const Vector2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

bool same_place(const oracle::ShapeOracle& shape, const Feature& a, const Feature& b,
                const Vector2& point, double allowed) {
    const auto place = [&](const Feature& feature) {
        return feature.kind == Feature::Kind::vertex
                   ? shape.vertex(feature.index)
                   : shape.nearest_on_edge(feature.index, point).point;
    };
    return distance_between(place(a), place(b)) <= allowed;
}

void check_field(const PlacedPair& pair, const Kept<DistanceFieldQuery>& kept) {
    const auto& [field, contents, result] = kept;
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    ASSERT_EQ(field.width, result.width);
    ASSERT_EQ(field.height, result.height);
    EXPECT_EQ(field.origin, result.origin);
    EXPECT_EQ(field.cell, result.cell);
    EXPECT_GE(field.error_bound, result.error_bound);
    EXPECT_LE(field.error_bound, result.tolerance);
    int otherwise = 0;
    for (std::size_t i = 0; i < contents.values.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(contents.values[i]),
                  std::bit_cast<std::uint32_t>(result.values[i]))
            << "cell " << i << ": " << contents.values[i] << " or " << result.values[i];
        const FeatureContents& feature = contents.features[i];
        const Vector2 centre{
            field.origin.x + field.cell * (static_cast<double>(i % field.width) + 0.5),
            field.origin.y + field.cell * (static_cast<double>(i / field.width) + 0.5)};
        const bool same = feature.feature.kind == result.features[i].kind &&
                          feature.feature.index == result.features[i].index;
        otherwise += same ? 0 : 1;
        ASSERT_TRUE(same || same_place(pair.b(), feature.feature, result.features[i], centre,
                                       field.cell / 4096.0))
            << "cell " << i << " names feature " << feature.feature.index << " and "
            << result.features[i].index;
        ASSERT_TRUE(feature.unique == (result.unique[i] != 0) ||
                    std::abs(result.values[i]) < field.cell / 1024.0)
            << "cell " << i;
        ASSERT_TRUE(feature.inside == std::signbit(result.values[i]) ||
                    std::abs(result.values[i]) <= result.error_bound)
            << "cell " << i;
    }
    EXPECT_LE(otherwise, 1 + static_cast<int>(contents.values.size() / 20));
}

DistanceFieldQuery field_of(const PlacedPair& pair, Technique technique) {
    DistanceFieldQuery query;
    query.b = pair.instance_b();
    query.tolerance = pair.tolerance();
    query.technique = technique;
    const auto [low, high] = pair.b().box();
    const double cell = std::sqrt(2.0) * query.tolerance;
    // A part of it, so that large shapes stay fast: off the shape's middle, to contain both sides.
    const double width = std::min(high.x - low.x + 20.0 * cell, 150.0 * cell);
    const double height = std::min(high.y - low.y + 20.0 * cell, 90.0 * cell);
    query.rectangle = Rectangle{{low.x - 7.3 * cell, low.y - 7.3 * cell},
                                {low.x - 7.3 * cell + width, low.y - 7.3 * cell + height}};
    query.features = true;
    query.on_device = true;
    return query;
}

}  // namespace nearfield::test
