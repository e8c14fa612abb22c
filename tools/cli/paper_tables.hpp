#pragma once

#include <nearfield/context.hpp>

#include <tools/simulation/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

inline constexpr std::size_t techniques_measured = 4;

/// The time for a frame's queries by technique, in milliseconds; empty if unavailable.
using TechniqueTimes = std::array<std::optional<double>, techniques_measured>;

/// The cost of the proximity queries of a scene: the penetration of every near pair in both
/// directions, with all records, as one batch per frame. Includes shape deformation, poses and the
/// broad phase.
struct QueryTimes {
    double queries = 0.0;  ///< average per frame
    double points = 0.0;   ///< average found per frame
    TechniqueTimes milliseconds;
};

/// Measures with one context per technique, so that techniques do not disturb one another.
class QueryStopwatch {
public:
    explicit QueryStopwatch(const Settings& settings);

    /// Runs a scene with the penalty response and measures the average over some of its frames, for
    /// each tolerance.
    [[nodiscard]] std::vector<QueryTimes> measure_run(simulation::Scene scene,
                                                      const std::vector<double>& tolerances);
    /// Measures a scene in its current state.
    [[nodiscard]] QueryTimes measure_still(const simulation::Scene& scene);

    [[nodiscard]] static const std::array<Technique, techniques_measured>& techniques();
    /// Empty if there is no device.
    [[nodiscard]] std::string device_name() const;

private:
    std::vector<std::optional<Context>> contexts_;  // empty if the technique has no device
};

/// Measures Tables 2 and 3 of the paper, and how times grow with the number of lines and with the
/// tolerance, for each technique, and reports them. `json`: a path or "-"; `curves`: a PNG file for
/// the growth. Throws InputError or LibraryError.
void run_paper_tables(const Settings& settings, const std::optional<std::string>& json,
                      const std::optional<std::string>& curves);

}  // namespace nearfield::tools
