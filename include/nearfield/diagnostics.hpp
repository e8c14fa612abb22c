#pragma once

#include <nearfield/context.hpp>
#include <nearfield/export.hpp>
#include <nearfield/query.hpp>
#include <nearfield/requirements.hpp>
#include <nearfield/status.hpp>
#include <nearfield/tile.hpp>

#include <cstdint>
#include <string>
#include <vector>

/// \file
/// Reports for people who tune or debug a program: devices and what they lack, the render graph,
/// tiles, and the reloading of shaders.
///
/// Threads: functions with a context follow the rules of the context's own functions (Context).

namespace nearfield {

/// The requirements of one intersection strategy that a device does not meet.
struct StrategyReport {
    IntersectionStrategy strategy{};   ///< the strategy that the report is about
    std::vector<std::string> missing;  ///< unmet requirements; empty: the strategy is available
};

/// One Vulkan device: whether nearfield can use it, and every reason if not.
struct DeviceReport {
    std::string name;                  ///< as reported by the driver
    std::string driver;                ///< driver version and Vulkan version
    bool usable = false;               ///< `missing` is empty
    std::vector<std::string> missing;  ///< unmet base requirements
    /// Optional parts (Requirements::optional).
    std::vector<OptionalPart> optional;
    /// Every strategy, as in a headless context, which enables the features that the device has.
    std::vector<StrategyReport> strategies;
};

/// Lists the devices of all installed Vulkan drivers, without creating a device on any of them.
/// Fails only if there is no Vulkan loader or no instance can be created. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::vector<DeviceReport>> list_devices();

/// Output format of describe_graph().
enum class GraphFormat {
    text,      ///< plain text
    graphviz,  ///< a graph in the DOT language
};

/// The render graphs of the last batch submitted or recorded, each with a title, or that of a
/// PairTable that the device has updated, or that was recorded, since: passes, resources,
/// lifetimes, barriers; those of a host's targets as by default, not as stated. Empty before the
/// first of them and in a context without a device. Batches that the CPU answers alone do not
/// count. Fails with invalid_settings if `format` is not a valid enumerator, or with out_of_memory.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::string> describe_graph(const Context& context,
                                                                    GraphFormat format);

/// The tiles of the last batch submitted or recorded, collected or not; costs nothing unless
/// called. Ordered by query, and within a query by its points or row by row. Empty before the first
/// batch, after a batch that failed as a whole, and if the CPU answered everything. Points that the
/// device searches by itself (penetration and contacts by Technique::compute) have none. Fails only
/// with out_of_memory.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::vector<TileReport>> list_tiles(const Context& context);

/// Development aid: recompiles the shaders whose sources changed since this context last loaded
/// them and rebuilds the pipelines of those whose code differs from the code in use; later batches
/// use the new pipelines. Returns the number of shaders replaced; 0: nothing changed. Waits for the
/// compiler that the library was built with, run as a separate process; the first call compiles all
/// shaders, which takes seconds. Does not wait for the device. Commands that World::record() has
/// recorded must not be submitted afterwards.
///
/// `folder`: the folder of the sources; null: the folder that the library was built from.
///
/// Fails with unavailable if the library was built without the CMake option
/// NEARFIELD_SHADER_RELOAD, as release builds are; with no_device in a context without one; with
/// not_ready while batches are in flight, or a PairTable is not collected; with
/// invalid_shader if a source cannot be read or compiled (the compiler's messages are the reasons
/// and go to the log); as Context::create() does if the device rejects a pipeline. The shaders in
/// use then stay in use.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::uint32_t> reload_shaders(Context& context,
                                                                      const char* folder = nullptr);

}  // namespace nearfield
