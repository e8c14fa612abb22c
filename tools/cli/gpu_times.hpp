#pragma once

#include <nearfield/context.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

class Gpu;

/// Medians of one way to do the work of a row, in milliseconds a frame.
struct GpuTime {
    std::string way;
    std::size_t frames = 0;  ///< 0: refused, or left out, since a smaller row took too long
    double frame = 0.0;
    double cpu = 0.0;                             ///< processor time of the calling thread
    std::optional<double> device = std::nullopt;  ///< by timestamps; empty if it is not used
    std::vector<PassTime> passes = {};            ///< medians, of frames with timestamps
    std::string refusal = {};                     ///< why the row is too large for it
};

/// A measured row.
struct GpuRow {
    std::string name;
    bool has_pairs = false;   ///< otherwise a field
    std::uint64_t size = 0;   ///< ordered pairs, or cells
    std::uint64_t found = 0;  ///< penetrating points
    std::vector<GpuTime> times;
};

/// A way to do the work of a row, ready to run its frames.
class GpuWork {
public:
    virtual ~GpuWork() = default;
    virtual void run_frame() = 0;
    /// Of the last frame.
    [[nodiscard]] virtual const Timings& timings() const = 0;
    /// Ordered pairs and penetrating points, of the last frame.
    [[nodiscard]] virtual std::uint64_t pairs() const = 0;
    [[nodiscard]] virtual std::uint64_t found() const = 0;
};

/// A row that can be measured. Its scene is made only then.
struct GpuRowPlan {
    struct Way {
        std::string name;
        bool uses_device = true;
        std::function<std::unique_ptr<GpuWork>(Context&, const Gpu&)> make;
    };
    std::string name;
    bool has_pairs = false;
    std::uint64_t cells = 0;
    std::vector<Way> ways;
};

/// All rows, smaller ones first.
[[nodiscard]] std::vector<GpuRowPlan> gpu_rows();

}  // namespace nearfield::tools
