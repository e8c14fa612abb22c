#include <tests/query/resident_test.hpp>

#include <algorithm>
#include <cmath>
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
    EXPECT_TRUE(record.unique == claim.unique || record.undecided);
    EXPECT_TRUE(record.inside == claim.inside || record.touching);
    EXPECT_EQ(record.feature.kind, Feature::Kind::edge);
    const oracle::ShapeOracle& other = claim.on == Side::a ? pair.b() : pair.a();
    EXPECT_TRUE(record.undecided ||
                same_place(other, record.feature, claim.feature, claim.point, 3.0 * bound));
    if (record.touching || record.undecided) {
        return;
    }
    // Out of the other shape.
    const double sign = claim.inside ? 1.0 : -1.0;
    const Vector2 out{sign * (claim.nearest.x - claim.point.x) / claim.distance,
                      sign * (claim.nearest.y - claim.point.y) / claim.distance};
    if (claim.distance > 4.0 * bound) {
        const double allowed = std::max(std::ldexp(1.0, -14), 2.0 * bound / claim.distance);
        EXPECT_LE(distance_between(record.normal, out), allowed + 1e-6) << "normal";
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
    for (std::uint32_t i = 0; i < summary.count; ++i) {
        const RecordContents& record = contents.records[i];
        if (record.depth() > contents.records[deepest].depth()) {
            deepest = i;
        }
    }
    EXPECT_EQ(summary.deepest, deepest);
    EXPECT_NEAR(static_cast<double>(summary.depth), contents.records[deepest].depth(),
                resident.error_bound);
}

// One vertex penetrates, but the device computes with lengths up to those of both shapes.
TEST_F(Resident, RecordBoundCoversTheExtentOfBothShapes) {
    Pair needle;
    needle.a = {"needle", {{{0.0, 0.0}, {100.0, -1.0}, {100.0, 1.0}}}};
    needle.b = {"square", {{{-1.9, -1.0}, {0.1, -1.0}, {0.1, 1.0}, {-1.9, 1.0}}}};
    needle.tolerance = 0.01;
    const PlacedPair pair(context(), needle, Technique::compute);
    const auto kept = keep(context(), pair.penetration(PenetrationPoints::vertices));
    EXPECT_GE(kept.output.error_bound, std::ldexp(101.0, -18));
    EXPECT_LE(kept.output.error_bound, std::ldexp(110.0, -17));
    EXPECT_EQ(kept.result.count, 1U);
}

TEST_F(Resident, PenetrationRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    double largest = 0.0;
    for_each_case(record_seed + 100, 12, [&](Random& random) {
        const PlacedPair pair(context(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        const auto [resident, contents, result] = keep(context(), pair.penetration());
        check_summary(resident, contents);
        const double touching = std::ldexp(result.cell, -15);
        const RecordComparison comparison = compare_records(
            pair, resident, contents, result.points,
            [&](double distance) { return distance <= touching + 2.0 * resident.error_bound; });
        compared += comparison.compared;
        largest = std::max(largest, comparison.largest_error);
    });
    EXPECT_GT(compared, 1000U);
    RecordProperty("largest_error_in_bounds", std::to_string(largest));
    // The bound must be nearly reached: a much larger one would hide an error.
    EXPECT_GT(largest, 1e-3);
}

TEST_F(Resident, ContactRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    std::size_t of_b = 0;
    for_each_case(record_seed + 200, 28, [&](Random& random) {
        const PlacedPair pair(context(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        const ContactQuery query = pair.contacts(1.5 * pair.tolerance());
        const auto [resident, contents, result] = keep(context(), query);
        check_summary(resident, contents);
        const RecordComparison comparison =
            compare_records(pair, resident, contents, result.points, [&](double distance) {
                return std::abs(distance - query.contact_distance) <= 2.0 * resident.error_bound;
            });
        compared += comparison.compared;
        of_b += static_cast<std::size_t>(
            std::count_if(result.points.begin(), result.points.end(),
                          [](const ContactPoint& record) { return record.on == Side::b; }));
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
            const PlacedPair pair(context(), {{"A", {corner.a}}, {"B", {corner.b}}, {}, {}, 0.05},
                                  Technique::compute);
            const RecordsContents contents = keep(context(), pair.contacts(0.1)).contents;
            const auto at_corner = std::find_if(
                contents.records.begin(), contents.records.end(), [](const auto& record) {
                    return record.on == Side::a && record.distance < 1e-5 &&
                           std::hypot(record.point.x, record.point.y) < 1e-3;
                });
            ASSERT_NE(at_corner, contents.records.end()) << to_string(Technique::compute);
            EXPECT_LT(std::min(distance_between(at_corner->normal, corner.normals[0]),
                               distance_between(at_corner->normal, corner.normals[1])),
                      1e-3)
                << to_string(Technique::compute) << ", turn " << turn << ": ("
                << at_corner->normal.x << ", " << at_corner->normal.y << ")";
        }
    }
}

/// A square within another one: points all along its boundary penetrate.
PenetrationQuery square_inside(Context& context, double tolerance) {
    const ShapeHandle a = *context.add_shape(rectangle({0, 0}, {1, 1}));
    const ShapeHandle b = *context.add_shape(rectangle({-1, -1}, {2, 2}));
    PenetrationQuery query{{a, {}}, {b, {}}, tolerance};
    query.technique = Technique::compute;
    query.on_device = true;
    return query;
}

TEST_F(Resident, MoreRecordsThanThereIsRoomForAreToldAndTheNextBatchHasRoom) {
    Expected<Context> made = Context::create(host_device(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PenetrationQuery query = square_inside(*made, 1e-4);
    const auto ask_once = [&](HeaderData& header, RecordsContents& contents) {
        Batch batch;
        const auto handle = batch.add(query);
        const Ticket ticket = *made->submit(batch);
        const PointsOnDevice resident = *made->on_device(ticket, handle);
        header = reader().read(resident.header, resident.state);
        contents = contents_of(resident);
        Results results;
        EXPECT_TRUE(made->collect(ticket, results).ok());
        EXPECT_EQ(contents.summary.count, results[handle].points.size());
        EXPECT_EQ(header.count, std::min(contents.summary.count, resident.capacity));
        return results[handle].status;
    };
    HeaderData header;
    RecordsContents contents;
    const Status refused = ask_once(header, contents);
    EXPECT_EQ(refused.code(), StatusCode::overflow);
    EXPECT_NE(refused.message().find("that of the next batch has room"), std::string::npos)
        << refused.message();
    EXPECT_EQ(header.overflow, 1U);
    EXPECT_LT(header.count, contents.summary.count);
    const Status answered = ask_once(header, contents);
    EXPECT_TRUE(answered.ok()) << answered.text();
    EXPECT_EQ(header.overflow, 0U);
    EXPECT_EQ(header.count, contents.summary.count);
}

TEST_F(Resident, WhatTheDeviceCannotSearchIsRefusedByName) {
    const Status status = run_alone(context(), square_inside(context(), 1e-7)).status;
    EXPECT_EQ(status.code(), StatusCode::too_large);
    EXPECT_NE(status.message().find("are to stay on the device"), std::string::npos)
        << status.message();
}

TEST_F(Resident, WhereNothingMeetsTheSummaryIsEmpty) {
    const Pair apart{{"square", rectangle({0.0, 0.0}, {1.0, 1.0})},
                     {"square", rectangle({0.0, 0.0}, {1.0, 1.0})},
                     {},
                     {{5.0, 0.0}, 0.0},
                     0.05};
    const PlacedPair pair(context(), apart, Technique::compute);
    const RecordsContents contents = keep(context(), pair.penetration()).contents;
    EXPECT_EQ(contents.summary.count, 0U);
    EXPECT_EQ(contents.summary.deepest, no_point);
}

}  // namespace
}  // namespace nearfield::test
