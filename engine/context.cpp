#include <engine/batch_runner.hpp>
#include <engine/failure.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>
#include <engine/gradient_normals.hpp>
#include <engine/graph/format.hpp>
#include <engine/localize/broad_phase.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/renderer.hpp>
#include <engine/stopwatch.hpp>
#include <nearfield/context.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>
#include <vector>

namespace nearfield {
namespace {

/// Turns whatever an action throws into a status: no exception crosses the interface.
template <class Action>
Status guarded(Action&& action) {
    try {
        action();
        return {};
    } catch (const Failure& failure) {
        return failure.status();
    } catch (const std::bad_alloc&) {
        return {StatusCode::out_of_memory, "the host has no memory left"};
    } catch (const std::exception& error) {
        return {StatusCode::device_error, error.what()};
    }
}

geometry::SubpixelGrid subpixel_grid(const gpu::Device& device) {
    return {std::ldexp(1.0, static_cast<int>(device.limits().subPixelPrecisionBits))};
}

plan::PlanLimits plan_limits(const gpu::Device& device, const Settings& settings) {
    plan::PlanLimits limits;
    limits.subpixel = subpixel_grid(device);
    limits.largest_atlas = std::min(limits.largest_atlas, device.limits().maxImageDimension2D);
    limits.memory = settings.memory_limit;
    limits.hierarchy_height = settings.hierarchy_height;
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        limits.missing_for_strategy[i] =
            gpu::missing_for(static_cast<IntersectionStrategy>(i), device.strategy_support());
    }
    limits.bounding_volume = settings.bounding_volume;
    return limits;
}

const char* gradient_format(const gpu::Device& device) {
    return graph::find_format(device.gradient_format())->name;
}

}  // namespace

class Context::Implementation {
public:
    Implementation(std::unique_ptr<gpu::HeadlessDevice> own, const HostDevice& host,
                   const Settings& settings)
        : own_device_(std::move(own)),
          device_(host),
          renderer_(device_),
          runner_(plan_limits(device_, settings), gradient_format(device_), renderer_),
          normals_(plan_limits(device_, settings), gradient_format(device_), renderer_) {}

    Expected<ShapeHandle> add_shape(std::span<const Ring> rings, double deviation);
    Status update_shape(ShapeHandle handle, std::span<const Ring> rings, double deviation);
    Status remove_shape(ShapeHandle handle);
    Status find_pairs(std::span<const Instance> instances, double reach,
                      std::vector<InstancePair>& pairs);
    Status run(const Batch& batch, Results& results);

    [[nodiscard]] const gpu::Device& device() const { return device_; }
    [[nodiscard]] const Renderer& renderer() const { return renderer_; }

private:
    struct Slot {
        // Kept on removal, so that the next shape in this slot reuses its memory.
        std::unique_ptr<geometry::Polygon> polygon = std::make_unique<geometry::Polygon>();
        std::uint32_t generation = 0;
        bool alive = false;
    };

    [[nodiscard]] geometry::Polygon* find(ShapeHandle handle);
    void run_batch(const Batch& batch, Results& results);

    std::unique_ptr<gpu::HeadlessDevice> own_device_;  // null where the host's is used
    gpu::Device device_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_slots_;
    localize::BroadPhase broad_phase_;
    std::vector<geometry::Box> boxes_;
    std::vector<localize::BroadPhase::Pair> box_pairs_;
    Renderer renderer_;
    BatchRunner runner_;
    GradientNormals normals_;
    bool lost_ = false;
};

geometry::Polygon* Context::Implementation::find(ShapeHandle handle) {
    if (handle.index >= slots_.size()) {
        return nullptr;
    }
    Slot& slot = slots_[handle.index];
    return slot.alive && slot.generation == handle.generation ? slot.polygon.get() : nullptr;
}

Expected<ShapeHandle> Context::Implementation::add_shape(std::span<const Ring> rings,
                                                         double deviation) {
    if (free_slots_.empty()) {
        free_slots_.push_back(static_cast<std::uint32_t>(slots_.size()));
        slots_.emplace_back();
    }
    const std::uint32_t index = free_slots_.back();
    Slot& slot = slots_[index];
    if (Status status = slot.polygon->assign(rings, deviation); !status.ok()) {
        return status;
    }
    free_slots_.pop_back();
    slot.alive = true;
    return ShapeHandle{index, slot.generation};
}

Status Context::Implementation::update_shape(ShapeHandle handle, std::span<const Ring> rings,
                                             double deviation) {
    geometry::Polygon* polygon = find(handle);
    if (polygon == nullptr) {
        return {StatusCode::unknown_shape, "update_shape: no shape of this context has index " +
                                               std::to_string(handle.index) +
                                               " and that generation"};
    }
    return polygon->assign(rings, deviation);
}

Status Context::Implementation::remove_shape(ShapeHandle handle) {
    if (find(handle) == nullptr) {
        return {StatusCode::unknown_shape, "remove_shape: no shape of this context has index " +
                                               std::to_string(handle.index) +
                                               " and that generation"};
    }
    free_slots_.push_back(handle.index);
    Slot& slot = slots_[handle.index];
    slot.alive = false;
    ++slot.generation;
    return {};
}

Status Context::Implementation::find_pairs(std::span<const Instance> instances, double reach,
                                           std::vector<InstancePair>& pairs) {
    if (!(reach >= 0.0 && reach <= largest_coordinate)) {
        return {StatusCode::invalid_query, "find_pairs: the reach is " + plan::number(reach) +
                                               "; it must be a finite number of at least 0"};
    }
    boxes_.clear();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const geometry::Polygon* const polygon = find(instances[i].shape);
        Status status = polygon == nullptr
                            ? Status(StatusCode::unknown_shape, "its shape is none of this context")
                            : plan::check_pose(instances[i].pose, "the instance");
        if (!status.ok()) {
            return {status.code(),
                    "find_pairs: instance " + std::to_string(i) + ": " + status.message()};
        }
        boxes_.push_back(geometry::PlacedPolygon(*polygon, instances[i].pose).box());
    }
    broad_phase_.find(boxes_, reach, box_pairs_);
    pairs.clear();
    for (const auto& [first, second] : box_pairs_) {
        pairs.push_back({first, second});
    }
    return {};
}

Status Context::Implementation::run(const Batch& batch, Results& results) {
    if (lost_) {
        return {StatusCode::device_lost,
                "the device was lost in an earlier batch; destroy this context and make another"};
    }
    Status status = guarded([&] { run_batch(batch, results); });
    std::erase_if(results.timings.passes,
                  [](const PassTime& pass) { return pass.milliseconds < 0.0; });
    lost_ = status.code() == StatusCode::device_lost;
    return status;
}

void Context::Implementation::run_batch(const Batch& batch, Results& results) {
    const Stopwatch start;
    Timings& timings = results.timings;
    timings.localize = timings.plan = timings.record = timings.device = timings.decode = 0.0;
    // Names stay, so that a frame like the one before allocates nothing; run() drops those of
    // passes that have not run.
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = -1.0;
    }
    const plan::FindShape find_shape = [this](ShapeHandle handle) { return find(handle); };
    runner_.run(batch.queries(), find_shape, results);
    normals_.apply(runner_, find_shape, results);
    timings.total = start.milliseconds();
}

Context::Context(std::unique_ptr<Implementation> implementation) noexcept
    : implementation_(std::move(implementation)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

Expected<Context> Context::create(const HostDevice& host, const Settings& settings) {
    std::unique_ptr<Implementation> implementation;
    Status status = guarded(
        [&] { implementation = std::make_unique<Implementation>(nullptr, host, settings); });
    if (!status.ok()) {
        return status;
    }
    return Context(std::move(implementation));
}

Expected<Context> Context::create_headless(const HeadlessOptions& options,
                                           const Settings& settings) {
    std::unique_ptr<Implementation> implementation;
    Status status = guarded([&] {
        auto own = std::make_unique<gpu::HeadlessDevice>(options);
        const HostDevice host = own->host();
        implementation = std::make_unique<Implementation>(std::move(own), host, settings);
    });
    if (!status.ok()) {
        return status;
    }
    return Context(std::move(implementation));
}

Expected<ShapeHandle> Context::add_shape(std::span<const Ring> rings, double deviation) {
    Expected<ShapeHandle> handle = ShapeHandle{};
    Status status = guarded([&] { handle = implementation_->add_shape(rings, deviation); });
    return status.ok() ? handle : Expected<ShapeHandle>(status);
}

Status Context::update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation) {
    Status result;
    Status status =
        guarded([&] { result = implementation_->update_shape(shape, rings, deviation); });
    return status.ok() ? result : status;
}

Status Context::remove_shape(ShapeHandle shape) {
    Status result;
    Status status = guarded([&] { result = implementation_->remove_shape(shape); });
    return status.ok() ? result : status;
}

Status Context::find_pairs(std::span<const Instance> instances, double reach,
                           std::vector<InstancePair>& pairs) {
    Status result;
    Status status = guarded([&] { result = implementation_->find_pairs(instances, reach, pairs); });
    return status.ok() ? result : status;
}

Status Context::run(const Batch& batch, Results& results) {
    return implementation_->run(batch, results);
}

const std::string& Context::device_name() const noexcept {
    return implementation_->device().name();
}

std::string Context::describe_graph(GraphFormat format) const {
    std::string text;
    const Status status = guarded([&] { text = implementation_->renderer().print(format); });
    return status.ok() ? text : status.text();
}

}  // namespace nearfield
