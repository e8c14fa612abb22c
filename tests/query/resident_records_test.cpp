#include <tests/query/resident_test.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t record_seed = 8100;

struct RecordComparison {
    double largest_error = 0.0;  ///< as a fraction of the bound
    std::size_t compared = 0;
    std::size_t alone = 0;  ///< records on only one side
};

/// The members of a record of either kind, for comparison with the device's.
struct Claim {
    Vector2 point;
    Vector2 nearest;
    Vector2 normal;
    double distance = 0.0;
    Feature feature;
    bool inside = false;
    bool unique = false;
    Side on = Side::a;
};

Claim claim_of(const PenetratingPoint& record) {
    return {record.position, record.nearest, record.direction, record.depth,
            record.feature,  true,           record.unique,    Side::a};
}

Claim claim_of(const ContactPoint& record) {
    return {record.position, record.nearest, record.normal, record.distance,
            record.feature,  record.inside,  record.unique, record.on};
}

void check_record(const PlacedPair& pair, const PointsOnDevice& resident,
                  const RecordContents& record, const Claim& claim, RecordComparison& comparison) {
    const double bound = resident.error_bound;
    const auto within = [&](double error, const char* what) {
        comparison.largest_error = std::max(comparison.largest_error, error / bound);
        EXPECT_LE(error, bound) << what;
    };
    const auto per_axis = [](const Vector2& a, const Vector2& b) {
        return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    };
    within(per_axis(record.point, claim.point), "point");
    within(per_axis(record.nearest, claim.nearest), "nearest");
    within(std::abs(record.distance - claim.distance), "distance");
    EXPECT_EQ(record.on, claim.on);
    EXPECT_EQ(record.unique, claim.unique);
    EXPECT_TRUE(record.inside == claim.inside || record.touching);
    const bool same =
        record.feature.kind == claim.feature.kind && record.feature.index == claim.feature.index;
    const oracle::ShapeOracle& other = claim.on == Side::a ? pair.b() : pair.a();
    EXPECT_TRUE(same || same_place(other, record.feature, claim.feature, claim.point, 3.0 * bound));
    const bool at_vertex = claim.feature.kind == Feature::Kind::vertex;
    if (record.on == Side::b || (!record.touching && claim.distance > 4.0 * bound)) {
        const double allowed = std::max(std::ldexp(1.0, -14),
                                        record.on == Side::b ? 0.0 : 2.0 * bound / claim.distance);
        EXPECT_LE(distance_between(record.normal, claim.normal), allowed + 1e-6) << "normal";
    } else if (record.touching && !at_vertex && record.unique &&
               record.feature.kind == Feature::Kind::edge) {
        EXPECT_LE(distance_between(record.normal, claim.normal), 0.01) << "normal of a wall";
    }
}

/// Both sides have their records in the same order; a record that one side lacks must be a
/// borderline case.
template <class Record, class IsCloseCall>
RecordComparison compare_records(const PlacedPair& pair, const PointsOnDevice& resident,
                                 const RecordsContents& contents,
                                 const std::vector<Record>& records,
                                 const IsCloseCall& is_close_call) {
    RecordComparison comparison;
    std::size_t i = 0;
    std::size_t j = 0;
    while ((i < records.size() || j < contents.records.size()) &&
           !testing::Test::HasNonfatalFailure()) {
        const bool both = i < records.size() && j < contents.records.size();
        if (both && distance_between(contents.records[j].point, claim_of(records[i]).point) <=
                        1.5 * resident.error_bound) {
            SCOPED_TRACE("record " + std::to_string(j));
            check_record(pair, resident, contents.records[j++], claim_of(records[i++]), comparison);
            ++comparison.compared;
        } else if (i < records.size() && is_close_call(claim_of(records[i]).distance)) {
            ++i;
            ++comparison.alone;
        } else if (j < contents.records.size() && is_close_call(contents.records[j].distance)) {
            ++j;
            ++comparison.alone;
        } else {
            ADD_FAILURE() << "record " << i << " of the CPU and " << j << " of the device differ";
        }
    }
    return comparison;
}

void check_summary(const PointsOnDevice& resident, const RecordsContents& contents) {
    const SummaryData& summary = contents.summary;
    EXPECT_EQ(summary.capacity, resident.capacity);
    ASSERT_LE(summary.count, summary.capacity);
    ASSERT_EQ(contents.records.size(), summary.count);
    if (summary.count == 0) {
        EXPECT_EQ(summary.deepest, no_point);
        return;
    }
    std::uint32_t deepest = 0;
    Vector2 low = contents.records[0].own_point;
    Vector2 high = low;
    std::set<std::uint32_t> places;
    for (std::uint32_t i = 0; i < summary.count; ++i) {
        const RecordContents& record = contents.records[i];
        if (record.depth() > contents.records[deepest].depth()) {
            deepest = i;
        }
        low = {std::min(low.x, record.own_point.x), std::min(low.y, record.own_point.y)};
        high = {std::max(high.x, record.own_point.x), std::max(high.y, record.own_point.y)};
        EXPECT_LT(record.place, summary.capacity);
        EXPECT_TRUE(places.insert(record.place).second) << "place " << record.place << " twice";
    }
    EXPECT_EQ(summary.deepest, deepest);
    EXPECT_EQ(static_cast<double>(summary.depth), contents.records[deepest].depth());
    EXPECT_EQ((Vector2{summary.low[0], summary.low[1]}), low);
    EXPECT_EQ((Vector2{summary.high[0], summary.high[1]}), high);
}

// One vertex penetrates, but the device computes with lengths up to those of both shapes.
TEST_F(Resident, RecordBoundCoversTheExtentOfBothShapes) {
    Pair needle;
    needle.a = {"needle", {{{0.0, 0.0}, {100.0, -1.0}, {100.0, 1.0}}}};
    needle.b = {"square", {{{-1.9, -1.0}, {0.1, -1.0}, {0.1, 1.0}, {-1.9, 1.0}}}};
    needle.tolerance = 0.01;
    for (const Technique technique : device_techniques) {
        const PlacedPair pair(context(), needle, technique);
        PenetrationQuery query = pair.penetration(PenetrationPoints::vertices);
        query.on_device = true;
        const PenetrationResult result = ask(context(), query, [](const PointsOnDevice& resident) {
            EXPECT_GE(resident.error_bound, std::ldexp(101.9, -19));
            EXPECT_LE(resident.error_bound, std::ldexp(110.0, -18));
        });
        EXPECT_EQ(result.count, 1U);
    }
}

TEST_F(Resident, PenetrationRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    double largest = 0.0;
    for_each_case(record_seed + 100, 12, [&](Random& random) {
        for (const Technique technique : device_techniques) {
            const PlacedPair pair(context(), any_pair(random), technique);
            SCOPED_TRACE(describe(pair.pair()));
            PenetrationQuery query = pair.penetration();
            query.on_device = true;
            PointsOnDevice resident;
            RecordsContents contents;
            const PenetrationResult result =
                ask(context(), query, [&](const PointsOnDevice& records) {
                    resident = records;
                    contents = contents_of(records);
                });
            check_summary(resident, contents);
            const double touching = std::ldexp(result.cell, -15);
            const RecordComparison comparison = compare_records(
                pair, resident, contents, result.points,
                [&](double distance) { return distance <= touching + 2.0 * resident.error_bound; });
            compared += comparison.compared;
            largest = std::max(largest, comparison.largest_error);
        }
    });
    EXPECT_GT(compared, 1000U);
    RecordProperty("largest_error_in_bounds", std::to_string(largest));
    // The bound must be nearly reached: a much larger one would hide an error.
    EXPECT_GT(largest, 1e-3);
}

TEST_F(Resident, ContactRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    std::size_t of_b = 0;
    for_each_case(record_seed + 200, 14, [&](Random& random) {
        for (const Technique technique : device_techniques) {
            const PlacedPair pair(context(), any_pair(random), technique);
            SCOPED_TRACE(describe(pair.pair()));
            ContactQuery query = pair.contacts(1.5 * pair.tolerance());
            query.on_device = true;
            PointsOnDevice resident;
            RecordsContents contents;
            const ContactResult result = ask(context(), query, [&](const PointsOnDevice& records) {
                resident = records;
                contents = contents_of(records);
            });
            check_summary(resident, contents);
            const RecordComparison comparison =
                compare_records(pair, resident, contents, result.points, [&](double distance) {
                    return std::abs(distance - query.contact_distance) <=
                           2.0 * resident.error_bound;
                });
            compared += comparison.compared;
            of_b += static_cast<std::size_t>(
                std::count_if(result.points.begin(), result.points.end(),
                              [](const ContactPoint& record) { return record.on == Side::b; }));
        }
    });
    EXPECT_GT(compared, 1000U);
    EXPECT_GT(of_b, 100U);
}

/// The normal of a contact that touches a corner is that of one of its edges, whichever way round.
TEST_F(Resident, NormalsAtCornersPointOut) {
    struct Corner {
        Ring a;
        Ring b;
        Vector2 normals[2];
    };
    const Vector2 lower{-1.0 / std::sqrt(5.0), -2.0 / std::sqrt(5.0)};
    const Corner corners[] = {
        {{{-2, -2}, {0, -2}, {0, 0}, {-2, 0}},
         {{0, 0}, {3, 0}, {3, 3}, {0, 3}},
         {{0, -1}, {-1, 0}}},
        {{{-2, -1}, {0, 0}, {-2, 1}}, {{0, 0}, {2, -1}, {2, 1}}, {lower, {lower.x, -lower.y}}}};
    for (Corner corner : corners) {
        for (int turn = 0; turn < 2; ++turn) {
            std::reverse(corner.b.begin(), corner.b.end());
            for (const Technique technique : device_techniques) {
                const PlacedPair pair(
                    context(), {{"A", {corner.a}}, {"B", {corner.b}}, {}, {}, 0.05}, technique);
                ContactQuery query = pair.contacts(0.1);
                query.on_device = true;
                RecordsContents contents;
                ask(context(), query,
                    [&](const PointsOnDevice& records) { contents = contents_of(records); });
                const auto at_corner = std::find_if(
                    contents.records.begin(), contents.records.end(), [](const auto& record) {
                        return record.on == Side::a && record.distance < 1e-5 &&
                               std::hypot(record.point.x, record.point.y) < 1e-3;
                    });
                ASSERT_NE(at_corner, contents.records.end()) << to_string(technique);
                EXPECT_LT(std::min(distance_between(at_corner->normal, corner.normals[0]),
                                   distance_between(at_corner->normal, corner.normals[1])),
                          1e-3)
                    << to_string(technique) << ", turn " << turn << ": (" << at_corner->normal.x
                    << ", " << at_corner->normal.y << ")";
            }
        }
    }
}

TEST_F(Resident, RecordsOfManyRoundsSayWhereTheyBelong) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;  // small atlas images
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(record_seed);
    const Rings rings = with_holes(random, 3);
    const Pair shapes{{"turned", rings}, {"holes", rings}, {{0.03, 0.02}, 0.12}, {}, 0.0007};
    for (const Technique technique : device_techniques) {
        const PlacedPair pair(*made, shapes, technique);
        PenetrationQuery query = pair.penetration();
        query.on_device = true;
        PointsOnDevice resident;
        RecordsContents contents;
        const PenetrationResult result = ask(*made, query, [&](const PointsOnDevice& records) {
            resident = records;
            contents = contents_of(records);
        });
        check_summary(resident, contents);
        const auto by_place = [](const RecordContents& i, const RecordContents& j) {
            return i.place < j.place;
        };
        // One tile batch after the other: records are out of order, so there were several.
        EXPECT_FALSE(std::is_sorted(contents.records.begin(), contents.records.end(), by_place));
        std::sort(contents.records.begin(), contents.records.end(), by_place);
        const RecordComparison comparison =
            compare_records(pair, resident, contents, result.points, [&](double distance) {
                return distance <= std::ldexp(result.cell, -15) + 2.0 * resident.error_bound;
            });
        EXPECT_GT(comparison.compared, 500U);
    }
}

TEST_F(Resident, WhereNothingMeetsTheSummaryIsEmpty) {
    const Pair apart{{"square", rectangle({0.0, 0.0}, {1.0, 1.0})},
                     {"square", rectangle({0.0, 0.0}, {1.0, 1.0})},
                     {},
                     {{5.0, 0.0}, 0.0},
                     0.05};
    for (const Technique technique : device_techniques) {
        const PlacedPair pair(context(), apart, technique);
        PenetrationQuery query = pair.penetration();
        query.on_device = true;
        RecordsContents contents;
        contents.summary.count = 7;
        ask(context(), query,
            [&](const PointsOnDevice& records) { contents = contents_of(records); });
        EXPECT_EQ(contents.summary.count, 0U);
        EXPECT_EQ(contents.summary.capacity, 0U);
        EXPECT_EQ(contents.summary.deepest, no_point);
    }
}

}  // namespace
}  // namespace nearfield::test
