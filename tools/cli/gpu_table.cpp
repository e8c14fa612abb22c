#include <tools/benchmark/machine.hpp>
#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/benchmark/spread.hpp>
#include <tools/cli/gpu_report.hpp>
#include <tools/cli/gpu_table.hpp>
#include <tools/cli/gpu_times.hpp>
#include <tools/cli/open_context.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <numeric>
#include <set>
#include <stdexcept>

namespace nearfield::tools {
namespace {

constexpr double too_long_ms = 2000.0;  ///< a way whose frame takes more has no larger rows
constexpr double enough_ms = 500.0;     ///< of measured frames
constexpr std::size_t max_frames = 30;
constexpr std::size_t min_frames = 3;
constexpr int warm_up = 2;

double processor_ms() {
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) {
        throw std::runtime_error("this system does not tell a thread's processor time");
    }
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::optional<double> device_ms(const Timings& timings) {
    if (timings.passes.empty()) {
        return std::nullopt;
    }
    return std::accumulate(
        timings.passes.begin(), timings.passes.end(), 0.0,
        [](double sum, const PassTime& pass) { return sum + pass.milliseconds; });
}

GpuTime measure(GpuWork& work, const std::string& way) {
    for (int frame = 0; frame < warm_up; ++frame) {
        stop_after_ctrl_c();
        work.run_frame();
    }
    std::vector<double> frames;
    std::vector<double> cpu;
    std::vector<double> device;
    double spent = 0.0;
    while (frames.size() < min_frames || (frames.size() < max_frames && spent < enough_ms)) {
        stop_after_ctrl_c();
        const double begin = processor_ms();
        frames.push_back(benchmark::milliseconds_of([&] { work.run_frame(); }));
        cpu.push_back(processor_ms() - begin);
        if (const std::optional<double> passes = device_ms(work.timings())) {
            device.push_back(*passes);
        }
        spent += frames.back();
    }
    const std::size_t count = frames.size();
    return {way, count, benchmark::spread_of(std::move(frames)).median,
            benchmark::spread_of(std::move(cpu)).median,
            device.empty() ? std::nullopt
                           : std::optional(benchmark::spread_of(std::move(device)).median)};
}

/// Measures rows one after the other; each way has a context of its own.
class GpuRace {
public:
    explicit GpuRace(const Settings& settings) : settings_(settings) {
        device_ = open().device_name();  // fails where there is none, before any work
    }

    GpuRow run(const GpuRowPlan& plan) {
        GpuRow row{plan.name, plan.has_pairs, plan.cells, 0, {}};
        for (const GpuRowPlan::Way& way : plan.ways) {
            const std::string key = (plan.has_pairs ? "pairs " : "field ") + way.name;
            if (too_slow_.count(key) != 0) {
                row.times.push_back({.way = way.name});
                continue;
            }
            try {
                run(way, row);
            } catch (const LibraryError& error) {
                if (error.code() != StatusCode::too_large) {
                    throw;
                }
                row.times.push_back({.way = way.name, .refusal = error.what()});
            }
            if (row.times.back().frame > too_long_ms) {
                too_slow_.insert(key);
            }
        }
        return row;
    }

    [[nodiscard]] const std::string& device_name() const { return device_; }

private:
    void run(const GpuRowPlan::Way& way, GpuRow& row) const {
        Context context = open();
        const std::unique_ptr<GpuWork> work = way.make(context);
        row.times.push_back(measure(*work, way.name));
        row.found = std::max(row.found, work->found());
        row.size = row.has_pairs ? std::max(row.size, work->pairs()) : row.size;
    }

    [[nodiscard]] Context open() const {
        AskedTechniques asked;
        asked.add(Technique::raster);
        asked.add(Technique::compute);
        return open_context(settings_, asked);
    }

    Settings settings_;
    std::string device_;
    std::set<std::string> too_slow_;
};

std::vector<GpuRowPlan> plans_with(const std::string& filter) {
    std::vector<GpuRowPlan> rows = gpu_rows();
    std::string names;
    for (const GpuRowPlan& row : rows) {
        names += "\n  " + row.name;
    }
    std::erase_if(
        rows, [&](const GpuRowPlan& row) { return row.name.find(filter) == std::string::npos; });
    if (rows.empty()) {
        throw InputError("--filter: no row of the table has \"" + filter +
                         "\" in its name; there are:" + names);
    }
    return rows;
}

}  // namespace

void run_gpu_table(const std::string& filter, const Settings& settings,
                   const std::optional<std::string>& json) {
    const std::vector<GpuRowPlan> plans = plans_with(filter);
    ReportTarget report(json);
    GpuRace race(settings);
    const Surroundings surroundings{benchmark::this_machine(), race.device_name(),
                                    benchmark::driver_of(race.device_name())};
    const bool show_progress = isatty(STDERR_FILENO) == 1;
    std::vector<GpuRow> rows;
    for (const GpuRowPlan& plan : plans) {
        if (show_progress) {
            std::cerr << "\r\x1b[Krow " << rows.size() + 1 << " of " << plans.size() << ": "
                      << plan.name << std::flush;
        }
        stop_after_ctrl_c();
        rows.push_back(race.run(plan));
    }
    if (show_progress) {
        std::cerr << "\r\x1b[K" << std::flush;
    }
    write_gpu_tables(report.summary(), rows, surroundings);
    if (std::ostream* const stream = report.json()) {
        write_gpu_json(*stream, rows, surroundings);
    }
    report.commit();
}

}  // namespace nearfield::tools
