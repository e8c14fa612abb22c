#include <tools/benchmark/median_timings.hpp>
#include <tools/benchmark/spread.hpp>

#include <numeric>
#include <utility>
#include <vector>

namespace nearfield::benchmark {
namespace {

/// The median over all frames of the value that `get` returns for each.
template <class Get>
double median_of(std::span<const Timings> frames, Get get) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const Timings& frame : frames) {
        values.push_back(get(frame));
    }
    return spread_of(std::move(values)).median;
}

}  // namespace

Timings median_timings(std::span<const Timings> frames, std::size_t measured) {
    frames = frames.last(measured);
    Timings result;
    result.localize = median_of(frames, [](const Timings& frame) { return frame.localize; });
    result.plan = median_of(frames, [](const Timings& frame) { return frame.plan; });
    result.record = median_of(frames, [](const Timings& frame) { return frame.record; });
    result.device = median_of(frames, [](const Timings& frame) { return frame.device; });
    result.decode = median_of(frames, [](const Timings& frame) { return frame.decode; });
    result.total = median_of(frames, [](const Timings& frame) { return frame.total; });
    for (std::size_t pass = 0; pass < frames.front().passes.size(); ++pass) {
        result.passes.push_back(
            {frames.front().passes[pass].name, median_of(frames, [pass](const Timings& frame) {
                 return frame.passes.at(pass).milliseconds;
             })});
    }
    return result;
}

double sum_of(std::span<const PassTime> passes) {
    return std::accumulate(passes.begin(), passes.end(), 0.0, [](double sum, const PassTime& pass) {
        return sum + pass.milliseconds;
    });
}

}  // namespace nearfield::benchmark
