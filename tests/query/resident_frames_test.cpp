#include <tests/query/all_numbers.hpp>
#include <tests/query/resident_test.hpp>

#include <utility>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t frame_seed = 8100;

/// By compute, only points with resident records are localised; regions and effort show it.
Results without_regions(Results results) {
    for (AnyResult& any : results.results) {
        std::visit(
            [](auto& result) {
                result.regions.clear();
                result.localization = {};
            },
            any);
    }
    return results;
}

TEST_F(Resident, AFrameKeepsItsImagesWhileTheNextIsSubmitted) {
    Random random(frame_seed);
    const Pair shapes{
        {"coast", coast(random, 120, 0.5)}, {"holes", with_holes(random, 3)}, {}, {}, 0.03};
    Settings settings;
    settings.batches_in_flight = 2;
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PlacedPair pair(*made, shapes, Technique::compute);
    struct Frame {
        Ticket ticket;
        QueryHandle<DistanceFieldQuery> field;
        QueryHandle<PenetrationQuery> depths;
    };
    const auto submit = [&](int number) {
        Batch batch;
        DistanceFieldQuery field = field_of(pair, Technique::compute);
        field.b.pose.translation.x = 0.01 * number;
        PenetrationQuery depths = pair.penetration();
        depths.b.pose.translation.x = 0.01 * number;
        depths.on_device = true;
        Frame frame;
        frame.field = batch.add(field);
        frame.depths = batch.add(depths);
        const Expected<Ticket> ticket = made->submit(batch);
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        frame.ticket = ticket.has_value() ? *ticket : Ticket{};
        return frame;
    };
    Frame former = submit(0);
    for (int number = 1; number < 8; ++number) {
        const Frame next = submit(number);
        const Expected<FieldOnDevice> field = made->on_device(former.ticket, former.field);
        const Expected<PointsOnDevice> records = made->on_device(former.ticket, former.depths);
        ASSERT_TRUE(field.has_value() && records.has_value());
        Kept<DistanceFieldQuery> kept{*field, contents_of(*field), {}};
        const RecordsContents depths = contents_of(*records);
        Results results;
        ASSERT_TRUE(made->collect(former.ticket, results).ok());
        kept.result = results[former.field];
        check_field(pair, kept);
        ASSERT_GT(depths.records.size(), 10U);
        EXPECT_EQ(depths.records.size(), results[former.depths].points.size());
        former = next;
    }
    Results results;
    ASSERT_TRUE(made->collect(former.ticket, results).ok());
}

TEST_F(Resident, WhatComesBackIsTheSameWithAndWithout) {
    Random random(frame_seed);
    const Rings rings = with_holes(random, 3);
    const Pair shapes{{"turned", rings}, {"holes", rings}, {{0.03, 0.02}, 0.12}, {}, 0.01};
    // With its own context: the samples of the intersection, most cells of its regions, exceed
    // the capacity of the first submission, and their tile batches are submitted again.
    Expected<Context> made = Context::create(host_device(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PlacedPair pair(*made, shapes, Technique::compute);
    const auto ask_all = [&](bool resident, std::size_t& records) {
        DistanceFieldQuery field = field_of(pair, Technique::compute);
        field.on_device = resident;
        const std::vector<Vector2> points{field.rectangle->min};
        PenetrationQuery depths = pair.penetration();
        depths.on_device = resident;
        ContactQuery contacts = pair.contacts(0.05);
        contacts.on_device = resident;
        Batch batch;
        IntersectionQuery overlap = pair.intersection(IntersectionKind::volume_volume);
        overlap.on_device = resident;
        batch.add(overlap);
        batch.add(field);
        const auto of_depths = batch.add(depths);
        batch.add(contacts);
        field.on_device = false;
        field.points = points;
        batch.add(field);
        Results results;
        const Expected<Ticket> ticket = made->submit(batch);
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        EXPECT_TRUE(made->collect(*ticket, results).ok());
        records = results[of_depths].points.size();
        return all_numbers(without_regions(std::move(results)));
    };
    std::size_t with = 0;
    std::size_t without = 0;
    const std::vector<double> first = ask_all(true, with);
    EXPECT_EQ(first, ask_all(false, without));
    EXPECT_GT(with, 50U);
}

TEST_F(Resident, ImagesOnlyGrow) {
    Random random(frame_seed);
    const Pair shapes{
        {"coast", coast(random, 120, 0.5)}, {"holes", with_holes(random, 3)}, {}, {}, 0.03};
    Settings settings;
    settings.batches_in_flight = 1;
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PlacedPair pair(*made, shapes, Technique::compute);
    DistanceFieldQuery query = field_of(pair, Technique::compute);
    VkImage former = VK_NULL_HANDLE;
    for (const double width : {1.0, 0.5, 1.0, 1.5}) {
        query.rectangle = Rectangle{{-0.5, -0.5}, {-0.5 + width, 0.5}};
        const auto kept = keep(*made, query);
        check_field(pair, kept);
        EXPECT_GE(kept.output.image_extent.width, kept.output.width);
        if (former != VK_NULL_HANDLE && width <= 1.0) {
            EXPECT_EQ(kept.output.signed_distance.image, former);
        }
        former = kept.output.signed_distance.image;
    }
}

TEST_F(Resident, RefusesByName) {
    const ShapeHandle shape = *context().add_shape(regular(5));
    const Instance here{shape, {}};
    PenetrationQuery depths{here, here, 0.1};
    PenetrationQuery by_cpu = depths;
    by_cpu.technique = Technique::cpu;
    by_cpu.on_device = true;
    ContactQuery gradients{here, here, 0.1, 0.1, ContactNormals::gradient};
    gradients.on_device = true;
    DistanceFieldQuery field;
    field.technique = Technique::compute;
    field.b = here;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{0.0, 0.0}, {1.0, 1.0}};
    field.on_device = true;
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
    ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
    const auto expect = [](const auto& answer, StatusCode code, const char* words) {
        EXPECT_FALSE(answer.has_value());
        EXPECT_EQ(answer.error().code(), code) << answer.error().text();
        EXPECT_NE(answer.error().message().find(words), std::string::npos) << answer.error().text();
    };
    EXPECT_TRUE(context().on_device(*ticket, good).has_value());
    expect(context().on_device(*ticket, not_resident), StatusCode::invalid_query, "did not ask");
    expect(context().on_device(*ticket, of_cpu), StatusCode::invalid_query, "technique cpu");
    expect(context().on_device(*ticket, of_gradients), StatusCode::invalid_query, "analytic");
    expect(context().on_device(*ticket, of_huge), StatusCode::too_large, "an image of this device");
    expect(context().on_device(*ticket, of_far), StatusCode::invalid_query, "single precision");
    expect(context().on_device(*ticket, QueryHandle<PenetrationQuery>{99}),
           StatusCode::invalid_query, "none of the batch");
    expect(context().on_device(*ticket, QueryHandle<PenetrationQuery>{good.index}),
           StatusCode::invalid_query, "another kind");
    expect(context().on_device(Ticket{}, good), StatusCode::unknown_ticket, "ticket");
    Results results;
    ASSERT_TRUE(context().collect(*ticket, results).ok());
    EXPECT_EQ(results[of_cpu].status.code(), StatusCode::invalid_query);
    expect(context().on_device(*ticket, good), StatusCode::unknown_ticket, "ticket");
    EXPECT_TRUE(context().remove_shape(shape).ok());
}

TEST_F(Resident, AutomaticAnswersOnTheDevice) {
    Settings settings;
    settings.device_thresholds = {.pairs = UINT64_MAX, .cells = UINT64_MAX};
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const ShapeHandle shape = *made->add_shape(regular(5));
    PenetrationQuery query{{shape, {}}, {shape, {{0.3, 0.0}, 0.1}}, 0.1};
    EXPECT_EQ(run_alone(*made, query).technique, Technique::cpu);
    query.on_device = true;
    const PenetrationResult result = run_alone(*made, query);
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_NE(result.technique, Technique::cpu);
}

}  // namespace
}  // namespace nearfield::test
