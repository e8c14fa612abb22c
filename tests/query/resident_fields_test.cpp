#include <tests/query/resident_test.hpp>

#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t field_seed = 8100;

TEST_F(Resident, FieldImagesHoldWhatComesBack) {
    for_each_case(field_seed, 6, [&](Random& random) {
        for (const Technique technique : on_device) {
            const PlacedPair pair(context(), any_pair(random), technique);
            SCOPED_TRACE(describe(pair.pair()));
            ResidentField field;
            FieldContents contents;
            const DistanceFieldResult result =
                ask(context(), field_of(pair, technique), [&](const ResidentField& resident) {
                    field = resident;
                    contents = contents_of(resident);
                });
            EXPECT_EQ(result.technique, technique);
            check_field(pair, field, contents, result);
        }
    });
}

TEST_F(Resident, FieldsOfEveryFamilyAndOfSeveralTilesWithHalos) {
    int number = 0;
    for (const Pair& made : family_pairs(field_seed)) {
        const Technique technique = on_device[static_cast<std::size_t>(number++ % 2)];
        const PlacedPair pair(context(), made, technique);
        SCOPED_TRACE(describe(made));
        DistanceFieldQuery query = field_of(pair, technique);
        const std::vector<Vector2> points{query.rectangle->min};
        if (number % 3 == 0) {
            query.points = points;  // halos
            query.gradient = GradientMethod::central_differences;
            query.gradients = true;
        }
        ResidentField field;
        FieldContents contents;
        const DistanceFieldResult result =
            ask(context(), query, [&](const ResidentField& resident) {
                field = resident;
                contents = contents_of(resident);
            });
        check_field(pair, field, contents, result);
    }
}

TEST_F(Resident, FieldOfManyRoundsOfWhichNothingComesBack) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;  // small atlas images
    Expected<Context> made = Context::create(host_device(), drawing(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(field_seed);
    for (const Technique technique : on_device) {
        Pair shapes{
            {"coast", coast(random, 200, 0.4)}, {"holes", with_holes(random, 3)}, {}, {}, 0.003};
        const PlacedPair pair(*made, shapes, technique);
        DistanceFieldQuery query = field_of(pair, technique);
        query.rectangle = Rectangle{{-1.2, -1.2}, {1.2, 0.4}};
        const DistanceFieldResult expected = run_alone(*made, query);
        query.values = query.features = false;
        ResidentField field;
        FieldContents contents;
        const DistanceFieldResult result = ask(*made, query, [&](const ResidentField& resident) {
            field = resident;
            contents = contents_of(resident);
        });
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_TRUE(result.values.empty() && result.features.empty() && result.unique.empty());
        EXPECT_GT(std::size_t{field.width} * field.height, 512U * 256U);
        check_field(pair, field, contents, expected);
    }
}

}  // namespace
}  // namespace nearfield::test
