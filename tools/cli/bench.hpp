#pragma once

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>
#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/cli/options.hpp>
#include <tools/simulation/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The arguments of `nearfield bench`.
struct BenchArguments {
    std::string scene;   ///< if empty, the standard table is measured
    std::string filter;  ///< selects rows of the standard table
    bool paper = false;  ///< measures the paper's tables instead
    bool gpu = false;    ///< measures the work from which a GPU is faster, instead
    std::optional<std::string> curves;
    std::optional<std::string> technique;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::uint32_t frames = 50;
    std::uint32_t warm_up = 5;
    bool keep = false;  ///< a frame passes poses alone, no shapes
};

/// Adds the command `bench` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_bench_command(CLI::App& program, BenchArguments& arguments);

/// Runs the scene as one batch per frame, or the standard table, and reports medians. Throws
/// InputError, LibraryError (cancelled, after Ctrl-C) or std::runtime_error.
void run_bench(const BenchArguments& arguments);

/// The work in a frame of a row.
struct FrameWork {
    std::size_t queries = 0;
    std::size_t vertices = 0;  ///< of all shapes, submitted each frame
    std::uint64_t cells = 0;   ///< of all grids
    std::uint64_t found = 0;   ///< points, contacts or samples; for separations and fields, queries
};

/// The result of one technique in a row.
struct TechniqueTime {
    std::string technique;  ///< as requested
    std::string refusal;    ///< why it did not answer; if not empty, the other members are
                            ///< meaningless
    std::string answered_by;
    benchmark::Spread frame_ms;
    Timings timings;  ///< medians
    FrameWork work;

    /// The total time of all passes on the device, from timestamps; empty if the device did
    /// nothing.
    [[nodiscard]] std::optional<double> device_ms() const;
};

/// A measured row.
struct RowTimes {
    std::string name;
    std::vector<TechniqueTime> techniques;

    [[nodiscard]] const TechniqueTime* find(const std::string& technique) const;
    /// The time of `automatic` as a multiple of the fastest technique's, by median or by another
    /// member of the spread; empty if there is nothing to compare. The minimum is least affected by
    /// other load on the machine.
    [[nodiscard]] std::optional<double> automatic_to_best(
        double benchmark::Spread::*of = &benchmark::Spread::median) const;
};

/// Measures the rows of the standard table whose names contain `filter`, with each technique, and
/// reports them. `json`: a path or "-". Throws InputError if no row matches, or LibraryError.
void run_standard_table(const std::string& filter, const Settings& settings,
                        const std::optional<std::string>& json);

/// Measures the work from which the device is faster than the CPU: crowds of 420 to 42,000 objects,
/// all of which move, with their pairs listed by the CPU or found by the device, and fields of 256
/// to 4096 cells a side, by each technique. Prints tables in Markdown, and from how many pairs on
/// the device is faster. `filter`: only the rows whose names hold this text. Throws InputError,
/// LibraryError (no_device without one, cancelled after Ctrl-C) or std::runtime_error.
void run_gpu_table(const std::string& filter, const Settings& settings,
                   const std::optional<std::string>& json);

inline constexpr std::array techniques_measured{Technique::raster, Technique::compute,
                                                Technique::cpu, Technique::automatic};

/// The time for a frame's queries by technique, in milliseconds; empty if unavailable.
using TechniqueTimes = std::array<std::optional<double>, techniques_measured.size()>;

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
