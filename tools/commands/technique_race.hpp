#pragma once

#include <nearfield/context.hpp>

#include <tools/benchmark/interleave.hpp>
#include <tools/benchmark/spread.hpp>
#include <tools/benchmark/table.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// What a frame of a row is about.
struct FrameWork {
    std::size_t queries = 0;
    std::size_t vertices = 0;  ///< of all shapes, handed over each frame
    std::uint64_t cells = 0;   ///< of all grids
    std::uint64_t found = 0;   ///< points, contacts or samples; of separations and fields, queries
};

/// How one technique did in a row.
struct TechniqueTime {
    std::string technique;  ///< as asked for
    std::string refusal;    ///< why it did not answer; the rest is meaningful where it is empty
    std::string answered_by;
    benchmark::Spread frame_ms;
    Timings timings;  ///< medians
    FrameWork work;

    /// Of all passes on the device, by timestamps; nothing where it had none to do.
    [[nodiscard]] std::optional<double> device_ms() const;
};

/// A measured row.
struct RowTimes {
    std::string name;
    std::vector<TechniqueTime> techniques;

    [[nodiscard]] const TechniqueTime* find(const std::string& technique) const;
    /// What automatic took, as a multiple of the quickest technique, by medians or by another
    /// member of the spread; nothing where there is nothing to compare. The least is what other
    /// load of the machine disturbs least.
    [[nodiscard]] std::optional<double> automatic_to_best(
        double benchmark::Spread::*of = &benchmark::Spread::median) const;
};

/// All techniques there are, each with a context of its own, so that none warms up or disturbs what
/// another keeps from frame to frame.
class TechniqueRace {
public:
    explicit TechniqueRace(const Settings& settings);

    [[nodiscard]] RowTimes run(const benchmark::Row& row);

    /// Empty without a device.
    [[nodiscard]] std::string device_name() const;

private:
    struct Runner {
        std::string name;
        Technique technique{};
        std::string missing;             ///< why there is none
        std::optional<Context> context;  ///< none where it is missing
    };

    std::vector<Runner> runners_;
};

}  // namespace nearfield::tools
