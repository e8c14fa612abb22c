#include <engine/base/catch_to_status.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/batch/batch_ring.hpp>
#include <engine/context/calibration.hpp>
#include <engine/context/read_structures.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/localize/broad_phase.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/select/default_costs.hpp>
#ifdef NEARFIELD_SHADER_RELOAD
#include <engine/reload/shader_reload.hpp>
#endif
#include <engine/base/stopwatch.hpp>
#include <engine/batch/shape_store.hpp>
#include <engine/render/renderer.hpp>
#include <nearfield/context.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nearfield {
namespace {

geometry::SubpixelGrid subpixel_grid(const gpu::Device& device) {
    return {std::ldexp(1.0, static_cast<int>(device.limits().subPixelPrecisionBits))};
}

/// `device` is null for a context without one.
plan::PlanLimits plan_limits(const gpu::Device* device, const Settings& settings) {
    plan::PlanLimits limits;
    limits.memory = settings.memory_limit;
    limits.hierarchy_height = settings.hierarchy_height;
    limits.bounding_volume = settings.bounding_volume;
    limits.techniques = {true, settings.techniques.raster, settings.techniques.compute};
    if (device == nullptr) {
        limits.techniques.device = false;
        return limits;
    }
    limits.subpixel = subpixel_grid(*device);
    limits.largest_atlas = std::min(limits.largest_atlas, device->limits().maxImageDimension2D);
    limits.largest_image = device->limits().maxImageDimension2D;
    limits.largest_range = device->limits().maxStorageBufferRange;
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        limits.missing_for_strategy[i] =
            gpu::missing_for(static_cast<IntersectionStrategy>(i), device->strategy_support());
    }
    return limits;
}

CostModel costs_of(const gpu::Device* device, const Settings& settings) {
    return settings.costs.value_or(default_costs(device == nullptr || device->is_software()
                                                     ? select::DeviceClass::software
                                                     : select::DeviceClass::hardware));
}

Settings without_device(Settings settings) {
    settings.techniques = {.raster = false, .compute = false};
    return settings;
}

Status no_device(const char* call) {
    return {StatusCode::no_device,
            std::string(call) + ": this context has no device (Context::create_cpu)"};
}

Status lost_device() {
    return {StatusCode::device_lost,
            "the device was lost in an earlier batch; destroy this context and make another"};
}

}  // namespace

class Context::Implementation {
    /// Everything made from pipelines, and the memory they work on.
    struct Machinery {
        Machinery(const gpu::Device* device, const Settings& settings, const CostModel& costs,
                  batch::ShapeStore& shapes)
            : renderer(device == nullptr
                           ? nullptr
                           : std::make_unique<render::Renderer>(*device, settings.techniques)),
              ring(settings.batches_in_flight, plan_limits(device, settings), costs, settings.jobs,
                   renderer.get(), shapes) {}

        std::unique_ptr<render::Renderer> renderer;  // null without a device
        batch::BatchRing ring;
    };

public:
    /// Without a device.
    explicit Implementation(const Settings& settings)
        : settings_(without_device(settings)),
          costs_(costs_of(nullptr, settings)),
          machinery_(make_machinery()) {}
    /// On the host's device, or on the context's own, which `host` then describes.
    Implementation(std::unique_ptr<gpu::HeadlessDevice> own, const HostDevice& host,
                   const Settings& settings)
        : own_device_(std::move(own)),
          device_(std::make_unique<gpu::Device>(host)),
          settings_(settings),
          costs_(costs_of(device_.get(), settings)),
          machinery_(make_machinery()) {
        device_->log(LogLevel::information, [&] {
            return "context on '" + device_->name() + "' made in " +
                   std::to_string(making_.milliseconds()) + " ms, for " +
                   std::to_string(settings.batches_in_flight) + " frames in flight";
        });
    }
    ~Implementation() {
        if (device_ != nullptr) {
            device_->log(LogLevel::information, [&] {
                return "context on '" + device_->name() + "' goes; it took at most " +
                       std::to_string(device_->memory_count().peak()) + " bytes of device memory";
            });
        }
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    Status find_pairs(std::span<const Instance> instances, double reach,
                      std::vector<InstancePair>& pairs);
    Expected<Ticket> submit(const Batch& batch, const Submission& submission, Results* memory);
    Expected<Ticket> record(const Batch& batch, const Recording& recording);
    void frame_completed(std::uint64_t frame) { machinery_->ring.complete(frame); }
    bool is_ready(Ticket ticket) { return lost_ || machinery_->ring.is_ready(ticket); }
    Status collect(Ticket ticket, Results& results);

    template <class Resident, class Query>
    Expected<Resident> resident(Ticket ticket, QueryHandle<Query> query) {
        Resident result;
        Status status = unless_lost([&] { result = machinery_->ring.resident(ticket, query); });
        return status.ok() ? Expected<Resident>(result) : status;
    }

    void list_tiles(std::vector<TileReport>& tiles) const { machinery_->ring.list_tiles(tiles); }

    [[nodiscard]] batch::ShapeStore& shapes() { return shapes_; }
    /// Null without a device, as the renderer is.
    [[nodiscard]] const gpu::Device* device() const { return device_.get(); }
    [[nodiscard]] const CostModel& costs() const { return costs_; }
    [[nodiscard]] const DeviceTechniques& techniques() const { return settings_.techniques; }
    [[nodiscard]] const render::Renderer* renderer() const { return machinery_->renderer.get(); }

    /// Runs an action unless the device is lost; records the loss of the device.
    template <class Action>
    Status unless_lost(Action&& action) noexcept {
        if (lost_) {
            return lost_device_;
        }
        Status status = catch_to_status(action);
        if (status.code() == StatusCode::device_lost) {
            lost_ = true;
            device_->log(LogLevel::error,
                         [&] { return "the device is lost: " + status.message(); });
        }
        return status;
    }

#ifdef NEARFIELD_SHADER_RELOAD
    std::uint32_t reload_shaders(const char* folder);
#endif

private:
    [[nodiscard]] std::unique_ptr<Machinery> make_machinery() {
        return std::make_unique<Machinery>(device_.get(), settings_, costs_, shapes_);
    }

    Stopwatch making_;
    std::unique_ptr<gpu::HeadlessDevice> own_device_;  // null where the host's is used
    std::unique_ptr<gpu::Device> device_;              // null in a context without one
    const Settings settings_;
    CostModel costs_;
    batch::ShapeStore shapes_;
    localize::BroadPhase broad_phase_;
    std::vector<geometry::Box> boxes_;
    std::vector<localize::BroadPhase::Pair> box_pairs_;
    std::unique_ptr<Machinery> machinery_;
#ifdef NEARFIELD_SHADER_RELOAD
    std::optional<reload::ShaderReload> reload_;
#endif
    const Status lost_device_ = lost_device();  // made in advance: returning it needs no memory
    bool lost_ = false;
};

Status Context::Implementation::find_pairs(std::span<const Instance> instances, double reach,
                                           std::vector<InstancePair>& pairs) {
    if (!(reach >= 0.0 && reach <= largest_coordinate)) {
        return {StatusCode::invalid_query, "find_pairs: the reach is " + plan::number(reach) +
                                               "; it must be a finite number of at least 0"};
    }
    boxes_.clear();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const geometry::Polygon* const polygon = shapes_.find(instances[i].shape);
        Status status = polygon == nullptr
                            ? Status(StatusCode::unknown_shape, "its shape is none of this context")
                            : plan::check_pose(instances[i].pose, "the instance");
        if (!status.ok()) {
            return {status.code(),
                    "find_pairs: instance " + std::to_string(i) + ": " + status.message()};
        }
        boxes_.push_back(geometry::TransformedPolygon(*polygon, instances[i].pose).box());
    }
    broad_phase_.find(boxes_, reach, box_pairs_);
    pairs.clear();
    for (const auto& [first, second] : box_pairs_) {
        pairs.push_back({first, second});
    }
    return {};
}

Expected<Ticket> Context::Implementation::submit(const Batch& batch, const Submission& submission,
                                                 Results* memory) {
    Ticket ticket;
    Status status = unless_lost([&] {
        const Submission order = read_versioned(submission);
        if (device_ != nullptr) {
            gpu::check_semaphores(*device_, order);
        } else if (!order.waits.empty() || !order.signals.empty()) {
            throw StatusException(no_device("submit with semaphores"));
        }
        ticket = machinery_->ring.submit(batch.queries(), order, memory);
    });
    return status.ok() ? Expected<Ticket>(ticket) : status;
}

Expected<Ticket> Context::Implementation::record(const Batch& batch, const Recording& recording) {
    if (device_ == nullptr) {
        return no_device("record");
    }
    Ticket ticket;
    Status status = unless_lost(
        [&] { ticket = machinery_->ring.record(batch.queries(), read_versioned(recording)); });
    return status.ok() ? Expected<Ticket>(ticket) : status;
}

Status Context::Implementation::collect(Ticket ticket, Results& results) {
    if (lost_) {
        Status status = catch_to_status([&] { machinery_->ring.drop(ticket); });
        return status.ok() ? lost_device_ : status;
    }
    return unless_lost([&] { machinery_->ring.collect(ticket, results); });
}

#ifdef NEARFIELD_SHADER_RELOAD
std::uint32_t Context::Implementation::reload_shaders(const char* folder) {
    if (device_ == nullptr) {
        throw StatusException(no_device("reload_shaders"));
    }
    machinery_->ring.require_none_in_flight("reload_shaders");
    if (!reload_) {
        reload_.emplace(*device_);
    }
    const std::uint32_t changed = reload_->compile_changed(folder);
    if (changed > 0) {
        try {
            auto other = make_machinery();
            other->ring.count_on_from(machinery_->ring);
            machinery_ = std::move(other);
        } catch (...) {
            reload_->take_back();
            throw;
        }
    }
    return changed;
}
#endif

Context::Context(std::unique_ptr<Implementation> implementation) noexcept
    : implementation_(std::move(implementation)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

Expected<Context> Context::create(const HostDevice& host, const Settings& settings) {
    std::unique_ptr<Implementation> implementation;
    Status status = catch_to_status([&] {
        implementation = std::make_unique<Implementation>(nullptr, read_versioned(host),
                                                          read_versioned(settings));
    });
    if (!status.ok()) {
        return status;
    }
    return Context(std::move(implementation));
}

Expected<Context> Context::create_headless(const HeadlessOptions& options,
                                           const Settings& settings) {
    std::unique_ptr<Implementation> implementation;
    Status status = catch_to_status([&] {
        const Settings own_settings = read_versioned(settings);
        auto own = std::make_unique<gpu::HeadlessDevice>(read_versioned(options));
        const HostDevice host = own->host();
        implementation = std::make_unique<Implementation>(std::move(own), host, own_settings);
    });
    if (!status.ok()) {
        return status;
    }
    return Context(std::move(implementation));
}

Expected<Context> Context::create_cpu(const Settings& settings) {
    std::unique_ptr<Implementation> implementation;
    Status status = catch_to_status(
        [&] { implementation = std::make_unique<Implementation>(read_versioned(settings)); });
    if (!status.ok()) {
        return status;
    }
    return Context(std::move(implementation));
}

Expected<ShapeHandle> Context::add_shape(std::span<const Ring> rings, double deviation) {
    Expected<ShapeHandle> handle = ShapeHandle{};
    Status status = implementation_->unless_lost(
        [&] { handle = implementation_->shapes().add(rings, deviation); });
    return status.ok() ? handle : Expected<ShapeHandle>(status);
}

Status Context::update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation) {
    Status result;
    Status status = implementation_->unless_lost(
        [&] { result = implementation_->shapes().update(shape, rings, deviation); });
    return status.ok() ? result : status;
}

Status Context::remove_shape(ShapeHandle shape) {
    Status result;
    Status status =
        implementation_->unless_lost([&] { result = implementation_->shapes().remove(shape); });
    return status.ok() ? result : status;
}

Status Context::find_pairs(std::span<const Instance> instances, double reach,
                           std::vector<InstancePair>& pairs) {
    Status result;
    Status status = implementation_->unless_lost(
        [&] { result = implementation_->find_pairs(instances, reach, pairs); });
    return status.ok() ? result : status;
}

Status Context::run(const Batch& batch, Results& results) {
    const Expected<Ticket> ticket = implementation_->submit(batch, {}, &results);
    return ticket.ok() ? implementation_->collect(*ticket, results) : ticket.status();
}

Expected<Ticket> Context::submit(const Batch& batch, const Submission& submission) {
    return implementation_->submit(batch, submission, nullptr);
}

Expected<Ticket> Context::record(const Batch& batch, const Recording& recording) {
    return implementation_->record(batch, recording);
}

void Context::frame_completed(std::uint64_t frame) noexcept {
    implementation_->frame_completed(frame);
}

bool Context::is_ready(Ticket ticket) {
    return implementation_->is_ready(ticket);
}

Status Context::collect(Ticket ticket, Results& results) {
    return implementation_->collect(ticket, results);
}

Expected<ResidentField> Context::resident(Ticket ticket, QueryHandle<DistanceFieldQuery> query) {
    return implementation_->resident<ResidentField>(ticket, query);
}

Expected<ResidentRecords> Context::resident(Ticket ticket, QueryHandle<PenetrationQuery> query) {
    return implementation_->resident<ResidentRecords>(ticket, query);
}

Expected<ResidentRecords> Context::resident(Ticket ticket, QueryHandle<ContactQuery> query) {
    return implementation_->resident<ResidentRecords>(ticket, query);
}

Expected<ResidentSamples> Context::resident(Ticket ticket, QueryHandle<IntersectionQuery> query) {
    return implementation_->resident<ResidentSamples>(ticket, query);
}

Expected<CostModel> Context::measure_costs(const std::function<void(double)>& progress) {
    CostModel costs;
    Status status = implementation_->unless_lost(
        [&] { costs = nearfield::measure_costs(*this, implementation_->techniques(), progress); });
    return status.ok() ? Expected<CostModel>(costs) : status;
}

const CostModel& Context::costs() const noexcept {
    return implementation_->costs();
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

std::string Context::describe_graph(GraphFormat format) const {
    std::string text;
    const Status status = catch_to_status([&] {
        if (format != GraphFormat::text && format != GraphFormat::graphviz) {
            throw StatusException(
                {StatusCode::invalid_settings, "the format of a graph is no enumerator: " +
                                                   std::to_string(static_cast<int>(format))});
        }
        if (const render::Renderer* const renderer = implementation_->renderer();
            renderer != nullptr) {
            text = renderer->print(format);
        }
    });
    if (!status.ok()) {
        static_cast<void>(catch_to_status([&] { text = status.text(); }));
    }
    return text;
}

Expected<std::uint32_t> Context::reload_shaders([[maybe_unused]] const char* folder) {
#ifdef NEARFIELD_SHADER_RELOAD
    std::uint32_t changed = 0;
    Status status =
        implementation_->unless_lost([&] { changed = implementation_->reload_shaders(folder); });
    return status.ok() ? Expected<std::uint32_t>(changed) : status;
#else
    return Status(StatusCode::unavailable,
                  "shaders cannot be reloaded: the library was built without the CMake option "
                  "NEARFIELD_SHADER_RELOAD");
#endif
}

Status Context::list_tiles(std::vector<TileReport>& tiles) const {
    return catch_to_status([&] { implementation_->list_tiles(tiles); });
}

}  // namespace nearfield
