#pragma once

#include <nearfield/result.hpp>

#include <tools/io/json_writer.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::benchmark {

/// How long an action takes.
template <class Action>
[[nodiscard]] double milliseconds_of(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

/// The same for an action that may be too short for a clock: it is then repeated.
template <class Action>
[[nodiscard]] double milliseconds_of_short(const Action& action) {
    constexpr double shortest = 1e-3;
    constexpr int repetitions = 100;
    const double once = milliseconds_of(action);
    if (once >= shortest) {
        return once;
    }
    const double together = milliseconds_of([&] {
        for (int i = 0; i < repetitions; ++i) {
            action();
        }
    });
    return together / repetitions;
}

/// The distribution of a list of measurements.
struct Spread {
    double least = 0.0;
    double lower_quartile = 0.0;
    double median = 0.0;
    double upper_quartile = 0.0;
    std::size_t count = 0;
};

/// Quartiles are interpolated between measurements. Precondition: the list is not empty.
[[nodiscard]] Spread spread_of(std::vector<double> measurements);

/// One of several ways to do the same work, with its measurements so far.
struct Contender {
    /// Does the work once; returns the time in milliseconds.
    std::function<double()> frame;
    std::vector<double> frames_ms;
};

/// How long each contender in a row is measured.
struct Budget {
    /// A contender is done when its frames add up to this many milliseconds ...
    double milliseconds = 250.0;
    /// ... or when it has run this many frames,
    std::size_t max_frames = 2000;
    /// but it always runs at least this many.
    std::size_t fewest_frames = 2;
    /// Length of a turn in milliseconds: long enough to warm the caches.
    double turn = 20.0;
};

/// Measures the contenders in alternating turns, so that other load on the machine and side effects
/// of one contender affect all of them equally. Each contender first does its work once unmeasured,
/// or several times if that is quick.
void measure(std::span<Contender> contenders, const Budget& budget);

/// Medians over the last `measured` frames of the same queries, by stage and by pass; those before
/// warmed up. Precondition: at least one measured frame, and all have the same passes.
[[nodiscard]] Timings median_timings(std::span<const Timings> frames, std::size_t measured);

/// Milliseconds of all passes together.
[[nodiscard]] double sum_of(std::span<const PassTime> passes);

/// A number with three significant digits: the spread is seldom below one percent.
[[nodiscard]] std::string three_digits(double number);

/// Where a measurement was taken, for later readers of the figures.
struct Surroundings {
    std::string commit;     ///< of the sources, or their version outside a repository
    std::string processor;  ///< the name the system reports
    unsigned cores = 0;     ///< available to this process
    std::string date;       ///< "2026-11-21"
    std::string device;     ///< empty if there is none
    std::string driver;     ///< of the device
};

/// This machine, and its device with this name.
[[nodiscard]] Surroundings surroundings_of(const std::string& device);

/// "2026-11-21, nearfield COMMIT; PROCESSOR, 2 cores; DEVICE (DRIVER)", without a line feed.
void write_surroundings(std::ostream& stream, const Surroundings& surroundings);
/// The same as members of an open object, but the driver.
void write_surroundings(tools::JsonWriter& json, const Surroundings& surroundings);

}  // namespace nearfield::benchmark
