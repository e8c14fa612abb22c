#pragma once

#include <engine/base/catch_to_status.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/batch/batch_ring.hpp>
#include <engine/batch/shape_store.hpp>
#include <engine/geometry/gathered_rings.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>
#include <engine/render/renderer.hpp>
#include <engine/simd/box_hierarchy.hpp>
#include <nearfield/context.hpp>
#ifdef NEARFIELD_SHADER_RELOAD
#include <engine/reload/shader_reload.hpp>
#endif

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield {

/// The error of a call that needs a device.
[[nodiscard]] inline Status no_device(const char* call) {
    return {StatusCode::no_device,
            std::string(call) + ": this context has no device (Context::create_cpu)"};
}

/// What a context consists of. Whatever needs a context shares in it, so that it lasts as long.
class Context::Implementation : public std::enable_shared_from_this<Context::Implementation> {
    /// Everything made from pipelines, and the memory they work on.
    struct Machinery {
        Machinery(const gpu::Device* device, const Settings& settings, batch::ShapeStore& shapes);

        std::unique_ptr<render::Renderer> renderer;  // null without a device
        batch::BatchRing ring;
    };

    /// What bounds were computed from.
    struct BoundsOrigin {
        const geometry::Polygon* polygon = nullptr;
        std::uint64_t revision = 0;
        Pose pose;

        [[nodiscard]] bool operator==(const BoundsOrigin&) const = default;
    };

public:
    /// Without a device.
    explicit Implementation(const Settings& settings);
    /// On the host's device, or on the context's own, which `host` then describes.
    Implementation(std::unique_ptr<gpu::HeadlessDevice> own, const HostDevice& host,
                   const Settings& settings);
    ~Implementation();
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    /// As the public function; throws.
    [[nodiscard]] std::span<const InstancePair> find_overlapping_boxes(
        std::span<const Instance> instances, double reach);
    /// Whether what was recorded for the host's frame need not be waited for.
    [[nodiscard]] bool is_complete(std::uint64_t frame) const {
        return lost_ || machinery_->ring.is_complete(frame);
    }

    [[nodiscard]] const batch::BatchRing& ring() const { return machinery_->ring; }
    [[nodiscard]] batch::BatchRing& ring() { return machinery_->ring; }

    [[nodiscard]] batch::ShapeStore& shapes() { return shapes_; }
    [[nodiscard]] const batch::ShapeStore& shapes() const { return shapes_; }
    /// Calls `add`, which adds a shape to these, unless the device is lost; keeps why it fails.
    template <class Add>
    AddedShape add_shape(const Add& add) {
        Expected<ShapeHandle> handle = ShapeHandle{};
        Status why = unless_lost([&] { handle = add(); });
        if (why.ok() && handle.has_value()) {
            return *handle;
        }
        why = why.ok() ? handle.error() : why;
        ShapeHandle refused{UINT32_MAX, 0, shapes_.errors().context()};
        // Where memory runs out, the handle stands for a refusal without words.
        static_cast<void>(catch_to_status([&] { refused = shapes_.refuse(why); }).ok());
        return {why, refused};
    }
    /// Rings of the caller's numbers, until the next call.
    [[nodiscard]] std::span<const Ring> gather(std::span<const RingView> rings) {
        return gathered_rings_.gather(rings);
    }
    /// Null without a device, as the renderer is.
    [[nodiscard]] const gpu::Device* device() const { return device_.get(); }
    [[nodiscard]] const JobSystem& jobs() const { return settings_.jobs; }
    [[nodiscard]] const DeviceTechniques& techniques() const { return settings_.techniques; }
    [[nodiscard]] std::uint64_t memory_limit() const { return settings_.memory_limit; }
    /// Tables of pairs that were submitted or recorded and not collected; they use the renderer.
    std::uint32_t tables_in_flight = 0;
    [[nodiscard]] const render::Renderer* renderer() const { return machinery_->renderer.get(); }
    [[nodiscard]] render::Renderer* renderer() { return machinery_->renderer.get(); }

    [[nodiscard]] bool is_lost() const { return lost_; }
    [[nodiscard]] const Status& lost_device() const { return lost_device_; }
    /// Runs an action unless the device is lost; records the loss of the device. Returns what the
    /// action does, or the error: a Status, or an Expected of other values.
    template <class Action>
    auto unless_lost(Action&& action) noexcept {
        using Value = decltype(action());
        if constexpr (std::is_void_v<Value>) {
            return run_unless_lost(action);
        } else {
            Value value{};
            Status status = run_unless_lost([&] { value = action(); });
            if constexpr (std::is_same_v<Value, Status>) {
                return status.ok() ? value : status;
            } else {
                return status.ok() ? Expected<Value>(std::move(value)) : Expected<Value>(status);
            }
        }
    }

#ifdef NEARFIELD_SHADER_RELOAD
    std::uint32_t reload_shaders(const char* folder);
#endif

private:
    template <class Action>
    Status run_unless_lost(Action&& action) noexcept {
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
    [[nodiscard]] std::unique_ptr<Machinery> make_machinery();
    void report_open_frames() const noexcept;

    Stopwatch making_;
    std::unique_ptr<gpu::HeadlessDevice> own_device_;  // null where the host's is used
    std::unique_ptr<gpu::Device> device_;              // null in a context without one
    const Settings settings_;
    batch::ShapeStore shapes_;
    geometry::GatheredRings gathered_rings_;
    // Of the instances of find_overlapping_boxes(), by position; they stay while their origins do.
    std::vector<geometry::Bounds> bounds_;
    std::vector<BoundsOrigin> bounds_origins_;
    simd::BoxHierarchy boxes_;
    std::vector<InstancePair> instance_pairs_;
    std::unique_ptr<Machinery> machinery_;
#ifdef NEARFIELD_SHADER_RELOAD
    std::optional<reload::ShaderReload> reload_;
#endif
    const Status lost_device_;  // made in advance: returning it needs no memory
    bool lost_ = false;
};

}  // namespace nearfield
