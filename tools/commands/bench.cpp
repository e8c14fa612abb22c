#include <nearfield/context.hpp>

#include <tools/commands/bench.hpp>
#include <tools/commands/library_error.hpp>
#include <tools/commands/scene_runner.hpp>
#include <tools/input/input_error.hpp>
#include <tools/input/scene.hpp>
#include <tools/output/answer.hpp>
#include <tools/output/query_json.hpp>
#include <tools/output/report_target.hpp>
#include <tools/output/summary.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : std::midpoint(values[half - 1], values[half]);
}

/// The median over all frames of what `get` picks from each.
template <class Get>
double median_of(const std::vector<Timings>& frames, Get get) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const Timings& frame : frames) {
        values.push_back(get(frame));
    }
    return median(std::move(values));
}

/// Stage by stage and pass by pass. Every frame has the passes of the first: the queries are the
/// same.
Timings median_timings(const std::vector<Timings>& frames) {
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

/// What was measured.
struct Measurement {
    std::vector<double> frames_ms;
    Timings timings;
};

Measurement measure(SceneRunner& runner, const BenchArguments& arguments) {
    const bool show_progress = isatty(STDERR_FILENO) == 1;
    Measurement measurement;
    std::vector<Timings> timings;
    const std::uint64_t all = std::uint64_t{arguments.warm_up} + arguments.frames;
    for (std::uint64_t frame = 0; frame < all; ++frame) {
        if (show_progress) {
            std::cerr << "\rframe " << frame + 1 << " of " << all << std::flush;
        }
        const double milliseconds = runner.run_frame();
        runner.require_results();
        if (frame >= arguments.warm_up) {
            measurement.frames_ms.push_back(milliseconds);
            timings.push_back(runner.timings());
        }
    }
    if (show_progress) {
        std::cerr << '\n';
    }
    measurement.timings = median_timings(timings);
    return measurement;
}

void write_bench_json(std::ostream& stream, const Measurement& measurement,
                      const BenchArguments& arguments, const std::string& device,
                      std::string_view technique) {
    const auto [fastest, slowest] =
        std::minmax_element(measurement.frames_ms.begin(), measurement.frames_ms.end());
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.key("scene").value(std::string_view(arguments.scene));
    json.key("device").value(std::string_view(device));
    json.key("technique").value(technique);
    json.key("frames").value(std::uint64_t{arguments.frames});
    json.key("median_ms").value(median(measurement.frames_ms));
    json.key("min_ms").value(*fastest);
    json.key("max_ms").value(*slowest);
    write_timings(json, measurement.timings);
    json.end_object();
    stream << '\n';
}

void write_bench_summary(std::ostream& stream, const Measurement& measurement, const Scene& scene,
                         const std::string& device, std::string_view technique) {
    const auto [fastest, slowest] =
        std::minmax_element(measurement.frames_ms.begin(), measurement.frames_ms.end());
    stream << "device            " << device << '\n'
           << "technique         " << technique << '\n'
           << "queries           " << scene.queries.size() << '\n'
           << "frames            " << measurement.frames_ms.size() << '\n'
           << "median            " << short_number(median(measurement.frames_ms)) << " ms a frame ("
           << short_number(*fastest) << " to " << short_number(*slowest) << ")\n";
    write_timings_summary(stream, measurement.timings);
}

}  // namespace

CLI::App* add_bench_command(CLI::App& program, BenchArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "bench", "Run the queries of a scene as one batch a frame and report median times (ms)");
    command
        ->add_option("--scene", arguments.scene,
                     "Scene: shapes, instances (shape and pose) and queries; required")
        ->required()
        ->type_name("FILE.json");
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic, of all queries; default as the scene says")
        ->type_name("NAME");
    add_localization_options(*command, arguments.localization);
    command->add_option("--frames", arguments.frames, "Frames that are measured; default 50")
        ->type_name("COUNT")
        ->check(CLI::Range(1U, 1'000'000U));
    command
        ->add_option("--warmup", arguments.warm_up,
                     "Frames before them that are not measured; default 5")
        ->type_name("COUNT")
        ->check(CLI::Range(0U, 1'000'000U));
    command
        ->add_option("--json", arguments.json,
                     "Write the times as JSON, milliseconds; - for the standard output, the "
                     "summary then goes to the standard error; default none")
        ->type_name("FILE|-");
    return command;
}

void run_bench(const BenchArguments& arguments) {
    const std::optional<Technique> technique = parse_technique_option(arguments.technique);
    const Settings settings = parse_settings(arguments.localization);
    Scene scene = read_scene(arguments.scene);
    set_technique(scene, technique);
    if (scene.queries.empty()) {
        throw InputError(arguments.scene + ": queries: there is none to measure");
    }
    ReportTarget report(arguments.json);
    Context context = take(Context::create_headless({}, settings));
    SceneRunner runner(scene, arguments.scene, context);
    const Measurement measurement = measure(runner, arguments);
    if (std::ostream* json = report.json()) {
        write_bench_json(*json, measurement, arguments, context.device_name(), runner.technique());
    }
    write_bench_summary(report.summary(), measurement, scene, context.device_name(),
                        runner.technique());
    report.commit();
}

}  // namespace nearfield::tools
