#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/host_table.hpp>

#include <stdexcept>

namespace nearfield::test {
namespace {

using test_support::HostFrames;

constexpr std::uint64_t host_table_seed = 8000;

}  // namespace

Scene::Scene(Context& owner) : context(&owner) {
    Random random(host_table_seed);
    const Expected<ShapeHandle> first = owner.add_shape(coast(random, 100, 0.5));
    const Expected<ShapeHandle> second = owner.add_shape(with_holes(random, 3));
    EXPECT_TRUE(first.has_value() && second.has_value());
    a = *first;
    b = *second;
}

Batch Scene::every() const {
    return every_query(a, b, 0);
}

Batch Scene::small(double tolerance) const {
    Batch batch;
    IntersectionQuery query{{a, {}}, {b, {}}, tolerance};
    query.summary_only = true;
    query.technique = device_techniques.front();
    batch.add(query);
    return batch;
}

Batch Scene::on_cpu() const {
    Batch batch;
    batch.add(SeparationQuery{{a, {}}, {b, {{3.0, 0.0}, 0.0}}, 0.1, Technique::cpu});
    return batch;
}

std::vector<double> Scene::run(const Batch& batch) const {
    Results results;
    const Status status = context->run(batch, results);
    EXPECT_TRUE(status.ok()) << status.text();
    expect_answers(results);
    return all_numbers(results);
}

std::vector<double> Scene::collect(const Expected<Ticket>& ticket) const {
    EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
    if (!ticket) {
        return {};
    }
    Results results;
    const Status status = context->collect(*ticket, results);
    EXPECT_TRUE(status.ok()) << status.text();
    expect_answers(results);
    return all_numbers(results);
}

std::vector<double> Scene::record(const Batch& batch, HostFrames& host, std::uint64_t frame) const {
    const Expected<Ticket> ticket =
        context->record(batch, {.commands = host.begin(frame), .frame = frame});
    host.submit(frame);
    host.wait(frame);
    context->frame_completed(frame);
    return collect(ticket);
}

Context HostTable::make(const HostDevice& device, std::uint32_t frames) {
    Settings settings;
    settings.batches_in_flight = frames;
    settings.timestamps = true;
    Expected<Context> made = Context::create(device, on_demand(settings));
    if (!made) {
        throw std::runtime_error(made.error().text());
    }
    return std::move(*made);
}

void expect_timelines_refused(Context& context, const Batch& batch) {
    const SemaphoreSignal timeline{reinterpret_cast<VkSemaphore>(std::uintptr_t{1}), 7};
    const Status refused = context.submit(batch, {.signals = {&timeline, 1}}).error();
    EXPECT_EQ(refused.code(), StatusCode::invalid_submission);
    EXPECT_NE(refused.message().find("Submission::signals[0].value"), std::string::npos);
    EXPECT_NE(refused.message().find("HostDevice::timeline_semaphore"), std::string::npos);
}

namespace {

std::set<std::string>* names_asked = nullptr;
PFN_vkGetInstanceProcAddr true_get_instance = nullptr;
PFN_vkGetDeviceProcAddr true_get_device = nullptr;

PFN_vkVoidFunction VKAPI_CALL asked_of_device(VkDevice device, const char* name) {
    names_asked->insert(name);
    return true_get_device(device, name);
}

PFN_vkVoidFunction VKAPI_CALL asked_of_instance(VkInstance instance, const char* name) {
    names_asked->insert(name);
    if (std::string(name) == "vkGetDeviceProcAddr") {
        return reinterpret_cast<PFN_vkVoidFunction>(&asked_of_device);
    }
    return true_get_instance(instance, name);
}

}  // namespace

HostDevice noting_names(const HostDevice& host, std::set<std::string>& names) {
    names_asked = &names;
    true_get_instance = host.get_instance_proc_addr;
    true_get_device =
        test_support::host_function<PFN_vkGetDeviceProcAddr>(host, "vkGetDeviceProcAddr");
    HostDevice noting = host;
    noting.get_instance_proc_addr = &asked_of_instance;
    return noting;
}

}  // namespace nearfield::test
