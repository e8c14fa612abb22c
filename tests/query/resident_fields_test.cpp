#include <tests/query/resident_test.hpp>

#include <cmath>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t resident_field_seed = 8100;

TEST_F(Resident, FieldImagesHoldWhatComesBack) {
    for_each_case(resident_field_seed, 6, [&](Random& random) {
        const PlacedPair pair(context(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        const auto kept = keep(context(), field_of(pair, Technique::compute));
        EXPECT_EQ(kept.result.technique, Technique::compute);
        check_field(pair, kept);
    });
}

TEST_F(Resident, FieldsOfEveryFamilyAndOfSeveralTilesWithHalos) {
    int number = 0;
    for (const Pair& made : family_pairs(resident_field_seed)) {
        const PlacedPair pair(context(), made, Technique::compute);
        SCOPED_TRACE(describe(made));
        DistanceFieldQuery query = field_of(pair, Technique::compute);
        const std::vector<Vector2> points{query.rectangle->min};
        if (number++ % 3 == 1) {
            query.points = points;  // halos
            query.gradient = GradientMethod::central_differences;
            query.gradients = true;
        }
        check_field(pair, keep(context(), query));
    }
}

// Alternately with features, in the same context: images that are there stay as they are.
TEST_F(Resident, FieldOfDistancesAlone) {
    for_each_case(resident_field_seed, 4, [&](Random& random) {
        const PlacedPair pair(context(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        DistanceFieldQuery query = field_of(pair, Technique::compute);
        query.features = false;
        const auto both = keep(context(), query);
        EXPECT_NE(both.output.feature.image, VkImage{VK_NULL_HANDLE});
        const std::vector<float>& with_features = both.contents.values;
        query.features_on_device = false;
        for (const bool returns_features : {false, true}) {
            query.features = returns_features;
            const auto [field, contents, result] = keep(context(), query);
            EXPECT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_EQ(field.feature.image, VkImage{VK_NULL_HANDLE});
            EXPECT_EQ(field.feature.view, VkImageView{VK_NULL_HANDLE});
            EXPECT_GE(field.image_extent.width, result.width);
            EXPECT_EQ(result.features.size(), returns_features ? result.values.size() : 0);
            EXPECT_EQ(contents.values, result.values);
            ASSERT_EQ(contents.values.size(), with_features.size());
            for (std::size_t i = 0; i < with_features.size(); ++i) {
                // Without features the distances are found in another way.
                const double apart =
                    std::abs(std::abs(contents.values[i]) - std::abs(with_features[i]));
                EXPECT_LE(apart, returns_features ? 0.0 : 2.0 * result.error_bound) << i;
            }
        }
    });
}

TEST_F(Resident, FieldOfManyRoundsOfWhichNothingComesBack) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;  // small atlas images
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(resident_field_seed);
    Pair shapes{
        {"coast", coast(random, 200, 0.4)}, {"holes", with_holes(random, 3)}, {}, {}, 0.003};
    const PlacedPair pair(*made, shapes, Technique::compute);
    DistanceFieldQuery query = field_of(pair, Technique::compute);
    query.rectangle = Rectangle{{-1.2, -1.2}, {1.2, 0.4}};
    const DistanceFieldResult expected = run_alone(*made, query);
    query.values = query.features = false;
    auto kept = keep(*made, query);
    EXPECT_TRUE(kept.result.status.ok()) << kept.result.status.text();
    EXPECT_TRUE(kept.result.values.empty() && kept.result.features.empty() &&
                kept.result.unique.empty());
    EXPECT_GT(std::size_t{kept.output.width} * kept.output.height, 512U * 256U);
    kept.result = expected;
    check_field(pair, kept);
}

}  // namespace
}  // namespace nearfield::test
