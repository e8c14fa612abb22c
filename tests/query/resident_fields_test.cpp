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
        FieldOnDevice field;
        FieldContents contents;
        const DistanceFieldResult result =
            ask(context(), field_of(pair, Technique::compute), [&](const FieldOnDevice& resident) {
                field = resident;
                contents = contents_of(resident);
            });
        EXPECT_EQ(result.technique, Technique::compute);
        check_field(pair, field, contents, result);
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
        FieldOnDevice field;
        FieldContents contents;
        const DistanceFieldResult result =
            ask(context(), query, [&](const FieldOnDevice& resident) {
                field = resident;
                contents = contents_of(resident);
            });
        check_field(pair, field, contents, result);
    }
}

// Alternately with features, in the same context: images that are there stay as they are.
TEST_F(Resident, FieldOfDistancesAlone) {
    for_each_case(resident_field_seed, 4, [&](Random& random) {
        const PlacedPair pair(context(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        DistanceFieldQuery query = field_of(pair, Technique::compute);
        query.features = false;
        std::vector<float> with_features;
        ask(context(), query, [&](const FieldOnDevice& resident) {
            EXPECT_NE(resident.feature.image, VkImage{VK_NULL_HANDLE});
            with_features = contents_of(resident).values;
        });
        query.features_on_device = false;
        for (const bool returns_features : {false, true}) {
            query.features = returns_features;
            FieldContents contents;
            VkExtent2D extent{};
            const DistanceFieldResult result =
                ask(context(), query, [&](const FieldOnDevice& resident) {
                    EXPECT_EQ(resident.feature.image, VkImage{VK_NULL_HANDLE});
                    EXPECT_EQ(resident.feature.view, VkImageView{VK_NULL_HANDLE});
                    extent = resident.image_extent;
                    contents = contents_of(resident);
                });
            EXPECT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_GE(extent.width, result.width);
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
    FieldOnDevice field;
    FieldContents contents;
    const DistanceFieldResult result = ask(*made, query, [&](const FieldOnDevice& resident) {
        field = resident;
        contents = contents_of(resident);
    });
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_TRUE(result.values.empty() && result.features.empty() && result.unique.empty());
    EXPECT_GT(std::size_t{field.width} * field.height, 512U * 256U);
    check_field(pair, field, contents, expected);
}

}  // namespace
}  // namespace nearfield::test
