#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/resident_reader.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 8100;
constexpr std::array<Technique, 2> on_device{Technique::raster, Technique::compute};

double distance_between(const Vector2& a, const Vector2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

class Resident : public QueryTest {
protected:
    void SetUp() override {
        QueryTest::SetUp();
        reader_ = std::make_unique<ResidentReader>(host_device());
    }
    void TearDown() override {
        reader_.reset();
        QueryTest::TearDown();
    }

    [[nodiscard]] ResidentReader& reader() { return *reader_; }

    /// Submits a batch of one query and reads what it leaves on the device before it is collected.
    template <class Query, class Read>
    typename ResultOf<Query>::type ask(Context& context, const Query& query, Read&& read) {
        Batch batch;
        const auto handle = batch.add(query);
        Results results;
        const Expected<Ticket> ticket = context.submit(batch);
        EXPECT_TRUE(ticket.ok()) << ticket.status().text();
        if (ticket.ok()) {
            const auto resident = context.resident(*ticket, handle);
            EXPECT_TRUE(resident.ok()) << resident.status().text();
            if (resident.ok()) {
                read(*resident);
            }
            const Status status = context.collect(*ticket, results);
            EXPECT_TRUE(status.ok()) << status.text();
        }
        return results.results.empty() ? typename ResultOf<Query>::type() : results[handle];
    }

    FieldContents contents_of(const ResidentField& field) { return reader().read(field); }
    RecordsContents contents_of(const ResidentRecords& records) { return reader().read(records); }

private:
    std::unique_ptr<ResidentReader> reader_;
};

// ---- fields

/// A feature may be named another way only where both are as near: at a vertex.
bool same_place(const oracle::ShapeOracle& shape, const Feature& a, const Feature& b,
                const Vector2& point, double allowed) {
    const auto place = [&](const Feature& feature) {
        return feature.kind == Feature::Kind::vertex
                   ? shape.vertex(feature.index)
                   : shape.nearest_on_edge(feature.index, point).point;
    };
    return distance_between(place(a), place(b)) <= allowed;
}

void check_field(const PlacedPair& pair, const ResidentField& field, const FieldContents& contents,
                 const DistanceFieldResult& result) {
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
    // Some of it, so that large shapes take no time: off the shape's middle, to have both sides.
    const double width = std::min(high.x - low.x + 20.0 * cell, 150.0 * cell);
    const double height = std::min(high.y - low.y + 20.0 * cell, 90.0 * cell);
    query.rectangle = Rectangle{{low.x - 7.3 * cell, low.y - 7.3 * cell},
                                {low.x - 7.3 * cell + width, low.y - 7.3 * cell + height}};
    query.features = true;
    query.resident = true;
    return query;
}

TEST_F(Resident, FieldImagesHoldWhatComesBack) {
    for_each_case(seed, 6, [&](Random& random) {
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
    for (const Pair& made : family_pairs(seed)) {
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
    ASSERT_TRUE(made.ok()) << made.status().text();
    Random random(seed);
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

// ---- records

struct Comparison {
    double largest_error = 0.0;  ///< in parts of the bound
    std::size_t compared = 0;
    std::size_t alone = 0;  ///< records on one side only
};

/// What a record of either kind says, to compare with the device's.
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

Claim claim_of(const PenetrationRecord& record) {
    return {record.point,   record.nearest, record.direction, record.depth,
            record.feature, true,           record.unique,    Side::a};
}

Claim claim_of(const ContactRecord& record) {
    return {record.point,   record.nearest, record.normal, record.distance,
            record.feature, record.inside,  record.unique, record.on};
}

void check_record(const PlacedPair& pair, const ResidentRecords& resident,
                  const RecordContents& record, const Claim& claim, Comparison& comparison) {
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

/// Both sides have their records in the same order; where one has a record that the other lacks it
/// has to be a close call.
template <class Record, class IsCloseCall>
Comparison compare(const PlacedPair& pair, const ResidentRecords& resident,
                   const RecordsContents& contents, const std::vector<Record>& records,
                   const IsCloseCall& is_close_call) {
    Comparison comparison;
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

void check_summary(const ResidentRecords& resident, const RecordsContents& contents) {
    const SummaryData& summary = contents.summary;
    EXPECT_EQ(summary.capacity, resident.capacity);
    ASSERT_LE(summary.count, summary.capacity);
    ASSERT_EQ(contents.records.size(), summary.count);
    if (summary.count == 0) {
        EXPECT_EQ(summary.deepest, no_record);
        return;
    }
    std::uint32_t deepest = 0;
    Vector2 low = contents.records[0].own_point;
    Vector2 high = low;
    for (std::uint32_t i = 0; i < summary.count; ++i) {
        const RecordContents& record = contents.records[i];
        if (record.depth() > contents.records[deepest].depth()) {
            deepest = i;
        }
        low = {std::min(low.x, record.own_point.x), std::min(low.y, record.own_point.y)};
        high = {std::max(high.x, record.own_point.x), std::max(high.y, record.own_point.y)};
        EXPECT_LT(record.place, summary.capacity);
    }
    EXPECT_EQ(summary.deepest, deepest);
    EXPECT_EQ(static_cast<double>(summary.depth), contents.records[deepest].depth());
    EXPECT_EQ((Vector2{summary.low[0], summary.low[1]}), low);
    EXPECT_EQ((Vector2{summary.high[0], summary.high[1]}), high);
}

TEST_F(Resident, PenetrationRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    double largest = 0.0;
    for_each_case(seed + 100, 12, [&](Random& random) {
        for (const Technique technique : on_device) {
            const PlacedPair pair(context(), any_pair(random), technique);
            SCOPED_TRACE(describe(pair.pair()));
            PenetrationQuery query = pair.penetration();
            query.resident = true;
            ResidentRecords resident;
            RecordsContents contents;
            const PenetrationResult result =
                ask(context(), query, [&](const ResidentRecords& records) {
                    resident = records;
                    contents = contents_of(records);
                });
            check_summary(resident, contents);
            const double touching = std::ldexp(result.cell, -15);
            const Comparison comparison = compare(
                pair, resident, contents, result.records,
                [&](double distance) { return distance <= touching + 2.0 * resident.error_bound; });
            compared += comparison.compared;
            largest = std::max(largest, comparison.largest_error);
        }
    });
    EXPECT_GT(compared, 1000U);
    RecordProperty("largest_error_in_bounds", std::to_string(largest));
    // Of the right size: a bound that is never nearly reached would hide an error.
    EXPECT_GT(largest, 1e-3);
}

TEST_F(Resident, ContactRecordsAreTheCpusWithinTheBound) {
    std::size_t compared = 0;
    std::size_t of_b = 0;
    for_each_case(seed + 200, 14, [&](Random& random) {
        for (const Technique technique : on_device) {
            const PlacedPair pair(context(), any_pair(random), technique);
            SCOPED_TRACE(describe(pair.pair()));
            ContactQuery query = pair.contacts(1.5 * pair.tolerance());
            query.resident = true;
            ResidentRecords resident;
            RecordsContents contents;
            const ContactResult result = ask(context(), query, [&](const ResidentRecords& records) {
                resident = records;
                contents = contents_of(records);
            });
            check_summary(resident, contents);
            const Comparison comparison =
                compare(pair, resident, contents, result.records, [&](double distance) {
                    return std::abs(distance - query.contact_distance) <=
                           2.0 * resident.error_bound;
                });
            compared += comparison.compared;
            of_b += static_cast<std::size_t>(
                std::count_if(result.records.begin(), result.records.end(),
                              [](const ContactRecord& record) { return record.on == Side::b; }));
        }
    });
    EXPECT_GT(compared, 1000U);
    EXPECT_GT(of_b, 100U);
}

TEST_F(Resident, RecordsOfManyRoundsSayWhereTheyBelong) {
    Settings settings;
    settings.memory_limit = std::uint64_t{32} << 20U;  // small atlas images
    Expected<Context> made = Context::create(host_device(), drawing(settings));
    ASSERT_TRUE(made.ok()) << made.status().text();
    Random random(seed);
    const Rings rings = with_holes(random, 3);
    const Pair shapes{{"turned", rings}, {"holes", rings}, {{0.03, 0.02}, 0.12}, {}, 0.0007};
    for (const Technique technique : on_device) {
        const PlacedPair pair(*made, shapes, technique);
        PenetrationQuery query = pair.penetration();
        query.resident = true;
        ResidentRecords resident;
        RecordsContents contents;
        const PenetrationResult result = ask(*made, query, [&](const ResidentRecords& records) {
            resident = records;
            contents = contents_of(records);
        });
        check_summary(resident, contents);
        const auto by_place = [](const RecordContents& i, const RecordContents& j) {
            return i.place < j.place;
        };
        // One round after the other: not in order, so there were several.
        EXPECT_FALSE(std::is_sorted(contents.records.begin(), contents.records.end(), by_place));
        std::sort(contents.records.begin(), contents.records.end(), by_place);
        const Comparison comparison =
            compare(pair, resident, contents, result.records, [&](double distance) {
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
    for (const Technique technique : on_device) {
        const PlacedPair pair(context(), apart, technique);
        PenetrationQuery query = pair.penetration();
        query.resident = true;
        RecordsContents contents;
        contents.summary.count = 7;
        ask(context(), query,
            [&](const ResidentRecords& records) { contents = contents_of(records); });
        EXPECT_EQ(contents.summary.count, 0U);
        EXPECT_EQ(contents.summary.capacity, 0U);
        EXPECT_EQ(contents.summary.deepest, no_record);
    }
}

// ---- frames, refusals

TEST_F(Resident, AFrameKeepsItsImagesWhileTheNextIsSubmitted) {
    Random random(seed);
    const Pair shapes{
        {"coast", coast(random, 120, 0.5)}, {"holes", with_holes(random, 3)}, {}, {}, 0.03};
    Settings settings;
    settings.frames_in_flight = 2;
    Expected<Context> made = Context::create(host_device(), drawing(settings));
    ASSERT_TRUE(made.ok()) << made.status().text();
    const PlacedPair pair(*made, shapes, Technique::raster);
    struct Frame {
        Ticket ticket;
        QueryHandle<DistanceFieldQuery> field;
        QueryHandle<PenetrationQuery> depths;
    };
    const auto submit = [&](int number) {
        Batch batch;
        DistanceFieldQuery field = field_of(pair, on_device[static_cast<std::size_t>(number % 2)]);
        field.b.pose.translation.x = 0.01 * number;
        PenetrationQuery depths = pair.penetration();
        depths.b.pose.translation.x = 0.01 * number;
        depths.resident = true;
        Frame frame;
        frame.field = batch.add(field);
        frame.depths = batch.add(depths);
        const Expected<Ticket> ticket = made->submit(batch);
        EXPECT_TRUE(ticket.ok()) << ticket.status().text();
        frame.ticket = ticket.ok() ? *ticket : Ticket{};
        return frame;
    };
    Frame former = submit(0);
    for (int number = 1; number < 8; ++number) {
        const Frame next = submit(number);
        const Expected<ResidentField> field = made->resident(former.ticket, former.field);
        const Expected<ResidentRecords> records = made->resident(former.ticket, former.depths);
        ASSERT_TRUE(field.ok() && records.ok());
        const FieldContents contents = contents_of(*field);
        const RecordsContents depths = contents_of(*records);
        Results results;
        ASSERT_TRUE(made->collect(former.ticket, results).ok());
        check_field(pair, *field, contents, results[former.field]);
        ASSERT_GT(depths.records.size(), 10U);
        EXPECT_EQ(depths.records.size(), results[former.depths].records.size());
        former = next;
    }
    Results results;
    ASSERT_TRUE(made->collect(former.ticket, results).ok());
}

TEST_F(Resident, ImagesOnlyGrow) {
    Random random(seed);
    const Pair shapes{
        {"coast", coast(random, 120, 0.5)}, {"holes", with_holes(random, 3)}, {}, {}, 0.03};
    Settings settings;
    settings.frames_in_flight = 1;
    Expected<Context> made = Context::create(host_device(), drawing(settings));
    ASSERT_TRUE(made.ok()) << made.status().text();
    const PlacedPair pair(*made, shapes, Technique::raster);
    DistanceFieldQuery query = field_of(pair, Technique::raster);
    VkImage former = VK_NULL_HANDLE;
    for (const double width : {1.0, 0.5, 1.0, 1.5}) {
        query.rectangle = Rectangle{{-0.5, -0.5}, {-0.5 + width, 0.5}};
        ResidentField field;
        FieldContents contents;
        const DistanceFieldResult result = ask(*made, query, [&](const ResidentField& resident) {
            field = resident;
            contents = contents_of(resident);
        });
        check_field(pair, field, contents, result);
        EXPECT_GE(field.image_extent.width, field.width);
        if (former != VK_NULL_HANDLE && width <= 1.0) {
            EXPECT_EQ(field.signed_distance.image, former);
        }
        former = field.signed_distance.image;
    }
}

TEST_F(Resident, RefusesByName) {
    const ShapeHandle shape = context().add_shape(regular(5)).value();
    const Instance here{shape, {}};
    PenetrationQuery depths{here, here, 0.1};
    PenetrationQuery by_cpu = depths;
    by_cpu.technique = Technique::cpu;
    by_cpu.resident = true;
    ContactQuery gradients{here, here, 0.1, 0.1, ContactNormals::gradient};
    gradients.resident = true;
    DistanceFieldQuery field;
    field.b = here;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{0.0, 0.0}, {1.0, 1.0}};
    field.resident = true;
    DistanceFieldQuery huge = field;
    huge.rectangle = Rectangle{{0.0, 0.0}, {40000.0, 1.0}};
    huge.tolerance = 0.5;
    DistanceFieldQuery far = field;
    far.rectangle = Rectangle{{300000.0, 0.0}, {300001.0, 1.0}};

    Batch batch;
    const auto not_resident = batch.add(depths);
    const auto of_cpu = batch.add(by_cpu);
    const auto of_gradients = batch.add(gradients);
    const auto of_huge = batch.add(huge);
    const auto of_far = batch.add(far);
    const auto good = batch.add(field);
    const Expected<Ticket> ticket = context().submit(batch);
    ASSERT_TRUE(ticket.ok()) << ticket.status().text();
    const auto expect = [](const auto& answer, StatusCode code, const char* words) {
        EXPECT_FALSE(answer.ok());
        EXPECT_EQ(answer.status().code(), code) << answer.status().text();
        EXPECT_NE(answer.status().message().find(words), std::string::npos)
            << answer.status().text();
    };
    EXPECT_TRUE(context().resident(*ticket, good).ok());
    expect(context().resident(*ticket, not_resident), StatusCode::invalid_query, "did not ask");
    expect(context().resident(*ticket, of_cpu), StatusCode::invalid_query, "technique cpu");
    expect(context().resident(*ticket, of_gradients), StatusCode::invalid_query, "analytic");
    expect(context().resident(*ticket, of_huge), StatusCode::too_large, "an image of this device");
    expect(context().resident(*ticket, of_far), StatusCode::invalid_query, "single precision");
    expect(context().resident(*ticket, QueryHandle<PenetrationQuery>{99}),
           StatusCode::invalid_query, "none of the batch");
    expect(context().resident(*ticket, QueryHandle<PenetrationQuery>{good.index}),
           StatusCode::invalid_query, "another kind");
    expect(context().resident(Ticket{}, good), StatusCode::unknown_ticket, "ticket");
    Results results;
    ASSERT_TRUE(context().collect(*ticket, results).ok());
    EXPECT_EQ(results[of_cpu].status.code(), StatusCode::invalid_query);
    expect(context().resident(*ticket, good), StatusCode::unknown_ticket, "ticket");
    EXPECT_TRUE(context().remove_shape(shape).ok());
}

TEST_F(Resident, AutomaticAnswersOnTheDevice) {
    // With costs by which the CPU is always the fastest.
    Settings settings;
    constexpr WorkCost dear{1.0, 1.0, 1.0};
    constexpr TechniqueCost too_dear{1.0, dear, dear, dear, dear, dear};
    settings.costs = CostModel{too_dear, too_dear, {}};
    Expected<Context> made = Context::create(host_device(), settings);
    ASSERT_TRUE(made.ok()) << made.status().text();
    const ShapeHandle shape = made->add_shape(regular(5)).value();
    PenetrationQuery query{{shape, {}}, {shape, {{0.3, 0.0}, 0.1}}, 0.1};
    EXPECT_EQ(run_alone(*made, query).technique, Technique::cpu);
    query.resident = true;
    const PenetrationResult result = run_alone(*made, query);
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_NE(result.technique, Technique::cpu);
}

}  // namespace
}  // namespace nearfield::test
