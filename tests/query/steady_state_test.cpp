#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/watched_loader.hpp>

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

// Counts the library's calls to the driver. Allocations of the driver and the validation layers are
// counted separately.

std::uint64_t allocations_below = 0;
std::vector<std::string> created;  // entry points called that create or destroy objects

void note_call(const test_support::WatchedCall& call) {
    allocations_below += call.allocations;
    if (call.makes() || call.destroys() || call.name.starts_with("vkMap")) {
        created.emplace_back(call.name);
    }
}

class SteadyState : public QueryTest {
protected:
    void SetUp() override {
        loader_.emplace(host_device(), test_support::watched(host_device(), note_call));
        Expected<Context> made = Context::create(loader_->host(), drawing({.timestamps = true}));
        ASSERT_TRUE(made.has_value()) << made.error().text();
        watched_.emplace(std::move(*made));
        EXPECT_FALSE(created.empty()) << "nothing is counted";
        Random random(31);
        for (const double size : {1.0, 0.9, 1.1}) {
            rings_a_.push_back(coast(random, 60 + static_cast<int>(20 * size), 0.5));
            rings_b_.push_back(scaled_and_moved(with_holes(random, 3), size, {}));
        }
        const Expected<ShapeHandle> a = watched_->add_shape(rings_a_.front());
        const Expected<ShapeHandle> b = watched_->add_shape(rings_b_.front());
        ASSERT_TRUE(a.has_value() && b.has_value());
        a_ = *a;
        b_ = *b;
        batch_ = frame(a_, b_);
    }
    void TearDown() override {
        watched_.reset();
        loader_.reset();
        QueryTest::TearDown();
    }

    [[nodiscard]] Context& watched() { return *watched_; }
    [[nodiscard]] const Batch& batch() const { return batch_; }
    [[nodiscard]] std::vector<ShapeHandle> shapes_of_frame() const { return {a_, b_}; }

    /// Queries with resident outputs: fields first, then penetration, contacts and intersections.
    [[nodiscard]] Batch resident_batch() const {
        Batch batch;
        DistanceFieldQuery field;
        field.b = {b_, {{5.7, 5.1}, 0.3}};
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{4.0, 4.0}, {6.0, 6.0}};
        field.resident = true;
        for (const Technique technique : {Technique::raster, Technique::compute}) {
            field.technique = technique;
            batch.add(field);
        }
        for (const Technique technique : {Technique::raster, Technique::compute}) {
            const Instance here{a_, {{5.0, 5.0}, 0.0}};
            batch.add(PenetrationQuery{here, field.b, 0.08, {}, true, technique, true});
            batch.add(ContactQuery{here, field.b, 0.08, 0.05, {}, true, technique, true});
            for (const IntersectionKind kind :
                 {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
                batch.add(IntersectionQuery{here, field.b, 0.08, kind, true,
                                            IntersectionStrategy::stencil, technique, true});
            }
        }
        return batch;
    }

    /// Both shapes take their next form.
    [[nodiscard]] bool deform(int frame) {
        const auto form = static_cast<std::size_t>(frame) % rings_a_.size();
        return watched_->update_shape(a_, rings_a_[form]).ok() &&
               watched_->update_shape(b_, rings_b_[form]).ok();
    }

    /// Calls `frame(number)`, which returns whether it succeeded, first to warm up and then as
    /// often as requested, and expects no creation or allocation in the second part.
    template <class Frame>
    void expect_nothing_made(int frames, const Frame& frame) {
        constexpr int warm_up = 24;
        for (int i = 0; i < warm_up; ++i) {
            ASSERT_TRUE(frame(i)) << "frame " << i;
        }
        created.clear();
        allocations_below = 0;
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        int failures = 0;
        for (int i = warm_up; i < warm_up + frames; ++i) {
            failures += frame(i) ? 0 : 1;
        }
        const std::uint64_t all = test_support::allocation_count_of_this_thread() - before;
        EXPECT_EQ(failures, 0);
        EXPECT_EQ(created, std::vector<std::string>());
        EXPECT_EQ(all - allocations_below, 0U) << "in " << frames << " frames";
    }

    /// Work of the host itself does not count.
    template <class Action>
    static void by_others(const Action& action) {
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        action();
        allocations_below += test_support::allocation_count_of_this_thread() - before;
    }

    static void expect_answers(const Results& results) {
        for (std::size_t i = 0; i < results.results.size(); ++i) {
            std::visit(
                [&](const auto& result) {
                    EXPECT_TRUE(result.status.ok())
                        << "query " << i << ": " << result.status.text();
                    EXPECT_TRUE(!result.regions.empty() || result.technique == Technique::cpu)
                        << "query " << i;
                },
                results.results[i]);
        }
    }

private:
    /// One query of each kind that a simulation frame needs, by every technique.
    static Batch frame(ShapeHandle a, ShapeHandle b) {
        Batch batch;
        // All contacts in one square of GradientNormals: the number of fields is then the same in
        // every frame, whatever the forms.
        const Instance here{a, {{5.0, 5.0}, 0.0}};
        const Instance there{b, {{5.7, 5.1}, 0.3}};
        const Instance apart{b, {{8.5, 5.1}, 0.3}};
        for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
            for (const PenetrationPoints points :
                 {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
                batch.add(PenetrationQuery{here, there, 0.08, points, true, technique});
            }
            batch.add(ContactQuery{here, there, 0.08, 0.05, {}, true, technique});
            batch.add(SeparationQuery{here, apart, 0.08, technique});
            batch.add(ClosestPointQuery{here, apart, 0.08, technique});
        }
        batch.add(ContactQuery{here, there, 0.08, 0.05, ContactNormals::gradient});
        DistanceFieldQuery field;
        field.b = there;
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{4.0, 4.0}, {6.0, 6.0}};
        field.features = true;
        static constexpr Vector2 points[] = {{5.1, 5.2}, {4.7, 5.4}};
        field.points = points;
        for (const Technique technique : {Technique::raster, Technique::compute}) {
            field.technique = technique;
            batch.add(field);
            for (const IntersectionKind kind :
                 {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
                batch.add(IntersectionQuery{here, there, 0.08, kind, true,
                                            IntersectionStrategy::stencil, technique});
            }
        }
        return batch;
    }

    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> watched_;
    std::vector<Rings> rings_a_;
    std::vector<Rings> rings_b_;
    ShapeHandle a_;
    ShapeHandle b_;
    Batch batch_;
};

TEST_F(SteadyState, AThousandFramesInFlightAllocateAndCreateNothing) {
    Results results;
    Ticket former;
    expect_nothing_made(1000, [&](int number) {
        // The previous frame is still in flight when the shapes deform and this one is submitted.
        if (!deform(number)) {
            return false;
        }
        const Expected<Ticket> ticket = watched().submit(batch());
        const bool ok =
            ticket.has_value() && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), batch().queries().size());
}

TEST_F(SteadyState, AThousandRecordedFramesAllocateAndCreateNothing) {
    constexpr std::uint64_t frames = 2;
    test_support::HostFrames host(host_device(), frames);
    // An error message needs memory, so the batch contains no query that is rejected.
    Batch recordable;
    for (const AnyQuery& query : batch().queries()) {
        const auto* const contacts = std::get_if<ContactQuery>(&query);
        if (contacts == nullptr || contacts->normals == ContactNormals::analytic) {
            std::visit([&](const auto& same) { recordable.add(same); }, query);
        }
    }
    Results results;
    Ticket tickets[frames];
    std::uint64_t number = 0;
    expect_nothing_made(1000, [&](int form) {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        by_others([&] { commands = host.begin(number); });
        Ticket& ticket = tickets[number % frames];
        bool ok = deform(form);
        if (number >= frames) {
            watched().frame_completed(number - frames);
            ok = ok && watched().collect(ticket, results).ok();
        }
        const Expected<Ticket> next =
            watched().record(recordable, {.commands = commands, .frame = number});
        ok = ok && next.has_value();
        ticket = next.has_value() ? *next : Ticket{};
        by_others([&] { host.submit(number++); });
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), recordable.queries().size());
    host.wait(number - 1);
}

TEST_F(SteadyState, FramesThatAreWaitedForAllocateAndCreateNothing) {
    Results results;
    expect_nothing_made(
        50, [&](int number) { return deform(number) && watched().run(batch(), results).ok(); });
    expect_answers(results);
}

TEST_F(SteadyState, DevicePairsOfMovingInstancesAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<InstanceHandle> instances;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto instance = world->add({.shape = shapes[i % 2], .pose = {}});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        instances.push_back(*instance);
    }
    DevicePairTable<PenetrationQuery> table({.tolerance = 0.08});
    DevicePairTable intersections(IntersectionTestQuery{});
    DevicePairTable contacts(ContactQuery{.tolerance = 0.08, .contact_distance = 0.1});
    std::vector<ContactRecord> contact_records;
    std::vector<ContactCluster> manifold;
    std::vector<PenetrationRecord> records;
    std::uint32_t rows = 0;
    expect_nothing_made(200, [&](int number) {
        bool ok = true;
        for (std::size_t i = 0; i < instances.size(); ++i) {
            // The same poses again and again, so that warming up has seen all.
            const double angle = 0.7 * (number % 8) + static_cast<double>(i);
            ok = world->move(instances[i], {{0.8 * static_cast<double>(i), 0.0}, angle}).ok() && ok;
        }
        ok = world->update(table).ok() && ok;
        for (std::uint32_t row = 0; row < table.size(); ++row) {
            ok = table.row(row).has_value() && table.records(row, records).ok() && ok;
        }
        rows = table.size();
        ok = world->update(intersections).ok() && ok;
        for (std::uint32_t row = 0; row < intersections.size(); ++row) {
            ok = intersections.row(row).has_value() && ok;
        }
        ok = world->submit(contacts).ok() && contacts.collect().ok() && ok;
        for (std::uint32_t row = 0; row < contacts.size(); ++row) {
            ok = contacts.row(row).has_value() && contacts.records(row, contact_records).ok() &&
                 contacts.manifold(row, manifold).ok() && ok;
        }
        return ok;
    });
    EXPECT_GT(rows, 10U);
}

TEST_F(SteadyState, QuestionsForTheDeviceAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<InstanceHandle> instances;
    for (std::size_t i = 0; i < 20; ++i) {
        // Some are at the same place, so that the CPU answers some questions.
        const Pose pose{{0.8 * static_cast<double>(i / 2), 0.0}, 0.0};
        const auto instance = world->add({.shape = shapes[0], .pose = pose});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        instances.push_back(*instance);
    }
    std::vector<Segment> segments;
    std::vector<Vector2> points;
    for (int i = 0; i < 300; ++i) {
        points.push_back({0.03 * i, 0.01 * (i % 50)});
        segments.push_back({{0.03 * i, -3.0}, {0.02 * i, 3.0}});
    }
    std::vector<RayHit> hits(segments.size());
    std::vector<NearestHit> near(points.size());
    const std::vector<Pose> poses(300, Pose{{3.6, 0.0}, 0.3});
    std::vector<std::uint8_t> meets(poses.size());
    DeviceRays rays;
    DeviceNearest nearest;
    DevicePoseTests tests;
    expect_nothing_made(200, [&](int number) {
        const double angle = 0.7 * (number % 8);
        // The last two move together.
        const bool ok = world->move(instances[18], {{7.2, 0.0}, angle}).ok() &&
                        world->move(instances[19], {{7.2, 0.0}, angle}).ok() &&
                        world->submit(nearest, {}, points).ok() &&
                        world->cast_rays(rays, segments, hits).ok() && nearest.collect(near).ok() &&
                        world->test_poses(tests, {.shape = shapes[1]}, poses, meets).ok();
        return ok;
    });
    EXPECT_GT(nearest.left_to_cpu(), 10U);
    EXPECT_NE(hits[10].instance, InstanceHandle{});
}

TEST_F(SteadyState, DevicePairsAtPosesOfTheHostAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<std::array<float, 4>> places;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto instance = world->add({.shape = shapes[i % 2], .pose = {}});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        places.push_back({0.8F * static_cast<float>(i), 0.0F, 0.6F, 0.8F});
    }
    test_support::HostGpu gpu(host_device());
    const std::uint64_t bytes = sizeof(places[0]) * places.size();
    const auto buffer = gpu.make_buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    std::memcpy(const_cast<std::byte*>(buffer.data), places.data(), bytes);  // it is mapped
    DevicePoses poses;
    poses.buffer = buffer.buffer;
    poses.size = bytes;
    poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    DevicePairTable<PenetrationQuery> table({.tolerance = 0.08, .resident = true});
    std::vector<PenetrationRecord> records;
    expect_nothing_made(200, [&](int) {
        bool ok = world->submit(table, poses).ok() && table.resident() && table.collect().ok();
        for (std::uint32_t row = 0; row < table.size(); ++row) {
            ok = table.row(row).has_value() && table.records(row, records).ok() && ok;
        }
        return ok;
    });
    EXPECT_GT(table.size(), 10U);
}

TEST_F(SteadyState, WhatStaysOnTheDeviceAllocatesAndCreatesNothing) {
    const Batch batch = resident_batch();
    Results results;
    Ticket former;
    expect_nothing_made(200, [&](int number) {
        if (!deform(number)) {
            return false;
        }
        const Expected<Ticket> ticket = watched().submit(batch);
        const bool exported =
            ticket.has_value() &&
            watched().resident(*ticket, QueryHandle<DistanceFieldQuery>{0}).has_value() &&
            watched().resident(*ticket, QueryHandle<PenetrationQuery>{2}).has_value() &&
            watched().resident(*ticket, QueryHandle<IntersectionQuery>{4}).has_value();
        const bool ok = exported && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), batch.queries().size());
}

/// Images and buffers of a host that takes turns with three of each.
struct TakenInTurns {
    explicit TakenInTurns(test_support::HostGpu& gpu) {
        const VkExtent2D extent{64, 64};
        const VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        for (std::size_t i = 0; i < images.size(); ++i) {
            for (auto [image, format] :
                 {std::pair{&images[i].signed_distance, VK_FORMAT_R32_SFLOAT},
                  std::pair{&images[i].feature, VK_FORMAT_R32_UINT}}) {
                image->image = gpu.make_image(format, extent, usage).image;
                image->format = format;
                image->extent = extent;
                image->usage = usage;
            }
            buffers[i].usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
            buffers[i].size = 1 << 18;
            buffers[i].buffer = gpu.make_buffer(buffers[i].size, buffers[i].usage).buffer;
        }
    }

    std::array<ResidentFieldTarget, 3> images;
    std::array<ResidentBufferTarget, 3> buffers;
};

TEST_F(SteadyState, TargetsThatTakeTurnsAllocateAndCreateNothing) {
    test_support::HostGpu gpu(host_device());
    const TakenInTurns targets(gpu);
    const Batch all = resident_batch();
    Batch batch;
    Results results;
    Ticket former;
    expect_nothing_made(100, [&](int number) {
        if (!deform(number)) {
            return false;
        }
        const std::size_t turn = static_cast<std::size_t>(number) % targets.images.size();
        auto field = std::get<DistanceFieldQuery>(all.queries()[0]);
        auto depths = std::get<PenetrationQuery>(all.queries()[2]);
        field.target = &targets.images[turn];
        depths.target = &targets.buffers[turn];
        batch.clear();
        batch.time_queries(true);
        batch.add(field);
        batch.add(depths);
        const Expected<Ticket> ticket = watched().submit(batch);
        const bool ok =
            ticket.has_value() && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_TRUE(watched().collect(former, results).ok());
    // Of each image one view was made, which goes when the host says so, and only then.
    for (const ResidentFieldTarget& target : targets.images) {
        created.clear();
        EXPECT_TRUE(watched().release_target(target.feature.image).ok());
        EXPECT_EQ(created, std::vector<std::string>{"vkDestroyImageView"});
        EXPECT_TRUE(watched().release_target(target.feature.image).ok());
        EXPECT_EQ(created.size(), 1U);
    }
}

}  // namespace
}  // namespace nearfield::test
