#include <nearfield/context.hpp>
#include <nearfield/device_poses.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/cli/bench.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/rendering/gpu.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The rows of the table of a GPU, and how each way does its work.

namespace nearfield::tools {
namespace {

using benchmark::Surroundings;
using benchmark::three_digits;

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
constexpr double crowd_tolerance = 0.01;
constexpr std::size_t field_vertices = 8000;
constexpr double field_window = 3.0;  ///< side of the square around the coast line

/// One batch a frame, as of `nearfield bench --scene --keep`.
class BatchWork : public GpuWork {
public:
    BatchWork(Scene scene, Technique technique, Context& context) : scene_(std::move(scene)) {
        set_technique(scene_, technique);
        runner_.emplace(scene_, "bench", context);
    }

    void run_frame() override {
        runner_->run_frame(FrameInput::poses);
        runner_->require_results();
    }
    [[nodiscard]] const Timings& timings() const override { return runner_->timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return runner_->pair_count(); }
    [[nodiscard]] std::uint64_t found() const override {
        std::uint64_t found = 0;
        for (const SceneAnswer& answer : runner_->answers()) {
            if (const auto* const points = std::get_if<PenetrationResult>(&answer.result)) {
                found += points->count;
            }
        }
        return found;
    }

private:
    Scene scene_;
    std::optional<SceneRunner> runner_;
};

/// What becomes of the rows that the device finds.
enum class Rows : std::uint8_t {
    unread,
    read,      // each, by the host
    resident,  // they and their records stay on the device, from where the poses come too
};

/// A world of which the device finds the pairs.
class DevicePairWork : public GpuWork {
public:
    DevicePairWork(const Scene& scene, Rows rows, Context& context, const Gpu& gpu)
        : context_(context),
          world_(take(World::create(context))),
          table_({.tolerance = crowd_tolerance,
                  .summary_only = true,
                  .on_device = rows == Rows::resident},
                 {.hits_only = true, .technique = Technique::compute}),
          rows_(rows) {
        for (const SceneShape& shape : scene.shapes) {
            shapes_.push_back(take(add_shape(context, shape.rings, shape.deviation)));
        }
        for (const SceneInstance& instance : scene.instances) {
            poses_.push_back(instance.pose);
            handles_.push_back(
                take(world_.add({.shape = shapes_[instance.shape], .pose = instance.pose})));
        }
        if (rows == Rows::resident) {
            place_on_device(gpu);
        }
    }
    ~DevicePairWork() override {
        for (const ShapeHandle shape : shapes_) {
            static_cast<void>(context_.remove_shape(shape));  // fails only for an unknown shape
        }
    }
    DevicePairWork(const DevicePairWork&) = delete;
    DevicePairWork& operator=(const DevicePairWork&) = delete;

    void run_frame() override {
        if (rows_ == Rows::resident) {
            require(world_.update(table_, {.poses = &device_poses_}), "bench");
            return;
        }
        for (Pose& pose : poses_) {
            pose.translation.x =
                std::nextafter(pose.translation.x, std::numeric_limits<double>::infinity());
        }
        require(world_.move(handles_, poses_), "bench");
        require(world_.update(table_), "bench");
        if (rows_ == Rows::read) {
            found_ = 0;
            for (const PairRow<PenetrationQuery>& row : table_.rows()) {
                found_ += row.count;
            }
            require(table_.read_status(), "bench");
        }
    }
    [[nodiscard]] const Timings& timings() const override { return table_.timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return table_.candidates(); }
    [[nodiscard]] std::uint64_t found() const override { return found_; }

private:
    /// Puts the poses into a buffer, as the host's own commands would in each frame.
    void place_on_device(const Gpu& gpu) {
        constexpr auto usage = vk::BufferUsageFlagBits::eStorageBuffer;
        buffer_ = HostBuffer(gpu, poses_.size() * 4 * sizeof(float), usage);
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const Pose& pose = poses_[i];
            const std::array<float, 4> element{
                static_cast<float>(pose.translation.x), static_cast<float>(pose.translation.y),
                static_cast<float>(std::cos(pose.angle)), static_cast<float>(std::sin(pose.angle))};
            std::memcpy(buffer_.bytes().data() + handles_[i].index * sizeof(element), &element,
                        sizeof(element));
        }
        device_poses_ = {.buffer = buffer_.get(),
                         .size = buffer_.bytes().size(),
                         .usage = static_cast<VkBufferUsageFlags>(usage)};
    }

    Context& context_;
    HostBuffer buffer_;  // destroyed after the table
    World world_;
    PairTable<PenetrationQuery> table_;
    Rows rows_;
    DevicePoses device_poses_;
    std::vector<ShapeHandle> shapes_;
    std::vector<InstanceHandle> handles_;
    std::vector<Pose> poses_;
    std::uint64_t found_ = 0;
};

/// A field by compute that stays on the device.
class ResidentFieldWork : public GpuWork {
public:
    ResidentFieldWork(std::size_t cells, Context& context) : context_(context) {
        const QueryRequest request = benchmark::square_field({}, field_window, cells);
        const std::vector<Ring> rings{benchmark::coast(1, field_vertices)};
        shape_ = take(add_shape(context, rings, 0.0));
        batch_.add(DistanceFieldQuery{.b = {shape_, {}},
                                      .tolerance = request.tolerance,
                                      .rectangle = request.rectangle,
                                      .values = false,
                                      .technique = Technique::compute,
                                      .on_device = true,
                                      .features_on_device = false});
    }
    ~ResidentFieldWork() override {
        static_cast<void>(context_.remove_shape(shape_));  // fails only for an unknown shape
    }
    ResidentFieldWork(const ResidentFieldWork&) = delete;
    ResidentFieldWork& operator=(const ResidentFieldWork&) = delete;

    void run_frame() override {
        require(context_.run(batch_, results_), "bench");
        require(std::get<DistanceFieldResult>(results_.results.front()).status, "bench");
    }
    [[nodiscard]] const Timings& timings() const override { return results_.timings; }
    [[nodiscard]] std::uint64_t pairs() const override { return 0; }
    [[nodiscard]] std::uint64_t found() const override { return 0; }

private:
    Context& context_;
    ShapeHandle shape_;
    Batch batch_;
    Results results_;
};

GpuRowPlan::Way batch_way(const char* name, Technique technique, std::function<Scene()> scene) {
    return {name, technique != Technique::cpu,
            [technique, scene = std::move(scene)](Context& context, const Gpu&) {
                return std::make_unique<BatchWork>(scene(), technique, context);
            }};
}

GpuRowPlan crowd_row(std::size_t objects) {
    const auto scene = [objects] {
        QueryRequest request = benchmark::boundary_penetration(crowd_tolerance);
        request.records = false;
        return benchmark::asked(benchmark::crowd_scene(objects), request, benchmark::Pairs::all);
    };
    const auto of_world = [objects](Rows rows) {
        return [objects, rows](Context& context, const Gpu& gpu) {
            return std::make_unique<DevicePairWork>(benchmark::crowd_scene(objects), rows, context,
                                                    gpu);
        };
    };
    return {"crowd of " + std::to_string(objects) + " objects",
            true,
            0,
            {batch_way("cpu", Technique::cpu, scene),
             batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene),
             {"device pairs", true, of_world(Rows::unread)},
             {"device pairs, read", true, of_world(Rows::read)},
             {"device pairs, resident", true, of_world(Rows::resident)}}};
}

GpuRowPlan field_row(std::size_t cells) {
    const auto scene = [cells] {
        Scene alone;
        benchmark::add_object(alone, {benchmark::coast(1, field_vertices)}, {});
        return benchmark::asked(std::move(alone), benchmark::square_field({}, field_window, cells),
                                0, 0);
    };
    return {"field " + std::to_string(cells) + " x " + std::to_string(cells),
            false,
            std::uint64_t{cells} * cells,
            {batch_way("cpu", Technique::cpu, scene),
             batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene),
             {"compute, resident", true, [cells](Context& context, const Gpu&) {
                  return std::make_unique<ResidentFieldWork>(cells, context);
              }}}};
}

/// All rows, smaller ones first.
std::vector<GpuRowPlan> gpu_rows() {
    std::vector<GpuRowPlan> rows;
    for (const std::size_t objects : {420U, 1000U, 4200U, 12'500U, 42'000U}) {
        rows.push_back(crowd_row(objects));
    }
    for (const std::size_t cells : {256U, 512U, 1024U, 2048U, 4096U}) {
        rows.push_back(field_row(cells));
    }
    return rows;
}

std::string cell(const GpuTime& time) {
    if (time.frames == 0) {
        return time.refusal.empty() ? "-" : "refused";
    }
    return three_digits(time.frame) + "; " + three_digits(time.cpu) + "; " +
           (time.device ? three_digits(*time.device) : "-");
}

/// Writes rows of one kind.
void write_table(std::ostream& stream, std::span<const GpuRow> rows) {
    const bool of_pairs = rows.front().has_pairs;
    stream << (of_pairs ? "\n| row | ordered pairs | points" : "\n| row | cells");
    std::string rule = of_pairs ? "\n|---|---|---|" : "\n|---|---|";
    for (const GpuTime& time : rows.front().times) {
        stream << " | " << time.way;
        rule += "---|";
    }
    stream << " |" << rule << '\n';
    for (const GpuRow& row : rows) {
        // Of a row that was answered in no way nothing was counted.
        stream << "| " << row.name << " | " << (row.size > 0 ? std::to_string(row.size) : "-");
        if (of_pairs) {
            stream << " | " << (row.size > 0 ? std::to_string(row.found) : "-");
        }
        for (const GpuTime& time : row.times) {
            stream << " | " << cell(time);
        }
        stream << " |\n";
    }
}

/// Writes the first row from which on each way takes less time than `cpu`.
void write_crossovers(std::ostream& stream, std::span<const GpuRow> rows) {
    stream << '\n';
    for (std::size_t way = 1; way < rows.front().times.size(); ++way) {
        bool is_measured = false;
        const GpuRow* from = nullptr;
        for (const GpuRow& row : rows) {
            if (row.times[way].frames > 0) {
                is_measured = true;
                const bool is_faster = row.times[way].frame < row.times.front().frame;
                from = is_faster ? (from != nullptr ? from : &row) : nullptr;
            }
        }
        if (is_measured) {
            stream << "* " << rows.front().times[way].way << ": "
                   << (from != nullptr ? "faster than cpu from " + from->name + " on"
                                       : "not faster than cpu in the largest row measured")
                   << '\n';
        }
    }
}

void write_refusals(std::ostream& stream, std::span<const GpuRow> rows) {
    for (const GpuRow& row : rows) {
        for (const GpuTime& time : row.times) {
            if (!time.refusal.empty()) {
                stream << "* " << row.name << " by " << time.way << ": " << time.refusal << '\n';
            }
        }
    }
}

void write_time(JsonWriter& json, const GpuTime& time) {
    json.key(time.way);
    if (!time.refusal.empty()) {
        json.begin_object().member("refused", time.refusal).end_object();
        return;
    }
    if (time.frames == 0) {
        json.null();
        return;
    }
    json.begin_object();
    json.member("frames", time.frames);
    json.member("median_ms", time.frame);
    json.member("cpu_ms", time.cpu);
    json.member("device_ms", time.device);
    write_passes(json, "passes_ms", time.passes);
    json.end_object();
}

/// Writes the tables, and from which row on the device is faster, in Markdown.
void write_gpu_tables(std::ostream& stream, std::span<const GpuRow> rows,
                      const Surroundings& surroundings) {
    write_surroundings(stream, surroundings);
    stream << "\n\n"
           << "Medians, milliseconds: a whole frame; of it processor time of the calling thread; "
              "passes on the device, by timestamps of other frames.\n"
           << "Crowds: penetration of boundary samples, summaries, all objects move. `device "
              "pairs`: the rows stay unread; `read`: each is read; `resident`: they stay on the "
              "device with their records, and poses come from a buffer there.\n"
           << "Fields: values at the cells around a coast line of 8,000 vertices, read back; "
              "`resident`: in an image on the device. `-`: left out, since a smaller row took more "
              "than two seconds.\n";
    // Rows of pairs come before those of fields.
    const auto fields = static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const GpuRow& row) { return row.has_pairs; }));
    for (const std::span<const GpuRow> of_kind : {rows.first(fields), rows.subspan(fields)}) {
        if (!of_kind.empty()) {
            write_table(stream, of_kind);
            write_crossovers(stream, of_kind);
        }
    }
    write_refusals(stream, rows);
}

/// Writes the same as JSON with a final line feed.
void write_gpu_json(std::ostream& stream, std::span<const GpuRow> rows,
                    const Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    write_surroundings(json, surroundings);
    json.member("driver", surroundings.driver);
    json.list("rows", rows, [&json](const GpuRow& row) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", row.name);
        json.member(row.has_pairs ? "pairs" : "cells", row.size);
        if (row.has_pairs) {
            json.member("points", row.found);
        }
        json.key("times").begin_object(JsonWriter::Layout::lines);
        for (const GpuTime& time : row.times) {
            write_time(json, time);
        }
        json.end_object();
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

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

}  // namespace

void run_gpu_table(const std::string& filter, const Settings& settings,
                   const std::optional<std::string>& json) {
    const std::vector<GpuRowPlan> plans = benchmark::rows_with(filter, gpu_rows());
    ReportTarget report(json);
    GpuRace race(settings);
    const Surroundings surroundings = benchmark::surroundings_of(race.device_name());
    const StatusLine line;
    std::vector<GpuRow> rows;
    for (const GpuRowPlan& plan : plans) {
        line.show("row", rows.size() + 1, plans.size(), plan.name);
        stop_after_ctrl_c();
        rows.push_back(race.run(plan));
    }
    write_gpu_tables(report.summary(), rows, surroundings);
    if (std::ostream* const stream = report.json()) {
        write_gpu_json(*stream, rows, surroundings);
    }
    report.commit();
}

}  // namespace nearfield::tools
