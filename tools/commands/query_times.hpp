#pragma once

#include <nearfield/context.hpp>

#include <tools/dynamics/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

inline constexpr std::size_t techniques_measured = 4;

/// The time of a frame's queries by each technique, milliseconds; none where it refused.
using TechniqueTimes = std::array<std::optional<double>, techniques_measured>;

/// What the proximity queries of a scene take: the penetration of every near pair, both ways, with
/// all records, as one batch a frame; shapes that deform, poses and near pairs found anew included.
struct QueryTimes {
    double queries = 0.0;  ///< a frame, on average
    double points = 0.0;   ///< found in a frame, on average
    TechniqueTimes milliseconds;
};

/// Contexts to measure with, one a technique, so that none disturbs another.
class QueryStopwatch {
public:
    explicit QueryStopwatch(const Settings& settings);

    /// Runs a scene with the penalty response and measures the average over some of its frames, for
    /// each of these tolerances.
    [[nodiscard]] std::vector<QueryTimes> measure_run(dynamics::Scene scene,
                                                      const std::vector<double>& tolerances);
    /// Measures a scene as it stands.
    [[nodiscard]] QueryTimes measure_still(const dynamics::Scene& scene);

    [[nodiscard]] static const std::array<Technique, techniques_measured>& techniques();
    /// Empty without a device.
    [[nodiscard]] std::string device_name() const;

private:
    std::vector<std::optional<Context>> contexts_;  // none where the technique lacks a device
};

}  // namespace nearfield::tools
