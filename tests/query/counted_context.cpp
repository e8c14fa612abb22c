#include <tests/query/all_numbers.hpp>
#include <tests/query/counted_context.hpp>

namespace nearfield::test {

Calls calls;

namespace {

constexpr std::uint64_t counted_context_seed = 6000;

template <class Function>
Function below(const char* name) {
    return reinterpret_cast<Function>(test_support::true_device_function(name));
}

VkResult VKAPI_CALL count_submission(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                     VkFence fence) {
    ++calls.submissions;
    return below<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VkResult VKAPI_CALL count_wait(VkDevice device, std::uint32_t count, const VkFence* fences,
                               VkBool32 all, std::uint64_t timeout) {
    ++calls.waits;
    const VkResult result =
        below<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
    return calls.lose_device ? VK_ERROR_DEVICE_LOST : result;
}

void VKAPI_CALL count_render_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                  VkSubpassContents contents) {
    ++calls.render_passes;
    below<PFN_vkCmdBeginRenderPass>("vkCmdBeginRenderPass")(commands, info, contents);
}

void VKAPI_CALL count_draw(VkCommandBuffer commands, std::uint32_t vertices,
                           std::uint32_t instances, std::uint32_t first, std::uint32_t instance) {
    ++calls.draws;
    below<PFN_vkCmdDraw>("vkCmdDraw")(commands, vertices, instances, first, instance);
}

void VKAPI_CALL count_reset(VkCommandBuffer commands, VkQueryPool pool, std::uint32_t first,
                            std::uint32_t count) {
    ++calls.recordings;
    below<PFN_vkCmdResetQueryPool>("vkCmdResetQueryPool")(commands, pool, first, count);
}

void VKAPI_CALL count_label(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    ++calls.recordings;
    below<PFN_vkCmdBeginDebugUtilsLabelEXT>("vkCmdBeginDebugUtilsLabelEXT")(commands, label);
}

test_support::Lies counting() {
    test_support::Lies lies;
    const auto instead = [&lies](const char* name, auto function) {
        lies.entry_points[name] = reinterpret_cast<PFN_vkVoidFunction>(function);
    };
    instead("vkQueueSubmit", &count_submission);
    instead("vkWaitForFences", &count_wait);
    instead("vkCmdBeginRenderPass", &count_render_pass);
    instead("vkCmdDraw", &count_draw);
    instead("vkCmdResetQueryPool", &count_reset);
    instead("vkCmdBeginDebugUtilsLabelEXT", &count_label);
    return lies;
}

Ticket require(const Expected<Ticket>& ticket) {
    EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
    return ticket.has_value() ? *ticket : Ticket{};
}

}  // namespace

void CountedContext::leave() {
    if (counted_) {
        counted_->frame_completed(UINT64_MAX);  // the test has waited for the device
        counted_.reset();
    }
    loader_.reset();
}

void CountedContext::make(const Settings& settings) {
    leave();
    loader_.emplace(host_device(), counting());
    Expected<Context> made = Context::create(loader_->host(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    counted_.emplace(std::move(*made));
    Random random(counted_context_seed);
    rings_a_ = coast(random, 120, 0.5);
    rings_b_ = with_holes(random, 3);
    const Expected<ShapeHandle> a = counted_->add_shape(rings_a_);
    const Expected<ShapeHandle> b = counted_->add_shape(rings_b_);
    ASSERT_TRUE(a.has_value() && b.has_value());
    a_ = *a;
    b_ = *b;
    calls = {};
}

void CountedContext::make(std::uint32_t frames) {
    Settings settings;
    settings.batches_in_flight = frames;
    settings.timestamps = true;
    make(settings);
}

void CountedContext::TearDown() {
    leave();
    QueryTest::TearDown();
}

std::vector<double> CountedContext::run(const Batch& batch) {
    Results results;
    const Status status = counted().run(batch, results);
    EXPECT_TRUE(status.ok()) << status.text();
    expect_answers(results);
    return all_numbers(results);
}

std::vector<double> CountedContext::collect(Ticket ticket) {
    Results results;
    const Status status = counted().collect(ticket, results);
    EXPECT_TRUE(status.ok()) << status.text();
    return all_numbers(results);
}

Ticket CountedContext::submit(const Batch& batch) {
    return require(counted().submit(batch));
}

Ticket CountedContext::record(const Batch& batch, VkCommandBuffer commands, std::uint64_t frame) {
    return require(counted().record(batch, {.commands = commands, .frame = frame}));
}

}  // namespace nearfield::test
