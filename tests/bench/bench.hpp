#pragma once

#include <nearfield/status.hpp>

#include <benchmark/benchmark.h>
#include <time.h>

#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

/// \file
/// What all measurements have in common. The programs are Google Benchmark's: filter, repetitions
/// (`--benchmark_repetitions=9 --benchmark_enable_random_interleaving`), JSON. A measurement makes
/// its scene, runs frames to warm up, and then the frames that it states.

namespace nearfield::bench {

/// Throws std::runtime_error if the status is an error.
inline void require(const Status& status) {
    if (!status.ok()) {
        throw std::runtime_error(status.text());
    }
}

/// Returns the value or throws std::runtime_error.
template <class Value>
[[nodiscard]] Value take(Expected<Value> value) {
    require(value.error());
    return std::move(*value);
}

/// Processor time of this thread only, which other load does not count in.
inline double processor_milliseconds() {
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) {
        throw std::runtime_error("no processor time");
    }
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

using ::benchmark::State;

/// What a frame reports beside its time.
using Numbers = std::map<std::string, double>;

/// Adds a measurement of a number of frames: `measure(state)` makes a scene and runs them. What it
/// throws is its error.
template <class Measure>
::benchmark::internal::Benchmark* add(const std::string& name, int frames, Measure measure) {
    return ::benchmark::RegisterBenchmark(name.c_str(),
                                          [measure](State& state) {
                                              try {
                                                  measure(state);
                                              } catch (const std::exception& error) {
                                                  state.SkipWithError(error.what());
                                              }
                                          })
        ->Unit(::benchmark::kMillisecond)
        ->Iterations(frames);
}

/// Runs a frame twice to warm up, then as often as it is measured; `prepare()` comes before each
/// and is not. A frame returns numbers that are reported on average beside the times.
template <class Prepare, class Frame>
void run(State& state, const Prepare& prepare, const Frame& frame) {
    for (int i = 0; i < 2; ++i) {
        prepare();
        static_cast<void>(frame());
    }
    Numbers sums;
    for (auto _ : state) {
        state.PauseTiming();
        prepare();
        state.ResumeTiming();
        for (const auto& [name, number] : frame()) {
            sums[name] += number;
        }
    }
    for (const auto& [name, sum] : sums) {
        state.counters[name] = ::benchmark::Counter(sum, ::benchmark::Counter::kAvgIterations);
    }
}
template <class Frame>
void run(State& state, const Frame& frame) {
    run(
        state, [] {}, frame);
}

}  // namespace nearfield::bench
