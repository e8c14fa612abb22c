#include <nearfield/diagnostics.hpp>

#include <embedded/commit.hpp>
#include <sched.h>
#include <tools/benchmark/measuring.hpp>
#include <tools/common/library.hpp>
#include <tools/io/answer.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

namespace nearfield::benchmark {
namespace {

/// The quantile of sorted measurements at `share` (0 to 1).
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - std::floor(place));
}

}  // namespace

Spread spread_of(std::vector<double> measurements) {
    std::sort(measurements.begin(), measurements.end());
    return {measurements.front(), quantile(measurements, 0.25), quantile(measurements, 0.5),
            quantile(measurements, 0.75), measurements.size()};
}

namespace {

double spent(const Contender& contender) {
    return std::accumulate(contender.frames_ms.begin(), contender.frames_ms.end(), 0.0);
}

bool has_enough(const Contender& contender, const Budget& budget) {
    const std::size_t frames = contender.frames_ms.size();
    return frames >= budget.fewest_frames &&
           (frames >= budget.max_frames || spent(contender) >= budget.milliseconds);
}

void warm_up(const Contender& contender, double milliseconds) {
    constexpr int max_frames = 10;
    double taken = 0.0;
    for (int frame = 0; frame < max_frames && taken <= milliseconds; ++frame) {
        taken += contender.frame();
    }
}

/// Runs one turn. Returns true if there is more to measure.
bool take_turn(Contender& contender, const Budget& budget) {
    if (has_enough(contender, budget)) {
        return false;
    }
    // Let the driver's threads go idle first. Schedulers favour threads that have slept (such as
    // one waiting for a device); after a pause they favour all contenders alike.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    double taken = 0.0;
    while (taken < budget.turn && contender.frames_ms.size() < budget.max_frames) {
        contender.frames_ms.push_back(contender.frame());
        taken += contender.frames_ms.back();
    }
    return !has_enough(contender, budget);
}

}  // namespace

void measure(std::span<Contender> contenders, const Budget& budget) {
    for (const Contender& contender : contenders) {
        warm_up(contender, budget.turn);
    }
    std::vector<Contender*> order;
    for (Contender& contender : contenders) {
        order.push_back(&contender);
    }
    for (bool more = true; more;) {
        more = false;
        for (Contender* const contender : order) {
            more = take_turn(*contender, budget) || more;
        }
        std::reverse(order.begin(), order.end());
    }
}

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

namespace {

std::string processor_name() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

unsigned usable_cores() {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(0, sizeof cores, &cores) == 0
               ? static_cast<unsigned>(CPU_COUNT(&cores))
               : 0;
}

std::string date_of_today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    char text[16];
    gmtime_r(&now, &parts);
    return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts)};
}

}  // namespace

std::string three_digits(double number) {
    char text[32];
    // 1.23e+03 is harder to read than 1230.
    std::snprintf(text, sizeof text, number < 1000.0 ? "%.3g" : "%.0f", number);
    return text;
}

Surroundings surroundings_of(const std::string& device) {
    Surroundings surroundings{embedded::commit, processor_name(), usable_cores(),
                              date_of_today(),  device,           {}};
    if (!device.empty()) {
        for (const DeviceReport& report : tools::take(list_devices())) {
            if (report.name == device) {
                surroundings.driver = report.driver;
                break;
            }
        }
    }
    return surroundings;
}

void write_surroundings(std::ostream& stream, const Surroundings& surroundings) {
    stream << surroundings.date << ", nearfield " << surroundings.commit << "; "
           << surroundings.processor << ", " << surroundings.cores << " cores; "
           << tools::device_text(surroundings.device) << " (" << surroundings.driver << ')';
}

void write_surroundings(tools::JsonWriter& json, const Surroundings& surroundings) {
    json.member("commit", surroundings.commit);
    json.member("date", surroundings.date);
    json.member("processor", surroundings.processor);
    json.member("cores", surroundings.cores);
    json.member("device", surroundings.device, !surroundings.device.empty());
}

}  // namespace nearfield::benchmark
