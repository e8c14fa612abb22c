#include <engine/base/status_exception.hpp>
#include <engine/batch/call_within.hpp>
#include <engine/batch/context_implementation.hpp>
#include <engine/gpu/submission.hpp>
#include <nearfield/host.hpp>

#include <string>
#include <utility>

namespace nearfield {
namespace {

/// The region that rings enclose, for a shape, with the sum of the deviations; a bad one of the
/// rings stays as it is, to be refused.
Expected<ResolvedFill> filled(std::span<const Ring> rings, FillRule rule, double deviation) {
    Expected<ResolvedFill> fill = resolve_fill(rings, rule);
    if (!fill.has_value()) {
        return fill;
    }
    if (fill->rings.empty()) {
        return Status(StatusCode::invalid_shape, "the rings enclose nothing by their fill rule");
    }
    fill->deviation = deviation < 0.0 ? deviation : fill->deviation + deviation;
    return fill;
}

[[noreturn]] void refuse_setting(const std::string& message) {
    throw StatusException({StatusCode::invalid_settings, message});
}

void check_jobs(const JobSystem& jobs) {
    const std::string count = "Settings::jobs.count is " + std::to_string(jobs.count);
    if (jobs.run == nullptr && jobs.count > 0) {
        refuse_setting(count + ", and run is null");
    }
    if (jobs.run != nullptr && (jobs.count < 1 || jobs.count > max_jobs)) {
        refuse_setting(count + "; it must be at least 1 and at most " + std::to_string(max_jobs));
    }
}

/// Two functions of a host that belong together.
void check_both(const char* member, bool first, const char* first_name, bool second,
                const char* second_name) {
    if (first != second) {
        refuse_setting(std::string("HostDevice::") + member + "." +
                       (first ? second_name : first_name) + " is null, and " +
                       (first ? first_name : second_name) + " is set; give both or neither");
    }
}

// Each throws StatusException (invalid_settings) that names the structure and the unusable member.

void check_structure(const HostDevice& host) {
    const QueueAccess& access = host.queue_access;
    check_both("queue_access", access.lock != nullptr, "lock", access.unlock != nullptr, "unlock");
    const MemoryFunctions& memory = host.memory;
    check_both("memory", memory.allocate != nullptr, "allocate", memory.free != nullptr, "free");
    if (host.reader_families == nullptr && host.reader_family_count > 0) {
        refuse_setting("HostDevice::reader_family_count is " +
                       std::to_string(host.reader_family_count) + ", and reader_families is null");
    }
    if (host.completion_by_timeline && !host.timeline_semaphore) {
        refuse_setting(
            "HostDevice::completion_by_timeline is set, and timeline_semaphore is not: the host "
            "has to enable the feature");
    }
}

void check_structure(const Settings& settings) {
    if (settings.batches_in_flight < 1 || settings.batches_in_flight > max_batches_in_flight) {
        refuse_setting("batches_in_flight is " + std::to_string(settings.batches_in_flight) +
                       "; it must be at least 1 and at most " +
                       std::to_string(max_batches_in_flight));
    }
    if (settings.bounding_volume != BoundingVolume::axis_aligned &&
        settings.bounding_volume != BoundingVolume::oriented) {
        refuse_setting("Settings::bounding_volume is no enumerator: " +
                       std::to_string(static_cast<int>(settings.bounding_volume)));
    }
    check_jobs(settings.jobs);
}

}  // namespace

Context::Context(std::shared_ptr<Implementation> implementation) noexcept
    : implementation_(std::move(implementation)) {}
Context::Context() noexcept : implementation_(std::make_shared<Implementation>(Settings())) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

Expected<Context> Context::create(const HostDevice& host, const Settings& settings) {
    return catch_to_expected([&] {
        check_structure(host);
        check_structure(settings);
        return Context(std::make_shared<Implementation>(nullptr, host, settings));
    });
}

Expected<Context> Context::create_headless(const HeadlessOptions& options,
                                           const Settings& settings) {
    return catch_to_expected([&] {
        check_structure(settings);
        auto own = std::make_unique<gpu::HeadlessDevice>(options);
        const HostDevice host = own->host();
        return Context(std::make_shared<Implementation>(std::move(own), host, settings));
    });
}

Expected<Context> Context::create_cpu(const Settings& settings) {
    return catch_to_expected([&] {
        check_structure(settings);
        return Context(std::make_shared<Implementation>(settings));
    });
}

AddedShape Context::add_shape(std::span<const Ring> rings, double deviation) {
    return implementation_->add_shape(
        [&] { return implementation_->shapes().add(rings, deviation); });
}

Status Context::update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation) {
    return implementation_->unless_lost(
        [&] { return implementation_->shapes().update(shape, rings, deviation); });
}

AddedShape Context::add_shape(std::span<const RingView> rings, double deviation) {
    return implementation_->add_shape(
        [&] { return implementation_->shapes().add(implementation_->gather(rings), deviation); });
}

Status Context::update_shape(ShapeHandle shape, std::span<const RingView> rings, double deviation) {
    return implementation_->unless_lost([&] {
        return implementation_->shapes().update(shape, implementation_->gather(rings), deviation);
    });
}

AddedShape Context::add_shape(std::span<const Ring> rings, FillRule rule, double deviation) {
    return implementation_->add_shape([&]() -> Expected<ShapeHandle> {
        const Expected<ResolvedFill> fill = filled(rings, rule, deviation);
        return fill.has_value() ? implementation_->shapes().add(fill->rings, fill->deviation)
                                : fill.error();
    });
}

Status Context::update_shape(ShapeHandle shape, std::span<const Ring> rings, FillRule rule,
                             double deviation) {
    const Expected<ResolvedFill> fill = filled(rings, rule, deviation);
    return fill.has_value() ? update_shape(shape, fill->rings, fill->deviation) : fill.error();
}

Status Context::remove_shape(ShapeHandle shape) {
    return implementation_->unless_lost([&] { return implementation_->shapes().remove(shape); });
}

Expected<std::span<const InstancePair>> Context::find_overlapping_boxes(
    std::span<const Instance> instances, double reach) {
    return implementation_->unless_lost(
        [&] { return implementation_->find_overlapping_boxes(instances, reach); });
}

Status Context::run(const Batch& batch, Results& results, const Limits& limits) {
    return call_within(limits, [&] {
        return implementation_->unless_lost([&] { implementation_->ring().run(batch, results); });
    });
}

Expected<Ticket> Context::submit(const Batch& batch, const Limits& limits) {
    return submit(batch, Submission(), limits);
}

Expected<Ticket> Context::submit(const Batch& batch, const Submission& submission,
                                 const Limits& limits) {
    return call_within(limits, [&] {
        return implementation_->unless_lost([&] {
            if (const gpu::Device* const device = implementation_->device(); device != nullptr) {
                gpu::check_semaphores(*device, submission);
            } else if (!submission.waits.empty() || !submission.signals.empty()) {
                throw StatusException(no_device("submit with semaphores"));
            }
            return implementation_->ring().submit(batch, submission);
        });
    });
}

Expected<Ticket> Context::record(const Batch& batch, const Recording& recording,
                                 const Limits& limits) {
    return call_within(limits, [&]() -> Expected<Ticket> {
        if (implementation_->device() == nullptr) {
            return no_device("record");
        }
        return implementation_->unless_lost(
            [&] { return implementation_->ring().record(batch, recording); });
    });
}

void Context::frame_completed(std::uint64_t frame) noexcept {
    implementation_->ring().complete(frame);
}

bool Context::is_ready(Ticket ticket) {
    return implementation_->is_lost() || implementation_->ring().is_ready(ticket);
}

Status Context::collect(Ticket ticket, Results& results, const Limits& limits) {
    return call_within(limits, [&] {
        if (implementation_->is_lost()) {
            Status status = catch_to_status([&] { implementation_->ring().drop(ticket); });
            return status.ok() ? implementation_->lost_device() : status;
        }
        return implementation_->unless_lost(
            [&] { implementation_->ring().collect(ticket, results); });
    });
}

Expected<FieldOnDevice> Context::on_device(Ticket ticket, QueryHandle<DistanceFieldQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().on_device(ticket, query); });
}

Expected<PointsOnDevice> Context::on_device(Ticket ticket, QueryHandle<PenetrationQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().on_device(ticket, query); });
}

Expected<PointsOnDevice> Context::on_device(Ticket ticket, QueryHandle<ContactQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().on_device(ticket, query); });
}

Expected<SamplesOnDevice> Context::on_device(Ticket ticket, QueryHandle<IntersectionQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().on_device(ticket, query); });
}

Expected<FieldGrid> Context::field_grid(const DistanceFieldQuery& query) const {
    return catch_to_expected([&] { return implementation_->ring().field_grid(query); });
}

Expected<std::uint64_t> Context::target_size(const PenetrationQuery& query) const {
    return catch_to_expected([&] { return implementation_->ring().target_size(query); });
}

Expected<std::uint64_t> Context::target_size(const ContactQuery& query) const {
    return catch_to_expected([&] { return implementation_->ring().target_size(query); });
}

Expected<std::uint64_t> Context::target_size(const IntersectionQuery& query) const {
    return catch_to_expected([&] { return implementation_->ring().target_size(query); });
}

Expected<std::vector<FieldOnDevice>> Context::layout_on_device(
    const Batch& batch, QueryHandle<DistanceFieldQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().layout_on_device(batch, query); });
}

Expected<std::vector<PointsOnDevice>> Context::layout_on_device(
    const Batch& batch, QueryHandle<PenetrationQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().layout_on_device(batch, query); });
}

Expected<std::vector<PointsOnDevice>> Context::layout_on_device(const Batch& batch,
                                                                QueryHandle<ContactQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().layout_on_device(batch, query); });
}

Expected<std::vector<SamplesOnDevice>> Context::layout_on_device(
    const Batch& batch, QueryHandle<IntersectionQuery> query) {
    return implementation_->unless_lost(
        [&] { return implementation_->ring().layout_on_device(batch, query); });
}

void Context::trim() noexcept {
    if (implementation_->device() != nullptr && !implementation_->is_lost()) {
        implementation_->ring().trim();
        implementation_->renderer()->trim();
    }
}

const std::string& Context::device_name() const noexcept {
    static const std::string none;
    const gpu::Device* const device = implementation_->device();
    return device == nullptr ? none : device->name();
}

MemoryUse Context::memory_use() const noexcept {
    const gpu::Device* const device = implementation_->device();
    if (device == nullptr) {
        return {};
    }
    return {device->memory_count().in_use(), device->memory_count().peak()};
}

}  // namespace nearfield
