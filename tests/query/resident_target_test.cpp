#include <tests/query/all_numbers.hpp>
#include <tests/query/host_targets.hpp>
#include <tests/query/resident_test.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostGpu;

constexpr std::uint64_t target_seed = 8900;

/// Tests of results that go to images and buffers of the host. Everything of a frame is in one
/// command buffer, whose hazards the validation layers see: what the host does before, nearfield's
/// commands, what the host does after.
class ResidentTarget : public Resident {
protected:
    void SetUp() override {
        Resident::SetUp();
        gpu_.emplace(host_device());
        Expected<Context> made = Context::create(host_device(), on_demand());
        ASSERT_TRUE(made.has_value()) << made.error().text();
        made_.emplace(std::move(*made));
    }
    void TearDown() override {
        made_.reset();
        gpu_.reset();
        Resident::TearDown();
    }

    [[nodiscard]] Context& made() { return *made_; }
    [[nodiscard]] HostGpu& gpu() { return *gpu_; }

    /// Records a batch between `before(commands)` and `after(commands, ticket)`; waits for it.
    template <class Before, class After>
    Results record(const Batch& batch, const Before& before, const After& after) {
        Results results;
        Expected<Ticket> ticket = Ticket{};
        gpu().submit([&](VkCommandBuffer commands) {
            before(commands);
            ticket = made().record(batch, {.commands = commands, .frame = frame_});
            EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
            if (ticket.has_value()) {
                after(commands, *ticket);
            }
        });
        gpu().finish();
        made().frame_completed(frame_++);
        if (ticket.has_value()) {
            const Status status = made().collect(*ticket, results);
            EXPECT_TRUE(status.ok()) << status.text();
        }
        return results;
    }

    /// The words of both images, nearfield's own.
    struct FieldWords {
        FieldOnDevice field;
        std::vector<std::uint32_t> signed_distance;
        std::vector<std::uint32_t> feature;
    };
    FieldWords own_words(const DistanceFieldQuery& query) {
        FieldWords words;
        (void)ask(made(), query, [&](const FieldOnDevice& field) {
            words.field = field;
            const VkExtent2D extent{field.width, field.height};
            words.signed_distance = gpu().read(field.signed_distance, extent, field.state);
            words.feature = gpu().read(field.feature, extent, field.state);
        });
        return words;
    }

    /// The words of summary and records or samples, up to their number, and the header.
    struct OutputWords {
        std::vector<std::uint32_t> output;
        std::uint64_t bytes = 0;  ///< of the whole range
        std::vector<std::uint32_t> header;
    };
    template <class Query>
    OutputWords own_words(const Query& query, std::size_t words_of_record) {
        OutputWords words;
        (void)ask(made(), query, [&](const auto& output) {
            words.bytes = output.size;
            words.output = gpu().read(output.buffer, output.offset, output.size, output.state);
            const std::size_t summary = std::is_same_v<Query, IntersectionQuery>
                                            ? sizeof(IntersectionSummaryData)
                                            : sizeof(SummaryData);
            words.output.resize(summary / sizeof(std::uint32_t) +
                                std::min(words.output[0], output.capacity) * words_of_record);
            words.header = gpu().read(output.header.buffer, output.header.offset,
                                      sizeof(HeaderData), output.state);
        });
        return words;
    }

    template <class Query>
    void expect_same_in_buffer(const Query& query, std::size_t words_of_record, bool has_header);

private:
    std::optional<HostGpu> gpu_;
    std::optional<Context> made_;
    std::uint64_t frame_ = 0;
};

/// The level of a host's image holds these words in its low corner, and the pattern elsewhere.
void expect_cells(const HostImage& image, VkExtent2D extent, const std::vector<std::uint32_t>& own,
                  std::uint32_t width) {
    const std::vector<std::uint32_t> words = image.words();
    const std::size_t height = own.size() / width;
    int wrong = 0;
    for (std::size_t row = 0; row < extent.height; ++row) {
        for (std::size_t column = 0; column < extent.width; ++column) {
            const bool is_cell = row < height && column < width;
            const std::uint32_t expected = is_cell ? own[row * width + column] : HostImage::pattern;
            wrong += words[row * extent.width + column] == expected ? 0 : 1;
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << words.size() << " texels";
}

TEST_F(ResidentTarget, FieldsEqualThoseInOwnImages) {
    for_each_case(target_seed, 5, [&](Random& random) {
        const PlacedPair pair(made(), any_pair(random), Technique::compute);
        SCOPED_TRACE(describe(pair.pair()));
        DistanceFieldQuery query = field_of(pair, Technique::compute);
        query.values = query.features = false;
        const FieldWords own = own_words(query);
        ASSERT_FALSE(own.feature.empty());
        const VkExtent2D extent{own.field.width + 5, own.field.height + 3};
        const HostImage distance(gpu(), VK_FORMAT_R32_SFLOAT, extent);
        const HostImage feature(gpu(), VK_FORMAT_R32_UINT, extent);
        FieldTarget target{distance.target(), feature.target()};
        query.target = &target;
        Batch batch;
        const auto handle = batch.add(query);
        const Results results = record(
            batch,
            [&](VkCommandBuffer commands) {
                distance.fill(commands);
                feature.fill(commands);
            },
            [&](VkCommandBuffer commands, Ticket ticket) {
                target = {};  // it was borrowed for the call alone
                const auto field = made().on_device(ticket, handle);
                ASSERT_TRUE(field.has_value()) << field.error().text();
                EXPECT_EQ(field->signed_distance.image, distance.target().image);
                EXPECT_EQ(field->feature.image, feature.target().image);
                EXPECT_EQ(field->image_extent.width + field->image_extent.height, 0U);
                EXPECT_EQ(field->width, own.field.width);
                distance.use(commands);
                feature.use(commands);
            });
        EXPECT_TRUE(results[handle].status.ok()) << results[handle].status.text();
        expect_cells(distance, extent, own.signed_distance, own.field.width);
        expect_cells(feature, extent, own.feature, own.field.width);
    });
}

TEST_F(ResidentTarget, OneImageMayBeTheHosts) {
    Random random(target_seed);
    const PlacedPair pair(made(), any_pair(random), Technique::compute);
    DistanceFieldQuery query = field_of(pair, Technique::compute);
    const FieldWords own = own_words(query);
    const VkExtent2D extent{own.field.width, own.field.height};
    for (const bool of_feature : {false, true}) {
        const HostImage image(gpu(), of_feature ? VK_FORMAT_R32_UINT : VK_FORMAT_R32_SFLOAT,
                              extent);
        FieldTarget target;
        (of_feature ? target.feature : target.signed_distance) = image.target();
        query.target = &target;
        Batch batch;
        const auto handle = batch.add(query);
        FieldOnDevice field;
        (void)record(
            batch, [&](VkCommandBuffer commands) { image.fill(commands); },
            [&](VkCommandBuffer commands, Ticket ticket) {
                field = *made().on_device(ticket, handle);
                image.use(commands);
            });
        EXPECT_GE(field.image_extent.width, field.width);
        expect_cells(image, extent, of_feature ? own.feature : own.signed_distance, extent.width);
        // The other one is where it always is.
        const ImageOnDevice& kept = of_feature ? field.signed_distance : field.feature;
        EXPECT_EQ(gpu().read(kept, extent, field.state),
                  of_feature ? own.signed_distance : own.feature);
    }
}

template <class Query>
void ResidentTarget::expect_same_in_buffer(const Query& asked, std::size_t words_of_record,
                                           bool has_header) {
    Query query = asked;
    const OutputWords own = own_words(query, words_of_record);
    ASSERT_GT(own.output.size(), 8 + 10 * words_of_record);
    const HostBuffer buffer(gpu(), own.bytes, has_header);
    query.target = &buffer.target();
    Batch batch;
    const auto handle = batch.add(query);
    HeaderOnDevice header;
    OutputState state;
    const Results results = record(
        batch, [&](VkCommandBuffer commands) { buffer.fill(commands); },
        [&](VkCommandBuffer commands, Ticket ticket) {
            const auto output = made().on_device(ticket, handle);
            ASSERT_TRUE(output.has_value()) << output.error().text();
            EXPECT_EQ(output->buffer, buffer.target().buffer);
            EXPECT_EQ(output->offset, buffer.target().offset);
            EXPECT_EQ(output->size, own.bytes);
            EXPECT_EQ(output->state.stages, buffer.target().after.stages);
            header = output->header;
            state = {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
            buffer.use(commands);
        });
    EXPECT_TRUE(results[handle].status.ok()) << results[handle].status.text();
    if (has_header) {
        EXPECT_EQ(header.buffer, buffer.target().buffer);
        EXPECT_EQ(header.offset, *buffer.target().header_offset);
    } else {
        EXPECT_EQ(gpu().read(header.buffer, header.offset, sizeof(HeaderData), state), own.header);
    }
    // Exactly the range is written, as far as there are records, and the header.
    const std::vector<std::uint32_t> words = buffer.words();
    const std::size_t first = buffer.target().offset / sizeof(std::uint32_t);
    std::vector<std::uint32_t> expected(words.size(), HostBuffer::pattern);
    std::copy(own.output.begin(), own.output.end(),
              expected.begin() + static_cast<std::ptrdiff_t>(first));
    if (has_header) {
        std::copy(own.header.begin(), own.header.end(),
                  expected.begin() + static_cast<std::ptrdiff_t>(header.offset / 4));
    }
    EXPECT_EQ(words, expected);
}

TEST_F(ResidentTarget, RecordsAndSamplesEqualThoseInTheOwnBuffer) {
    Random random(target_seed);
    const Pair shapes{
        {"coast", coast(random, 120, 0.5)}, {"holes", with_holes(random, 3)}, {}, {}, 0.03};
    const PlacedPair pair(made(), shapes, Technique::compute);
    PenetrationQuery depths = pair.penetration();
    ContactQuery contacts = pair.contacts(0.05);
    IntersectionQuery overlap = pair.intersection(IntersectionKind::volume_volume);
    IntersectionQuery edges = pair.intersection(IntersectionKind::boundary_volume);
    depths.on_device = contacts.on_device = overlap.on_device = edges.on_device = true;
    for (const bool has_header : {false, true}) {
        expect_same_in_buffer(depths, sizeof(PointData) / 4, has_header);
        expect_same_in_buffer(contacts, sizeof(PointData) / 4, has_header);
        expect_same_in_buffer(overlap, sizeof(IntersectionSampleData) / 4, has_header);
        expect_same_in_buffer(edges, sizeof(IntersectionSampleData) / 4, has_header);
    }
}

TEST_F(ResidentTarget, WhatIsWrittenOutlivesTheBatch) {
    Random random(target_seed);
    const PlacedPair pair(made(), any_pair(random), Technique::compute);
    DistanceFieldQuery query = field_of(pair, Technique::compute);
    constexpr VkImageUsageFlags usage =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    // As a host that samples them: the states are the default ones. Batches in flight take turns.
    std::array<FieldTarget, 3> targets;
    std::array<FieldWords, 3> own;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        query.b.pose.angle = 0.1 * static_cast<double>(i);
        own[i] = own_words(query);
        const VkExtent2D extent{own[i].field.width, own[i].field.height};
        for (auto [image, format] : {std::pair{&targets[i].signed_distance, VK_FORMAT_R32_SFLOAT},
                                     std::pair{&targets[i].feature, VK_FORMAT_R32_UINT}}) {
            const test_support::HostGpu::Image made_image = gpu().make_image(format, extent, usage);
            image->image = made_image.image;
            image->view = made_image.view;
            image->format = format;
            image->extent = extent;
            image->usage = usage;
        }
    }
    std::vector<Ticket> tickets;
    Results results;
    for (std::size_t i = 0; i < 9; ++i) {
        if (tickets.size() == 2) {
            ASSERT_TRUE(made().collect(tickets.front(), results).ok());
            tickets.erase(tickets.begin());
        }
        Batch batch;
        query.b.pose.angle = 0.1 * static_cast<double>(i % targets.size());
        query.target = &targets[i % targets.size()];
        batch.add(query);
        const Expected<Ticket> ticket = made().submit(batch);
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        tickets.push_back(*ticket);
    }
    for (const Ticket ticket : tickets) {
        ASSERT_TRUE(made().collect(ticket, results).ok());
    }
    const OutputState state{read_by_shaders.stages, read_by_shaders.access, read_by_shaders.layout};
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const VkExtent2D extent = targets[i].feature.extent;
        const auto read = [&](const ImageTarget& target) {
            return gpu().read(ImageOnDevice{target.image, VK_NULL_HANDLE, target.format}, extent,
                              state);
        };
        EXPECT_EQ(read(targets[i].signed_distance), own[i].signed_distance);
        EXPECT_EQ(read(targets[i].feature), own[i].feature);
    }
}

}  // namespace
}  // namespace nearfield::test
