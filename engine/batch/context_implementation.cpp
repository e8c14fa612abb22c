#include <engine/batch/context_implementation.hpp>
#include <engine/queries/check_query.hpp>
#ifdef NEARFIELD_HAS_RASTER
#include <engine/raster/raster.hpp>
#endif

#include <algorithm>
#include <cassert>
#include <utility>

namespace nearfield {
namespace {

#ifdef NEARFIELD_HAS_RASTER
constexpr bool has_raster = true;

std::unique_ptr<render::TileTechnique> make_raster(const gpu::Device& device,
                                                   const graph::ComputeLayout& layout,
                                                   bool makes_pipelines) {
    return std::make_unique<raster::Raster>(device, layout, makes_pipelines);
}
#else
constexpr bool has_raster = false;
constexpr render::MakeTileTechnique make_raster = nullptr;
#endif

/// `device` is null for a context without one.
queries::QueryLimits plan_limits(const gpu::Device* device, const Settings& settings,
                                 const ShapeErrors& shape_errors) {
    queries::QueryLimits limits;
    limits.shape_errors = &shape_errors;
    limits.memory = settings.memory_limit;
    limits.hierarchy_height = settings.hierarchy_height;
    limits.bounding_volume = settings.bounding_volume;
    limits.techniques = {.device = device != nullptr,
                         .raster = settings.techniques.raster,
                         .compute = settings.techniques.compute};
    if (device == nullptr) {
        return limits;
    }
    limits.techniques.draws = device->draws();
    limits.techniques.has_raster = has_raster;
    limits.subpixel = {device->subpixel_steps()};
    limits.largest_atlas = std::min(limits.largest_atlas, device->limits().maxImageDimension2D);
    limits.largest_image = device->limits().maxImageDimension2D;
    limits.largest_range = device->limits().maxStorageBufferRange;
    limits.offset_alignment = device->limits().minStorageBufferOffsetAlignment;
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        limits.missing_for_strategy[i] =
            gpu::missing_for(static_cast<IntersectionStrategy>(i), device->strategy_support());
    }
    return limits;
}

std::optional<DeviceThresholds> thresholds_of(const gpu::Device* device, const Settings& settings) {
    return device == nullptr || device->is_software() ? std::nullopt
                                                      : std::optional(settings.device_thresholds);
}

Settings without_device(Settings settings) {
    settings.techniques = {.raster = false, .compute = false};
    return settings;
}

/// Without the raster where the queue family does not draw, or the library has none.
Settings settings_for(Settings settings, const gpu::Device& device) {
    settings.techniques.raster = settings.techniques.raster && device.draws() && has_raster;
    return settings;
}

Status device_is_lost() {
    return {StatusCode::device_lost,
            "the device was lost in an earlier batch; destroy this context and make another"};
}

}  // namespace

Context::Implementation::Machinery::Machinery(const gpu::Device* device, const Settings& settings,
                                              batch::ShapeStore& shapes)
    : renderer(device == nullptr
                   ? nullptr
                   : std::make_unique<render::Renderer>(*device, settings, make_raster)),
      ring(settings.batches_in_flight, plan_limits(device, settings, shapes.errors()),
           thresholds_of(device, settings), settings.jobs, renderer.get(), shapes) {}

Context::Implementation::Implementation(const Settings& settings)
    : settings_(without_device(settings)),
      machinery_(make_machinery()),
      lost_device_(device_is_lost()) {}

Context::Implementation::Implementation(std::unique_ptr<gpu::HeadlessDevice> own,
                                        const HostDevice& host, const Settings& settings)
    : own_device_(std::move(own)),
      device_(std::make_unique<gpu::Device>(host)),
      settings_(settings_for(settings, *device_)),
      machinery_(make_machinery()),
      lost_device_(device_is_lost()) {
    device_->log(LogLevel::information, [&] {
        return "context on '" + device_->name() + "' made in " +
               std::to_string(making_.milliseconds()) + " ms, for " +
               std::to_string(settings.batches_in_flight) + " batches in flight";
    });
}

Context::Implementation::~Implementation() {
    if (device_ != nullptr) {
        report_open_frames();
        device_->log(LogLevel::information, [&] {
            return "context on '" + device_->name() + "' goes; it took at most " +
                   std::to_string(device_->memory_count().peak()) + " bytes of device memory";
        });
    }
}

/// A batch that the device may still run would use what the destructor frees.
void Context::Implementation::report_open_frames() const noexcept {
    if (lost_ || machinery_->ring.open_frames().empty()) {
        return;
    }
    device_->log(LogLevel::error, [&] {
        return "the context goes while batches recorded for these frames may still run: " +
               machinery_->ring.open_frames() +
               "; the device has to finish them, or never begin, and Context::frame_completed() "
               "says so";
    });
    assert(!"a context was destroyed before its frames were complete: see its log");
}

std::unique_ptr<Context::Implementation::Machinery> Context::Implementation::make_machinery() {
    return std::make_unique<Machinery>(device_.get(), settings_, shapes_);
}

std::span<const InstancePair> Context::Implementation::find_overlapping_boxes(
    std::span<const Instance> instances, double reach) {
    if (!(reach >= 0.0 && reach <= largest_coordinate)) {
        throw StatusException({StatusCode::invalid_query,
                               "find_overlapping_boxes: the reach is " + geometry::number(reach) +
                                   "; it must be a finite number of at least 0"});
    }
    for (std::size_t i = instances.size(); i < bounds_.size(); ++i) {
        boxes_.remove(static_cast<std::uint32_t>(i));
    }
    bounds_origins_.resize(instances.size());
    bounds_.resize(instances.size());
    double max_rounding = 0.0;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const geometry::Polygon* const polygon = shapes_.find(instances[i].shape);
        Status status = polygon == nullptr
                            ? shapes_.errors().unknown("its shape", instances[i].shape)
                            : queries::check_pose(instances[i].pose, "the instance");
        if (!status.ok()) {
            throw StatusException({status.code(), "find_overlapping_boxes: instance " +
                                                      std::to_string(i) + ": " + status.message()});
        }
        if (const BoundsOrigin origin{polygon, polygon->revision(), instances[i].pose};
            !(bounds_origins_[i] == origin)) {
            bounds_[i] = geometry::bounds_of({*polygon, instances[i].pose});
            boxes_.set(i, bounds_[i].box);
            bounds_origins_[i] = origin;
        }
        max_rounding = std::max(max_rounding, bounds_[i].rounding);
    }
    // So few are compared with each other in less time than with boxes around them.
    constexpr std::size_t few = 32;
    const bool are_few = instances.size() <= few;
    if (!are_few) {
        boxes_.prepare();
    }
    instance_pairs_.clear();
    // Slightly more than the margin of any pair, for the rounding of what is compared below.
    const double margin = reach * (1.0 + 1e-9) + 3.0 * max_rounding;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const auto before = static_cast<std::ptrdiff_t>(instance_pairs_.size());
        const auto compare = [&](std::uint32_t other) {
            if (i < other && geometry::may_meet(bounds_[i], bounds_[other], reach)) {
                instance_pairs_.push_back({i, other});
            }
        };
        if (are_few) {
            for (std::uint32_t other = i + 1; other < instances.size(); ++other) {
                compare(other);
            }
            continue;
        }
        boxes_.for_meeting(geometry::grown(bounds_[i].box, margin), compare);
        std::sort(instance_pairs_.begin() + before, instance_pairs_.end(),
                  [](const InstancePair& one, const InstancePair& other) {
                      return one.second < other.second;
                  });
    }
    return instance_pairs_;
}

#ifdef NEARFIELD_SHADER_RELOAD
std::uint32_t Context::Implementation::reload_shaders(const char* folder) {
    if (device_ == nullptr) {
        throw StatusException(no_device("reload_shaders"));
    }
    machinery_->ring.require_none_in_flight("reload_shaders");
    if (tables_in_flight > 0) {
        throw StatusException({StatusCode::not_ready,
                               "reload_shaders: a PairTable was submitted or recorded, and "
                               "has not been collected since"});
    }
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

}  // namespace nearfield
