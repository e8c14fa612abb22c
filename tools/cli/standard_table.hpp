#pragma once

#include <nearfield/context.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/table.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::tools {

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

/// All techniques, each with its own context, so that none benefits from or disturbs what another
/// keeps from frame to frame.
class TechniqueRace {
public:
    explicit TechniqueRace(const Settings& settings);

    [[nodiscard]] RowTimes run(const benchmark::Row& row);

    /// Empty if there is no device.
    [[nodiscard]] std::string device_name() const;

private:
    struct Runner {
        std::string name;
        Technique technique{};
        std::string missing;             ///< why there is no context
        std::optional<Context> context;  ///< empty if unavailable
        std::optional<Context> timed;    ///< another one, with timestamps
    };

    std::vector<Runner> runners_;
};

/// The table in Markdown, written row by row.
class TextTable {
public:
    /// Writes the lines above the rows.
    TextTable(std::ostream& stream, const benchmark::Surroundings& surroundings);

    void add(const RowTimes& row);
    /// Writes the explanations of the refusals.
    void finish();

private:
    [[nodiscard]] std::string cell(const TechniqueTime& time);

    std::ostream& stream_;
    std::vector<std::string> refusals_;  // distinct; rows refer to them by number
};

/// Measures the rows of the standard table whose names contain `filter`, with each technique, and
/// reports them. `json`: a path or "-". Throws InputError if no row matches, or LibraryError.
void run_standard_table(const std::string& filter, const Settings& settings,
                        const std::optional<std::string>& json);

}  // namespace nearfield::tools
