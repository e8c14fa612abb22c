#include <gtest/gtest.h>
#include <tests/query/all_numbers.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/vulkan_host.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::HostGpu;

constexpr int frames = 3;
using Words = std::vector<std::uint32_t>;

/// A context, and two shapes that every context has alike.
struct Scene {
    explicit Scene(const HostDevice& host, Settings settings = {}) {
        settings.pipelines_on_demand = true;
        Expected<Context> made = Context::create(host, settings);
        if (!made) {
            throw std::runtime_error(made.error().text());
        }
        context.emplace(std::move(*made));
        Random random(1907);
        a = *context->add_shape(star(random, 40, 0.5));
        b = *context->add_shape(star(random, 60, 0.4));
    }

    /// Queries of every kind, by compute and by what is chosen.
    [[nodiscard]] Batch batch() const {
        Batch batch;
        const Instance here{a, {}};
        const Instance there{b, {{0.7, 0.2}, 0.4}};
        const Instance apart{b, {{4.0, 0.3}, 0.1}};
        for (const Technique technique : {Technique::compute, Technique::automatic}) {
            batch.add(PenetrationQuery{here, there, 0.02, {}, false, technique});
            batch.add(ContactQuery{here, there, 0.02, 0.05, {}, false, technique});
            batch.add(
                ContactQuery{here, there, 0.02, 0.05, ContactNormals::gradient, false, technique});
            batch.add(ClosestPointQuery{here, apart, 0.02, technique});
            batch.add(SeparationQuery{here, apart, 0.02, technique});
            IntersectionQuery overlap{here, there, 0.02};
            DistanceFieldQuery field{here, there, 0.05};
            overlap.technique = field.technique = technique;
            field.features = field.gradients = true;
            batch.add(overlap);
            batch.add(field);
        }
        return batch;
    }

    [[nodiscard]] std::vector<double> numbers(const Expected<Ticket>& ticket) {
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        Results results;
        const Status status =
            ticket.has_value() ? context->collect(*ticket, results) : ticket.error();
        EXPECT_TRUE(status.ok()) << status.text();
        for (const AnyResult& any : results.results) {
            std::visit(
                [](const auto& result) {
                    EXPECT_TRUE(result.status.ok()) << result.status.text();
                    EXPECT_NE(result.technique, Technique::raster);
                },
                any);
        }
        return all_numbers(results);
    }

    std::optional<Context> context;
    ShapeHandle a, b;
};

/// A field and contacts that stay on the device; `number` moves them.
struct ResidentBatch {
    ResidentBatch(const Scene& scene, int number) {
        const Instance there{scene.b, {{0.7, 0.2 + 0.1 * number}, 0.4}};
        DistanceFieldQuery wanted;
        wanted.b = there;
        wanted.tolerance = 0.05;
        wanted.rectangle = Rectangle{{-1.0, -1.0}, {2.0, 1.0}};
        wanted.values = false;
        wanted.technique = Technique::compute;
        wanted.on_device = true;
        field = batch.add(wanted);
        ContactQuery contact{{scene.a, {}}, there, 0.02, 0.05};
        contact.technique = Technique::compute;
        contact.on_device = true;
        contacts = batch.add(contact);
    }

    Batch batch;
    QueryHandle<DistanceFieldQuery> field;
    QueryHandle<ContactQuery> contacts;
};

/// What a queue of the host finds in the resident results of a batch.
struct Found {
    Words distances;
    Words features;
    Words contacts;

    friend bool operator==(const Found&, const Found&) = default;
};

Found read(HostGpu& gpu, const FieldOnDevice& field, const PointsOnDevice& records) {
    Found found;
    const VkExtent2D extent{field.width, field.height};
    found.distances = gpu.read(field.signed_distance, extent, field.state);
    found.features = gpu.read(field.feature, extent, field.state);
    found.contacts = gpu.read(records.buffer, records.offset, records.size, records.state);
    const std::uint64_t bytes =
        sizeof(SummaryData) + found.contacts.front() * std::uint64_t{sizeof(PointData)};
    EXPECT_GT(found.contacts.front(), 10U);
    found.contacts.resize(bytes / sizeof(std::uint32_t));
    return found;
}

class AsyncCompute : public ::testing::Test {
protected:
    AsyncCompute() {
        test_support::Enabled enabled;
        enabled.async_compute = true;
        host_.emplace(enabled);
    }
    void TearDown() override { EXPECT_EQ(host_->close(), std::vector<std::string>{}); }

    [[nodiscard]] const HostDevice& computing() const { return host_->device(); }
    [[nodiscard]] const HostDevice& drawing() const { return host_->drawing_device(); }
    /// The results of a batch on the queue that draws, read there.
    [[nodiscard]] std::vector<Found> expected() const {
        Scene scene(drawing());
        HostGpu gpu(drawing());
        std::vector<Found> all;
        for (int i = 0; i < frames; ++i) {
            const ResidentBatch asked(scene, i);
            const Expected<Ticket> ticket = scene.context->submit(asked.batch);
            all.push_back(read(gpu, *scene.context->on_device(*ticket, asked.field),
                               *scene.context->on_device(*ticket, asked.contacts)));
            static_cast<void>(scene.numbers(ticket));
        }
        return all;
    }

private:
    std::optional<test_support::VulkanHost> host_;
};

TEST_F(AsyncCompute, GivesTheSameAnswersSubmittedAndRecorded) {
    ASSERT_NE(computing().queue, drawing().queue);
    Settings settings;
    settings.techniques = {.raster = false};
    Scene drawing_scene(drawing(), settings);
    Scene scene(computing());
    const auto run = [](Scene& in) { return in.numbers(in.context->submit(in.batch())); };
    const std::vector<double> submitted = run(scene);
    ASSERT_GT(submitted.size(), 1000U);
    EXPECT_EQ(submitted, run(drawing_scene));
    HostFrames host(computing(), 1);
    const Expected<Ticket> ticket =
        scene.context->record(scene.batch(), {.commands = host.begin(0), .frame = 0});
    host.submit(0);
    host.wait(0);
    scene.context->frame_completed(0);
    EXPECT_EQ(scene.numbers(ticket), submitted);
}

TEST_F(AsyncCompute, IsReadByTheFamilyThatDrawsAfterASemaphore) {
    const std::vector<Found> wanted = expected();
    const std::uint32_t families[] = {drawing().queue_family};
    HostDevice host = computing();
    host.reader_families = families;
    host.reader_family_count = 1;
    Scene scene(host);
    HostGpu gpu(drawing());
    const SemaphoreSignal done{gpu.make_semaphore()};
    for (int i = 0; i < frames; ++i) {
        const ResidentBatch asked(scene, i);
        const Expected<Ticket> ticket = scene.context->submit(asked.batch, {.signals = {&done, 1}});
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        gpu.wait_for(done.semaphore);
        EXPECT_EQ(read(gpu, *scene.context->on_device(*ticket, asked.field),
                       *scene.context->on_device(*ticket, asked.contacts)),
                  wanted[static_cast<std::size_t>(i)]);
        static_cast<void>(scene.numbers(ticket));
    }
}

/// Both halves of a transfer of ownership; nothing is done about the contents.
void transfer(const HostGpu& gpu, VkCommandBuffer commands, const FieldOnDevice& field,
              const PointsOnDevice& records, std::uint32_t from, std::uint32_t to) {
    std::vector<VkImageMemoryBarrier> images;
    for (const VkImage image : {field.signed_distance.image, field.feature.image}) {
        VkImageMemoryBarrier& barrier = images.emplace_back();
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.oldLayout = barrier.newLayout = field.state.layout;
        barrier.srcQueueFamilyIndex = from;
        barrier.dstQueueFamilyIndex = to;
        barrier.image = image;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    }
    VkBufferMemoryBarrier buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
    buffer.srcQueueFamilyIndex = from;
    buffer.dstQueueFamilyIndex = to;
    buffer.buffer = records.buffer;
    buffer.size = VK_WHOLE_SIZE;
    gpu.vkCmdPipelineBarrier(commands, records.state.stages, records.state.stages, 0, 0, nullptr, 1,
                             &buffer, static_cast<std::uint32_t>(images.size()), images.data());
}

TEST_F(AsyncCompute, IsReadByTheFamilyThatDrawsAfterATransferOfOwnership) {
    const std::vector<Found> wanted = expected();
    Scene scene(computing());
    HostGpu compute(computing());
    HostGpu draw(drawing());
    const std::uint32_t from = computing().queue_family;
    const std::uint32_t to = drawing().queue_family;
    const VkSemaphore done = compute.make_semaphore();
    for (int i = 0; i < frames; ++i) {
        const ResidentBatch asked(scene, i);
        const auto frame = static_cast<std::uint64_t>(i);
        Ticket ticket;
        std::optional<FieldOnDevice> field;
        std::optional<PointsOnDevice> records;
        compute.signal(done);
        compute.submit([&](VkCommandBuffer commands) {
            ticket = *scene.context->record(asked.batch, {.commands = commands, .frame = frame});
            field = *scene.context->on_device(ticket, asked.field);
            records = *scene.context->on_device(ticket, asked.contacts);
            EXPECT_EQ(field->state.queue_family, from);
            transfer(compute, commands, *field, *records, from, to);
        });
        draw.wait_for(done);
        draw.submit([&](VkCommandBuffer commands) {
            transfer(draw, commands, *field, *records, from, to);
        });
        draw.finish();
        EXPECT_EQ(read(draw, *field, *records), wanted[static_cast<std::size_t>(i)]);
        compute.finish();
        scene.context->frame_completed(frame);
        static_cast<void>(scene.numbers(ticket));
    }
}

}  // namespace
}  // namespace nearfield::test
