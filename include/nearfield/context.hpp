#pragma once

#include <nearfield/host.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// \file
/// The door: a context owns shapes, device objects and memory, takes batches and returns results.

namespace nearfield {

/// Limits and settings of a context.
struct Settings {
    /// The most memory that images and results of a batch may need, device and host side together,
    /// in bytes. A batch that needs more is refused (StatusCode::too_large) before any work. Meshes
    /// and lists of edges, which grow with the shapes and not with the grid, come on top.
    std::uint64_t memory_limit = std::uint64_t{1} << 30U;
    /// Maximum height of the bounding-volume hierarchies that localise (section 2.1 of the paper):
    /// more is more work on the CPU and less on the device.
    std::uint32_t hierarchy_height = 12;
    /// What these hierarchies are made of; docs/performance.md has the effect of both.
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
};

/// What an intersection strategy would need of a device and the device lacks.
struct StrategyReport {
    IntersectionStrategy strategy{};
    std::vector<std::string> missing;  ///< empty: the strategy is available
};

/// One Vulkan device that can be used, and every reason why not where it cannot.
struct DeviceReport {
    std::string name;
    std::string driver;  ///< driver version and Vulkan version
    bool usable = false;
    std::vector<std::string> missing;  ///< what the base needs and the device lacks
    /// Every strategy, for a headless context, which enables the features there are.
    std::vector<StrategyReport> strategies;
};

/// Every device of every installed driver, looked at without creating a device on any. An error
/// only where there is no Vulkan loader or instance. Thread-safe.
[[nodiscard]] Expected<std::vector<DeviceReport>> list_devices();

/// How the render graph prints itself.
enum class GraphFormat { text, graphviz };

/// Everything nearfield needs to answer queries on one device.
///
/// A context is used by one thread at a time; several contexts are independent of each other, on
/// one device too, as long as their queues are not used at the same time. Destroying a context
/// frees all it made; no work is in flight then, since run() returns only when the work is done.
class Context {
public:
    /// Adopts a host's device. Fails with every reason where the device does not suffice.
    [[nodiscard]] static Expected<Context> create(const HostDevice& host,
                                                  const Settings& settings = {});

    /// Makes an instance and a device of its own, with nothing to present to.
    [[nodiscard]] static Expected<Context> create_headless(const HeadlessOptions& options = {},
                                                           const Settings& settings = {});

    ~Context();
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Copies the rings; refuses bad ones (invalid_shape). Needs no precomputation: a shape may be
    /// added in the frame it is used.
    ///
    /// `deviation`, in the units of the coordinates: how far the rings may be from the shape they
    /// stand for, as tessellate() (curve.hpp) bounds it; 0 where the rings are the shape. It is
    /// part of the error bound of every result that depends on the shape; a query whose shapes
    /// together deviate by more than `most_deviation` of its tolerance is refused (invalid_query).
    [[nodiscard]] Expected<ShapeHandle> add_shape(std::span<const Ring> rings,
                                                  double deviation = 0.0);

    /// Replaces all rings of a shape; the handle stays. Nothing is rebuilt, so deforming a shape
    /// every frame costs a copy. On error the shape keeps its former rings.
    Status update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation = 0.0);

    /// Forgets a shape. Its handle stays unknown for good.
    Status remove_shape(ShapeHandle shape);

    /// Finds the pairs of instances worth a query: those whose bounding boxes are at most `reach`
    /// apart along both axes (world units, >= 0; 0: the closed boxes meet). Replaces `pairs`, in
    /// ascending order. The time grows with the instances and with the pairs found.
    Status find_pairs(std::span<const Instance> instances, double reach,
                      std::vector<InstancePair>& pairs);

    /// Answers a batch; returns when all results are there. An error of the batch as a whole
    /// is the returned status: too_large (more memory than the limit, or than one buffer of the
    /// device holds), out_of_memory, device_lost, device_error; the results are then undefined.
    /// What is wrong with one query alone (invalid_query, unknown_shape, unsupported_strategy)
    /// stands in that query's result, and the other queries are answered.
    Status run(const Batch& batch, Results& results);

    /// The device's name as its driver gives it.
    [[nodiscard]] const std::string& device_name() const noexcept;

    /// The render graph of the last batch: passes, resources, lifetimes, barriers. Empty before
    /// the first batch.
    [[nodiscard]] std::string describe_graph(GraphFormat format) const;

private:
    class Implementation;
    explicit Context(std::unique_ptr<Implementation> implementation) noexcept;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace nearfield
