#include <tools/benchmark/machine.hpp>
#include <tools/benchmark/median_timings.hpp>
#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/benchmark/spread.hpp>
#include <tools/cli/gpu_report.hpp>
#include <tools/cli/gpu_table.hpp>
#include <tools/cli/gpu_times.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <tools/rendering/gpu.hpp>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <set>
#include <stdexcept>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr double too_long_ms = 2000.0;  ///< a way whose frame takes more has no larger rows
constexpr double enough_ms = 500.0;     ///< of measured frames
constexpr std::size_t max_frames = 300;
constexpr std::size_t min_frames = 3;
constexpr std::size_t warm_up = 2;
/// Of frames before any is measured: GPUs lower their clock to a fifth while they wait for a CPU
/// that makes a scene, and take this long to raise it again.
constexpr double warm_up_ms = 500.0;
constexpr std::size_t max_timed_frames = 15;  ///< for the times of passes

double processor_ms() {
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) {
        throw std::runtime_error("this system does not tell a thread's processor time");
    }
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void warm_up_with(GpuWork& work) {
    double spent = 0.0;
    for (std::size_t frame = 0; frame < warm_up || spent < warm_up_ms; ++frame) {
        stop_after_ctrl_c();
        spent += benchmark::milliseconds_of([&] { work.run_frame(); });
    }
}

GpuTime measure(GpuWork& work, const std::string& way) {
    warm_up_with(work);
    std::vector<double> frames;
    std::vector<double> cpu;
    double spent = 0.0;
    while (frames.size() < min_frames || (frames.size() < max_frames && spent < enough_ms)) {
        stop_after_ctrl_c();
        const double begin = processor_ms();
        frames.push_back(benchmark::milliseconds_of([&] { work.run_frame(); }));
        cpu.push_back(processor_ms() - begin);
        spent += frames.back();
    }
    const std::size_t count = frames.size();
    return {.way = way,
            .frames = count,
            .frame = benchmark::spread_of(std::move(frames)).median,
            .cpu = benchmark::spread_of(std::move(cpu)).median};
}

/// Measures rows one after the other; each way has a context of its own, on the same device.
class GpuRace {
public:
    /// Fails where there is no device, before any work.
    explicit GpuRace(const Settings& settings)
        : settings_(settings), device_(open(false).device_name()) {}

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
        Context context = open(false);
        const std::unique_ptr<GpuWork> work = way.make(context, gpu_);
        GpuTime time = measure(*work, way.name);
        if (way.uses_device) {
            time_passes(way, time);
        }
        row.times.push_back(std::move(time));
        row.found = std::max(row.found, work->found());
        row.size = row.has_pairs ? std::max(row.size, work->pairs()) : row.size;
    }

    /// In frames of their own, since timestamps take time.
    void time_passes(const GpuRowPlan::Way& way, GpuTime& time) const {
        Context context = open(true);
        const std::unique_ptr<GpuWork> work = way.make(context, gpu_);
        warm_up_with(*work);
        std::vector<Timings> frames;
        double spent = 0.0;
        while (frames.size() < min_frames ||
               (frames.size() < max_timed_frames && spent < enough_ms)) {
            stop_after_ctrl_c();
            spent += benchmark::milliseconds_of([&] { work->run_frame(); });
            frames.push_back(work->timings());
        }
        time.passes = benchmark::median_timings(frames, frames.size()).passes;
        time.device = benchmark::sum_of(time.passes);
    }

    [[nodiscard]] Context open(bool timestamps) const {
        Settings settings = settings_;
        settings.pipelines_on_demand = true;
        settings.timestamps = timestamps;
        return take(Context::create(gpu_.host_device(), settings));
    }

    Settings settings_;
    GpuInstance instance_;
    Gpu gpu_{instance_};
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
