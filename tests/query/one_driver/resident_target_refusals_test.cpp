#include <tests/query/query_test.hpp>
#include <tests/support/host_gpu.hpp>

#include <functional>
#include <optional>
#include <string>

namespace nearfield::test {
namespace {

using test_support::HostGpu;

/// Tests of what is refused by name: one wrong statement about a target that is otherwise good.
class TargetRefusals : public QueryTest {
protected:
    void SetUp() override {
        gpu_.emplace(host_device());
        const VkExtent2D extent{64, 64};
        image_.format = VK_FORMAT_R32_SFLOAT;
        image_.extent = extent;
        image_.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        const HostGpu::Image made = gpu_->make_image(image_.format, extent, image_.usage);
        image_.image = made.image;
        image_.view = made.view;
        buffer_.size = 1 << 16;
        buffer_.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        buffer_.buffer =
            gpu_->make_buffer(2 * buffer_.size, buffer_.usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT)
                .buffer;
        shape_ = *context().add_shape(regular(40));
    }
    void TearDown() override {
        EXPECT_TRUE(context().remove_shape(shape_).ok());
        gpu_.reset();
        QueryTest::TearDown();
    }

    [[nodiscard]] DistanceFieldQuery field() const {
        DistanceFieldQuery query;
        query.technique = Technique::compute;
        query.b = {shape_, {}};
        query.tolerance = 0.05;
        query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        query.on_device = true;
        return query;
    }
    [[nodiscard]] PenetrationQuery depths() const {
        PenetrationQuery query{{shape_, {{0.3, 0.0}, 0.1}}, {shape_, {}}, 0.01};
        query.technique = Technique::compute;
        query.on_device = true;
        return query;
    }

    static void expect(const Status& status, const std::string& words) {
        EXPECT_EQ(status.code(), StatusCode::invalid_query) << words << ": " << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos)
            << words << " is not in: " << status.message();
    }
    void refuse_image(const std::string& words, const std::function<void(ImageTarget&)>& spoil) {
        FieldTarget target{image_, {}};
        spoil(target.signed_distance);
        DistanceFieldQuery query = field();
        query.target = &target;
        const Status status = run_alone(context(), query).status;
        expect(status, words);
        expect(status, "the target's image for the signed distance");
    }
    void refuse_buffer(const std::string& words, const std::function<void(BufferTarget&)>& spoil) {
        BufferTarget target = buffer_;
        spoil(target);
        PenetrationQuery query = depths();
        query.target = &target;
        const Status status = run_alone(context(), query).status;
        expect(status, words);
        expect(status, "the target's buffer");
    }

    ImageTarget image_;
    BufferTarget buffer_;
    ShapeHandle shape_;

private:
    std::optional<HostGpu> gpu_;
};

TEST_F(TargetRefusals, OfFeaturesThatAreNotToStay) {
    FieldTarget target{image_, image_};
    target.feature.format = VK_FORMAT_R32_UINT;
    target.feature.layer = 1;
    DistanceFieldQuery query = field();
    query.target = &target;
    query.features_on_device = false;
    expect(run_alone(context(), query).status, "DistanceFieldQuery::features_on_device");
    target.feature = {};
    const Status status = run_alone(context(), query).status;
    EXPECT_TRUE(status.ok()) << status.text();
}

TEST_F(TargetRefusals, OfImages) {
    FieldTarget good{image_, {}};
    DistanceFieldQuery query = field();
    query.target = &good;
    const Status status = run_alone(context(), query).status;
    ASSERT_TRUE(status.ok()) << status.text();

    refuse_image("format number 76; VK_FORMAT_R32_SFLOAT (100)",
                 [](auto& image) { image.format = VK_FORMAT_R16_SFLOAT; });
    refuse_image("0x4, which lacks VK_IMAGE_USAGE_STORAGE_BIT",
                 [](auto& image) { image.usage = VK_IMAGE_USAGE_SAMPLED_BIT; });
    refuse_image("has 28 x 64 texels; the field has 29 x 29 cells",
                 [](auto& image) { image.extent.width = 28; });
    refuse_image("has 64 x 28 texels", [](auto& image) { image.extent.height = 28; });
    refuse_image("has no view to write through", [](auto& image) { image.view = VK_NULL_HANDLE; });
    refuse_image("layout number 1000001002 before",
                 [](auto& image) { image.before.layout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR; });
    refuse_image("layout number 3 after", [](auto& image) {
        image.after.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    });
    refuse_image("VK_IMAGE_LAYOUT_UNDEFINED after",
                 [](auto& image) { image.after.layout = VK_IMAGE_LAYOUT_UNDEFINED; });
    refuse_image("VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, and its usage, 0xc, does not allow",
                 [](auto& image) { image.after.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL; });
    refuse_image("VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, and its usage, 0x8, does not allow",
                 [](auto& image) { image.usage = VK_IMAGE_USAGE_STORAGE_BIT; });
    refuse_image("accesses after", [](auto& image) { image.after.stages = 0; });
    refuse_image("accesses before", [](auto& image) { image.before.stages = 0; });

    // The other image is named as well.
    FieldTarget wrong{{}, image_};
    query.target = &wrong;
    expect(run_alone(context(), query).status,
           "the target's image for the feature has the format number 100; VK_FORMAT_R32_UINT (98)");
}

TEST_F(TargetRefusals, OfBuffers) {
    PenetrationQuery query = depths();
    query.target = &buffer_;
    const PenetrationResult good = run_alone(context(), query);
    ASSERT_TRUE(good.status.ok()) << good.status.text();
    ASSERT_GT(good.count, 20U);

    refuse_buffer("is null", [](auto& buffer) { buffer.buffer = VK_NULL_HANDLE; });
    refuse_buffer("0x80, which lacks VK_BUFFER_USAGE_STORAGE_BUFFER_BIT",
                  [](auto& buffer) { buffer.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT; });
    refuse_buffer("at the offset 2, which is no multiple of",
                  [](auto& buffer) { buffer.offset = 2; });
    refuse_buffer("the summary may take 32", [](auto& buffer) { buffer.size = 31; });
    refuse_buffer("VK_WHOLE_SIZE", [](auto& buffer) {
        buffer.offset = 4096;
        buffer.size = VK_WHOLE_SIZE;
    });
    refuse_buffer("accesses before", [](auto& buffer) { buffer.before.stages = 0; });

    refuse_buffer("0x20, which lacks VK_BUFFER_USAGE_TRANSFER_DST_BIT",
                  [](auto& buffer) { buffer.header_offset = buffer.size; });
    const auto with_header = [](std::uint64_t offset) {
        return [offset](BufferTarget& buffer) {
            buffer.usage |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
            buffer.offset = 4096;
            buffer.header_offset = offset;
        };
    };
    refuse_buffer("header at the offset 2, which is no multiple of 4", with_header(2));
    refuse_buffer("is no multiple of 4 that has bytes behind it", with_header(UINT64_MAX - 3));
    refuse_buffer("within the range that is written, from 4096 on", with_header(4028));
    refuse_buffer("within the range", with_header(4096 + buffer_.size - 4));

    BufferTarget small = buffer_;
    small.size = 100;
    ContactQuery contacts{query.a, query.b, query.tolerance, 0.02};
    contacts.technique = Technique::compute;
    contacts.on_device = true;
    contacts.target = &small;
    const Status overflow = run_alone(context(), contacts).status;
    EXPECT_EQ(overflow.code(), StatusCode::overflow);
    EXPECT_NE(overflow.message().find("has room for 2; a buffer of"), std::string::npos)
        << overflow.message();
    IntersectionQuery overlap{query.a, query.b, query.tolerance};
    overlap.technique = Technique::compute;
    overlap.on_device = true;
    overlap.target = &small;
    expect(run_alone(context(), overlap).status, "the samples may take");
    overlap.samples_on_device = false;  // the summary has room
    EXPECT_TRUE(run_alone(context(), overlap).status.ok());
}

TEST_F(TargetRefusals, ATooSmallBufferIsToldInTheResultOfItsQueryAlone) {
    BufferTarget small = buffer_;
    small.size = sizeof(SummaryData) + 10 * sizeof(PointData);
    PenetrationQuery query = depths();
    const PenetrationResult alone = run_alone(context(), query);
    ASSERT_GT(alone.count, 10U);
    query.target = &small;
    Batch batch;
    const auto told = batch.add(query);
    query.target = nullptr;
    const auto answered = batch.add(query);
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    EXPECT_EQ(results[told].status.code(), StatusCode::overflow);
    EXPECT_TRUE(results[answered].status.ok()) << results[answered].status.text();
    for (const auto handle : {told, answered}) {
        EXPECT_EQ(results[handle].count, alone.count);
        EXPECT_EQ(results[handle].points.size(), alone.points.size());
        EXPECT_EQ(results[handle].deepest.depth, alone.deepest.depth);
    }
}

TEST_F(TargetRefusals, OnePlaceTakesOneResult) {
    const FieldTarget target{image_, {}};
    DistanceFieldQuery query = field();
    query.target = &target;
    PenetrationQuery first = depths();
    BufferTarget low = buffer_;
    BufferTarget overlapping = buffer_;
    BufferTarget high = buffer_;
    overlapping.offset = buffer_.size - 1024;
    high.offset = buffer_.size;
    Batch batch;
    first.target = &low;
    const auto in_low = batch.add(first);
    const auto field_alone = batch.add(query);
    const auto field_again = batch.add(query);
    first.target = &overlapping;
    const auto in_both = batch.add(first);
    first.target = &high;
    const auto in_high = batch.add(first);
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    EXPECT_TRUE(results[in_low].status.ok()) << results[in_low].status.text();
    EXPECT_TRUE(results[field_alone].status.ok()) << results[field_alone].status.text();
    EXPECT_TRUE(results[in_high].status.ok()) << results[in_high].status.text();
    expect(results[field_again].status, "is written by query 1 of the same batch");
    expect(results[in_both].status, "is written by query 0 of the same batch");

    // Headers are places, too.
    low.usage = high.usage = buffer_.usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    low.size = 16384;
    low.header_offset = 32768;
    high.header_offset = 32768 + sizeof(HeaderData) - 4;
    Batch headers;
    first.target = &low;
    const auto below = headers.add(first);
    first.target = &high;
    const auto above = headers.add(first);
    ASSERT_TRUE(context().run(headers, results).ok());
    EXPECT_TRUE(results[below].status.ok()) << results[below].status.text();
    expect(results[above].status, "is written by query 0 of the same batch");
}

TEST_F(TargetRefusals, ATargetIsIgnoredIfNothingStays) {
    BufferTarget bad;
    PenetrationQuery query = depths();
    query.target = &bad;
    query.on_device = false;
    EXPECT_TRUE(run_alone(context(), query).status.ok());
}

}  // namespace
}  // namespace nearfield::test
