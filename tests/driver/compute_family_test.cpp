#include <gtest/gtest.h>
#include <tests/driver/world.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::MockDriver;

constexpr VkQueueFlags universal = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
constexpr VkQueueFlags compute_only = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
constexpr VkPipelineStageFlags stages_that_compute =
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;

/// The mock driver reports every command, stage and access of drawing on such a family.
TEST(ComputeFamily, AnswersByComputeAsAnyOther) {
    const std::vector<double> expected = World::undisturbed(Technique::compute);
    World world(Technique::compute);
    world.driver().set_queue_families({universal, compute_only}, 1);
    world.take_all_before(World::Step::destroy);
    std::vector<double> numbers;
    const Status status = world.answer(numbers);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(numbers, expected);
    for (const std::string_view call : world.driver().calls()) {
        EXPECT_NE(call, "vkCreateGraphicsPipelines");
        EXPECT_NE(call, "vkCreateRenderPass");
    }
    EXPECT_TRUE(world.take(World::Step::destroy).ok());
    EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
    EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
}

/// Two squares in a context on one of two queue families.
class OnFamily {
public:
    explicit OnFamily(std::uint32_t family, const Settings& settings = {},
                      std::vector<std::uint32_t> shared_with = {}) {
        driver_.set_queue_families({universal, compute_only, universal}, family);
        HostDevice host = driver_.host();
        host.reader_families = shared_with.data();
        host.reader_family_count = static_cast<std::uint32_t>(shared_with.size());
        Expected<Context> made = Context::create(host, settings);
        EXPECT_TRUE(made.has_value()) << made.error().text();
        context_.emplace(std::move(*made));
        const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        shape_ = *context_->add_shape(square);
    }
    ~OnFamily() {
        context_.reset();
        EXPECT_EQ(driver_.breaches(), std::vector<std::string>{});
        EXPECT_EQ(driver_.alive(), std::vector<std::string>{});
    }
    OnFamily(const OnFamily&) = delete;
    OnFamily& operator=(const OnFamily&) = delete;

    [[nodiscard]] MockDriver& driver() { return driver_; }
    [[nodiscard]] Context& context() { return *context_; }

    template <class Query>
    [[nodiscard]] Query query(Technique technique) const {
        Query query;
        query.a = {shape_, {}};
        query.b = {shape_, {{0.5, 0.5}, 0.1}};
        query.tolerance = 0.05;
        query.technique = technique;
        return query;
    }
    template <class Query>
    [[nodiscard]] auto answer(const Query& query) {
        Batch batch;
        const auto handle = batch.add(query);
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return results[handle];
    }

private:
    MockDriver driver_;
    std::optional<Context> context_;
    ShapeHandle shape_;
};

void expect_refused(const Status& status, const char* words) {
    EXPECT_EQ(status.code(), StatusCode::unsupported_technique);
    EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
    EXPECT_NE(status.message().find("VK_QUEUE_GRAPHICS_BIT"), std::string::npos) << status.text();
}

TEST(ComputeFamily, HasNoRasterAndSaysSo) {
    OnFamily on(1);
    expect_refused(on.answer(on.query<PenetrationQuery>(Technique::raster)).status,
                   "the technique raster draws, and the host's queue family does not");
    DistanceFieldQuery field = on.query<DistanceFieldQuery>(Technique::automatic);
    field.gradients = true;
    field.gradient = GradientMethod::blended;
    expect_refused(on.answer(field).status, "no technique that this context has");
    EXPECT_TRUE(on.answer(on.query<PenetrationQuery>(Technique::compute)).status.ok());
}

TEST(ComputeFamily, IsNeverGivenTheRasterByAutomatic) {
    const auto blended = [](OnFamily& on) {
        auto query = on.query<DistanceFieldQuery>(Technique::automatic);
        query.gradients = true;
        query.gradient = GradientMethod::blended;
        return on.answer(query);
    };
    if (has_raster) {
        OnFamily drawing(0);
        EXPECT_EQ(blended(drawing).technique, Technique::raster);
    }
    OnFamily on(1, {.device_thresholds = {.pairs = 1, .cells = 1}});
    EXPECT_FALSE(blended(on).status.ok());
    auto query = on.query<IntersectionQuery>(Technique::automatic);
    EXPECT_EQ(on.answer(query).technique, Technique::compute);
    query.on_device = true;
    EXPECT_EQ(on.answer(query).technique, Technique::compute);
}

/// The states in which the resident results of a field and of contacts are found.
struct States {
    OutputState images;
    OutputState buffer;
};

States states(OnFamily& on) {
    Batch batch;
    DistanceFieldQuery field = on.query<DistanceFieldQuery>(Technique::compute);
    ContactQuery contacts = on.query<ContactQuery>(Technique::compute);
    field.on_device = contacts.on_device = true;
    contacts.contact_distance = 0.1;
    const auto field_handle = batch.add(field);
    const auto contacts_handle = batch.add(contacts);
    const Expected<Ticket> ticket = on.context().submit(batch);
    EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
    const States found{on.context().on_device(*ticket, field_handle)->state,
                       on.context().on_device(*ticket, contacts_handle)->state};
    Results results;
    EXPECT_TRUE(on.context().collect(*ticket, results).ok());
    return found;
}

TEST(ComputeFamily, LeavesResidentResultsInStagesThatItHas) {
    OnFamily universal_family(0);
    const States drawn = states(universal_family);
    EXPECT_NE(drawn.images.stages & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0U);
    EXPECT_EQ(drawn.images.queue_family, 0U);
}

TEST(ComputeFamily, LeavesResidentResultsToItselfUnlessTold) {
    OnFamily on(1);
    const States found = states(on);
    EXPECT_EQ(found.images.stages, VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT});
    EXPECT_EQ(found.buffer.stages, stages_that_compute);
    EXPECT_EQ(found.buffer.access,
              VkAccessFlags{VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT});
    EXPECT_EQ(found.images.queue_family, 1U);
    EXPECT_EQ(found.buffer.queue_family, 1U);
    EXPECT_EQ(on.driver().shared_objects(), 0U);
}

TEST(ComputeFamily, SharesResidentResultsAndNothingElseWithTheFamiliesNamed) {
    OnFamily on(1, {}, {0, 2, 0, 1});
    const States found = states(on);
    EXPECT_EQ(found.images.queue_family, VK_QUEUE_FAMILY_IGNORED);
    EXPECT_EQ(found.buffer.queue_family, VK_QUEUE_FAMILY_IGNORED);
    EXPECT_EQ(on.driver().shared_objects(), 3U) << "two images and a buffer";
}

TEST(ComputeFamily, RefusesFamiliesThatTheDeviceDoesNotHave) {
    MockDriver driver;
    const std::uint32_t families[] = {0, 5};
    HostDevice host = driver.host();
    host.reader_families = families;
    host.reader_family_count = 2;
    const Status status = Context::create(host).error();
    EXPECT_EQ(status.code(), StatusCode::invalid_settings);
    EXPECT_NE(status.message().find("HostDevice::reader_families[1] is 5"), std::string::npos)
        << status.text();
    host.reader_families = nullptr;
    EXPECT_NE(Context::create(host).error().message().find(
                  "HostDevice::reader_family_count is 2, and reader_families is null"),
              std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
