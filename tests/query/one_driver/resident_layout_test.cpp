#include <tests/query/all_numbers.hpp>
#include <tests/query/resident_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t resident_layout_seed = 8700;

/// A shape that may turn, in a context of its own, and one query of each kind of resident output.
class ResidentLayout : public Resident {
protected:
    void SetUp() override {
        Resident::SetUp();
        Settings settings;
        settings.batches_in_flight = frames;
        Expected<Context> made = Context::create(host_device(), on_demand(settings));
        ASSERT_TRUE(made.has_value()) << made.error().text();
        made_.emplace(std::move(*made));
        Random random(resident_layout_seed);
        shape_ = *made_->add_shape(coast(random, 120, 0.5));
        other_ = *made_->add_shape(with_holes(random, 3));
    }
    void TearDown() override {
        made_.reset();
        Resident::TearDown();
    }

    struct Asked {
        Batch batch;
        QueryHandle<DistanceFieldQuery> field;
        QueryHandle<PenetrationQuery> depths;
        QueryHandle<ContactQuery> contacts;
        QueryHandle<IntersectionQuery> overlap;
        QueryHandle<IntersectionQuery> counted;
    };
    [[nodiscard]] Asked ask(double angle, double tolerance = 0.03) const {
        Asked asked;
        const Instance a{shape_, {{0.1, 0.0}, angle}};
        const Instance b{other_, {}};
        DistanceFieldQuery field;
        field.technique = Technique::compute;
        field.b = b;
        field.tolerance = tolerance;
        field.rectangle = Rectangle{{-1.5, -1.25}, {1.0, 1.5}};
        field.on_device = true;
        PenetrationQuery depths{a, b, tolerance};
        ContactQuery contacts{a, b, tolerance, 0.05};
        IntersectionQuery overlap{a, b, tolerance};
        depths.technique = contacts.technique = overlap.technique = Technique::compute;
        depths.on_device = contacts.on_device = overlap.on_device = true;
        IntersectionQuery counted = overlap;
        counted.samples_on_device = false;
        asked.field = asked.batch.add(field);
        asked.depths = asked.batch.add(depths);
        asked.contacts = asked.batch.add(contacts);
        asked.overlap = asked.batch.add(overlap);
        asked.counted = asked.batch.add(counted);
        return asked;
    }

    [[nodiscard]] Context& made() { return *made_; }

    static constexpr std::uint32_t frames = 3;
    ShapeHandle shape_;
    ShapeHandle other_;

private:
    std::optional<Context> made_;
};

/// The arguments of a header for this many points.
void expect_arguments(const HeaderData& header, std::uint32_t count) {
    EXPECT_EQ(header.count, count);
    EXPECT_EQ(header.points.vertexCount, count);
    EXPECT_EQ(header.points.instanceCount, 1U);
    EXPECT_EQ(header.quads.vertexCount, 6U);
    EXPECT_EQ(header.quads.instanceCount, count);
    EXPECT_EQ(header.groups.x, (count + 63) / 64);
    EXPECT_EQ(header.groups.y, 1U);
    EXPECT_EQ(header.groups.z, 1U);
    EXPECT_EQ(header.points.firstVertex + header.points.firstInstance + header.quads.firstVertex +
                  header.quads.firstInstance + header.width + header.height,
              0U);
}

template <class Output>
void expect_frame(const HeaderData& header, const Output& output) {
    EXPECT_EQ(header.origin[0], static_cast<float>(output.origin.x));
    EXPECT_EQ(header.origin[1], static_cast<float>(output.origin.y));
}

TEST_F(ResidentLayout, HeadersSayWhatThereIs) {
    for (const double angle : {0.0, 0.4, 1.7}) {
        const Asked asked = ask(angle);
        const Expected<Ticket> ticket = made().submit(asked.batch);
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        const auto field = made().on_device(*ticket, asked.field);
        const auto depths = made().on_device(*ticket, asked.depths);
        const auto contacts = made().on_device(*ticket, asked.contacts);
        const auto overlap = made().on_device(*ticket, asked.overlap);
        const auto counted = made().on_device(*ticket, asked.counted);
        ASSERT_TRUE(field && depths && contacts && overlap && counted);
        const auto header = [&](const auto& output) {
            return reader().read(output.header, depths->state);
        };
        const HeaderData of_depths = header(*depths);
        const HeaderData of_contacts = header(*contacts);
        const HeaderData of_overlap = header(*overlap);
        const HeaderData of_counted = header(*counted);
        const HeaderData of_field = header(*field);
        const std::uint32_t records = contents_of(*depths).summary.count;
        const std::uint32_t near = contents_of(*contacts).summary.count;
        const std::uint32_t samples = contents_of(*overlap).summary.count;
        Results results;
        ASSERT_TRUE(made().collect(*ticket, results).ok());
        ASSERT_GT(records, 10U);
        ASSERT_GT(near, 10U);
        EXPECT_EQ(samples, results[asked.overlap].count);
        ASSERT_GT(samples, 100U);
        expect_arguments(of_depths, records);
        expect_arguments(of_contacts, near);
        expect_arguments(of_overlap, samples);
        expect_frame(of_depths, *depths);
        expect_frame(of_contacts, *contacts);
        expect_frame(of_overlap, *overlap);
        expect_frame(of_field, *field);
        EXPECT_EQ(of_overlap.cell, static_cast<float>(overlap->cell));
        EXPECT_EQ(of_overlap.overflow + of_depths.overflow + of_contacts.overflow, 0U);
        // Counted and not stored.
        expect_arguments(of_counted, 0);
        EXPECT_EQ(of_counted.overflow, 1U);
        // A field: one quad over all cells, and a thread for each.
        EXPECT_EQ(of_field.width, field->width);
        EXPECT_EQ(of_field.height, field->height);
        EXPECT_EQ(of_field.count, field->width * field->height);
        EXPECT_EQ(of_field.points.vertexCount, of_field.count);
        EXPECT_EQ(of_field.quads.vertexCount, 6U);
        EXPECT_EQ(of_field.quads.instanceCount, 1U);
        EXPECT_EQ(of_field.groups.x, (field->width + 7) / 8);
        EXPECT_EQ(of_field.groups.y, (field->height + 7) / 8);
        EXPECT_EQ(of_field.groups.z, 1U);
        EXPECT_EQ(of_field.cell, static_cast<float>(field->cell));
        EXPECT_EQ(of_field.overflow, 0U);
    }
}

/// True if the descriptor sets of one serve the other.
bool same_places(const PointsOnDevice& a, const PointsOnDevice& b) {
    return a.buffer == b.buffer && a.offset == b.offset && a.header.buffer == b.header.buffer &&
           a.header.offset == b.header.offset;
}

bool same_places(const FieldOnDevice& a, const FieldOnDevice& b) {
    return a.signed_distance.view == b.signed_distance.view && a.feature.view == b.feature.view &&
           a.header.buffer == b.header.buffer && a.header.offset == b.header.offset;
}

TEST_F(ResidentLayout, IsKnownBeforeTheFirstFrame) {
    const Asked first = ask(0.0);
    const auto fields = made().layout_on_device(first.batch, first.field);
    const auto depths = made().layout_on_device(first.batch, first.depths);
    const auto contacts = made().layout_on_device(first.batch, first.contacts);
    const auto samples = made().layout_on_device(first.batch, first.overlap);
    ASSERT_TRUE(fields && depths && contacts && samples);
    ASSERT_EQ(fields->size(), frames);
    std::vector<std::vector<double>> numbers;
    std::vector<Ticket> tickets(frames);
    Results results;
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        Ticket& ticket = tickets[frame % frames];
        if (frame >= frames) {
            ASSERT_TRUE(made().collect(ticket, results).ok());
        }
        // The number of points varies with the pose, and the handles stay.
        const Asked asked = ask(0.1 * frame);
        const Expected<Ticket> submitted = made().submit(asked.batch);
        ASSERT_TRUE(submitted.has_value()) << submitted.error().text();
        ticket = *submitted;
        const auto field = made().on_device(ticket, asked.field);
        const auto near = made().on_device(ticket, asked.contacts);
        ASSERT_TRUE(field && near);
        const std::uint32_t slot = field->slot.index;
        ASSERT_LT(slot, frames);
        EXPECT_EQ(near->slot.index, slot);
        EXPECT_EQ(field->slot.revision, (*fields)[slot].slot.revision) << frame;
        EXPECT_TRUE(same_places(*field, (*fields)[slot])) << frame;
        EXPECT_TRUE(same_places(*near, (*contacts)[slot])) << frame;
    }
    for (const Ticket ticket : tickets) {
        ASSERT_TRUE(made().collect(ticket, results).ok());
    }
    // Growth moves what must move, and says so.
    const Asked finer = ask(0.0, 0.01);
    const Expected<Ticket> ticket = made().submit(finer.batch);
    ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
    const auto grown = made().on_device(*ticket, finer.field);
    ASSERT_TRUE(grown.has_value());
    EXPECT_NE(grown->slot.revision, (*fields)[grown->slot.index].slot.revision);
    EXPECT_TRUE(made().collect(*ticket, results).ok());
}

TEST_F(ResidentLayout, RecordsThatMoveSaySo) {
    std::uint64_t revision = 0;
    for (const double tolerance : {0.03, 0.01, 0.003}) {
        PenetrationQuery query{{shape_, {{0.1, 0.0}, 0.4}}, {other_, {}}, tolerance};
        query.technique = Technique::compute;
        query.on_device = true;
        Resident::ask(made(), query, [&](const PointsOnDevice& records) {
            EXPECT_EQ(records.slot.index, 0U);
            // Room for half as much again is not enough for three times as many points.
            EXPECT_NE(records.slot.revision, revision) << tolerance;
            revision = records.slot.revision;
        });
    }
}

/// The greatest distance between two vertices.
double diameter(const Rings& rings) {
    double greatest = 0.0;
    for (const Ring& of_a : rings) {
        for (const Ring& of_b : rings) {
            for (const Vector2& a : of_a) {
                for (const Vector2& b : of_b) {
                    greatest = std::max(greatest, std::hypot(a.x - b.x, a.y - b.y));
                }
            }
        }
    }
    return greatest;
}

/// Queries about a shape at any pose in a fixed one, whose results stay on the device.
struct PosedQueries {
    PosedQueries(ShapeHandle moving, const Pose& pose, const Instance& fixed) {
        PenetrationQuery penetration{{moving, pose}, fixed, 0.02};
        penetration.technique = Technique::compute;
        penetration.on_device = true;
        depths = batch.add(penetration);
        penetration.points = PenetrationPoints::vertices;
        vertices = batch.add(penetration);
        ContactQuery near{{moving, pose}, fixed, 0.02, 3.0};
        IntersectionQuery common{{moving, pose}, fixed, 0.02};
        near.technique = common.technique = Technique::compute;
        near.on_device = common.on_device = true;
        contacts = batch.add(near);
        overlap = batch.add(common);
    }

    template <class Query>
    [[nodiscard]] std::uint64_t size(const Context& context, QueryHandle<Query> query) const {
        const Expected<std::uint64_t> bytes =
            context.target_size(std::get<Query>(batch.queries()[query.index]));
        EXPECT_TRUE(bytes.has_value()) << bytes.error().text();
        return *bytes;
    }

    Batch batch;
    QueryHandle<PenetrationQuery> depths;
    QueryHandle<PenetrationQuery> vertices;
    QueryHandle<ContactQuery> contacts;
    QueryHandle<IntersectionQuery> overlap;
};

TEST_F(ResidentLayout, SizesStayWithinTheBoundOfAllPoses) {
    Random random(resident_layout_seed + 1);
    const Rings rings = coast(random, 200, 0.3);
    const ShapeHandle moving = *made().add_shape(rings);
    const Instance fixed{*made().add_shape(rectangle({-2, -2}, {2, 2})), {}};
    // Known where the shapes are far apart and nothing is found.
    const PosedQueries apart(moving, {{10.0, 0.0}, 0.0}, fixed);
    const auto of_apart = [&](auto query) {
        return made().layout_on_device(apart.batch, query)->front();
    };
    const std::array<PointsOnDevice, 3> bounds{of_apart(apart.depths), of_apart(apart.vertices),
                                               of_apart(apart.contacts)};
    const std::array<std::uint64_t, 3> sizes{apart.size(made(), apart.depths),
                                             apart.size(made(), apart.vertices),
                                             apart.size(made(), apart.contacts)};
    std::array<std::uint32_t, 3> greatest{};
    for (int i = 0; i < 30; ++i) {
        // First wholly inside.
        const Pose pose = i == 0 ? Pose{}
                                 : Pose{{random.between(-3.0, 3.0), random.between(-3.0, 3.0)},
                                        random.between(0.0, 6.0)};
        const PosedQueries asked(moving, pose, fixed);
        const Expected<Ticket> ticket = made().submit(asked.batch);
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        const std::array<PointsOnDevice, 3> records{*made().on_device(*ticket, asked.depths),
                                                    *made().on_device(*ticket, asked.vertices),
                                                    *made().on_device(*ticket, asked.contacts)};
        for (std::size_t kind = 0; kind < records.size(); ++kind) {
            EXPECT_LE(records[kind].size, sizes[kind]) << kind;
        }
        const SamplesOnDevice samples = *made().on_device(*ticket, asked.overlap);
        const double side = diameter(rings) / samples.cell + 1.0;
        EXPECT_LE(samples.capacity, side * side);
        EXPECT_EQ(samples.size, asked.size(made(), asked.overlap));
        EXPECT_EQ(sizes[2], asked.size(made(), asked.contacts));
        Results results;
        ASSERT_TRUE(made().collect(*ticket, results).ok());
        const std::array<std::uint32_t, 3> found{results[asked.depths].count,
                                                 results[asked.vertices].count,
                                                 results[asked.contacts].count};
        for (std::size_t kind = 0; kind < found.size(); ++kind) {
            greatest[kind] = std::max(greatest[kind], found[kind]);
        }
    }
    // No looser than they have to be: samples are counted by the boundary's length along the axes.
    EXPECT_GT(greatest[0], bounds[0].capacity * 6 / 10);
    EXPECT_EQ(greatest[1], bounds[1].capacity);
    EXPECT_GT(greatest[2], bounds[2].capacity * 6 / 10);
}

TEST_F(ResidentLayout, TellsSizesOfWhatIsRefused) {
    const ShapeHandle shape = *made().add_shape(rectangle({-1, -1}, {1, 1}));
    PenetrationQuery depths{{shape, {}}, {shape, {}}, 0.1};
    IntersectionQuery overlap{{shape, {}}, {shape, {}}, 0.1};
    for (const IntersectionKind kind :
         {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume}) {
        overlap.kind = kind;
        EXPECT_GT(*made().target_size(overlap),
                  sizeof(IntersectionSummaryData) + 20 * sizeof(IntersectionSampleData));
    }
    overlap.samples_on_device = false;
    EXPECT_EQ(*made().target_size(overlap), sizeof(IntersectionSummaryData));
    depths.tolerance = overlap.tolerance = -1.0;
    EXPECT_EQ(made().target_size(depths).error().code(), StatusCode::invalid_query);
    EXPECT_EQ(made().target_size(overlap).error().code(), StatusCode::invalid_query);
    depths.tolerance = 0.1;
    depths.a.shape = {};
    EXPECT_EQ(made().target_size(depths).error().code(), StatusCode::unknown_shape);
}

TEST_F(ResidentLayout, IsRefusedByName) {
    const Asked asked = ask(0.0);
    const auto message = [](const auto& expected) { return expected.error().message(); };
    Batch other;
    const auto foreign = other.add(DistanceFieldQuery{});
    EXPECT_EQ(made().layout_on_device(asked.batch, foreign).error().code(),
              StatusCode::invalid_query);
    EXPECT_NE(message(made().layout_on_device(asked.batch, foreign)).find("of another batch"),
              std::string::npos);
    const Expected<Ticket> ticket = made().submit(asked.batch);
    ASSERT_TRUE(ticket.has_value());
    EXPECT_EQ(made().layout_on_device(asked.batch, asked.field).error().code(),
              StatusCode::not_ready);
    EXPECT_NE(message(made().on_device(*ticket, foreign)).find("of another batch"),
              std::string::npos);
    Results results;
    EXPECT_TRUE(made().collect(*ticket, results).ok());
}

TEST_F(ResidentLayout, TrimGivesBackWhatGrowthLeft) {
    const Asked small = ask(0.3);
    const auto answer = [&](const Asked& asked) {
        Results results;
        const Status status = made().run(asked.batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    };
    const std::vector<double> expected = answer(small);
    const std::uint64_t usual = made().memory_use().in_use;
    (void)answer(ask(0.3, 0.004));
    const std::uint64_t spike = made().memory_use().in_use;
    ASSERT_GT(spike, 2 * usual);
    // A batch in flight keeps what it uses.
    const Expected<Ticket> in_flight = made().submit(small.batch);
    ASSERT_TRUE(in_flight.has_value());
    made().trim();
    const auto field = made().on_device(*in_flight, small.field);
    ASSERT_TRUE(field.has_value());
    EXPECT_GT(contents_of(*field).values.size(), 100U);
    Results results;
    ASSERT_TRUE(made().collect(*in_flight, results).ok());
    EXPECT_EQ(all_numbers(results), expected);
    made().trim();
    EXPECT_LT(made().memory_use().in_use, usual / 2);
    EXPECT_EQ(answer(small), expected);
    EXPECT_LE(made().memory_use().in_use, usual + (usual >> 3U));
    EXPECT_EQ(answer(small), expected);
}

TEST_F(ResidentLayout, TimestampsCanBeTurnedOff) {
    Settings settings;
    settings.timestamps = false;
    Expected<Context> untimed = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(untimed.has_value()) << untimed.error().text();
    Random random(resident_layout_seed);
    shape_ = *untimed->add_shape(coast(random, 120, 0.5));
    other_ = *untimed->add_shape(with_holes(random, 3));
    Results results;
    ASSERT_TRUE(untimed->run(ask(0.0).batch, results).ok());
    EXPECT_TRUE(results.timings.passes.empty());
    EXPECT_GT(results.timings.device, 0.0);
}

TEST_F(ResidentLayout, FieldsHaveTheGridThatIsToldBefore) {
    const MemoryUse before = made().memory_use();
    for (const std::optional<Rectangle>& rectangle :
         {std::optional<Rectangle>(), std::optional(Rectangle{{-1.5, -1.25}, {1.0, 1.5}})}) {
        for (const double tolerance : {0.5, 0.03, 0.0101}) {
            DistanceFieldQuery field{{shape_, {{0.2, 0.1}, 0.4}}, {other_, {{0.5, 0.0}, 1.0}}};
            field.tolerance = tolerance;
            field.rectangle = rectangle;
            for (const Technique technique : every_technique) {
                SCOPED_TRACE(to_string(technique));
                field.technique = technique;
                const Expected<FieldGrid> grid = made().field_grid(field);
                ASSERT_TRUE(grid.has_value()) << grid.error().text();
                EXPECT_TRUE(technique != every_technique.front() || tolerance != 0.5 || rectangle ||
                            made().memory_use().in_use == before.in_use);
                const DistanceFieldResult result = run_alone(made(), field);
                ASSERT_TRUE(result.status.ok()) << result.status.text();
                EXPECT_EQ(grid->origin, result.origin);
                EXPECT_EQ(grid->cell, result.cell);
                EXPECT_EQ(grid->width, result.width);
                EXPECT_EQ(grid->height, result.height);
            }
        }
    }
    DistanceFieldQuery bad{{shape_, {}}, {other_, {}}};
    bad.tolerance = -1.0;
    EXPECT_EQ(made().field_grid(bad).error().code(), StatusCode::invalid_query);
    bad.tolerance = 0.1;
    bad.b.shape = {};
    EXPECT_EQ(made().field_grid(bad).error().code(), StatusCode::unknown_shape);
}

}  // namespace
}  // namespace nearfield::test
