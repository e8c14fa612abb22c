#include <nearfield/context.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/cli/bench.hpp>
#include <tools/cli/options.hpp>
#include <tools/cli/scene.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/scene.hpp>

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// The result of a measurement.
struct Measurement {
    benchmark::Spread frame_ms;
    double slowest_ms = 0.0;
    Timings timings;
    std::size_t pairs = 0;         ///< of one frame, each query of a pair
    std::size_t world_inputs = 0;  ///< poses, points and so on of queries of all instances
};

Measurement measure(SceneRunner& runner, const BenchArguments& arguments) {
    const StatusLine line;
    std::vector<double> frames_ms;
    std::vector<Timings> timings;
    const std::uint64_t all = std::uint64_t{arguments.warm_up} + arguments.frames;
    for (std::uint64_t frame = 0; frame < all; ++frame) {
        line.show("frame", frame + 1, all);
        stop_after_ctrl_c();
        const double milliseconds =
            runner.run_frame(arguments.keep ? FrameInput::poses : FrameInput::all);
        runner.require_results();
        if (frame >= arguments.warm_up) {
            frames_ms.push_back(milliseconds);
            timings.push_back(runner.timings());
        }
    }
    return {benchmark::spread_of(frames_ms), *std::max_element(frames_ms.begin(), frames_ms.end()),
            benchmark::median_timings(timings, timings.size()), runner.pair_count(),
            runner.world_input_count()};
}

void write_bench_json(std::ostream& stream, const Measurement& measurement,
                      const BenchArguments& arguments, const std::string& device,
                      std::string_view technique) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("scene", arguments.scene);
    json.member("device", device, !device.empty());
    json.member("technique", technique);
    json.member("pairs", measurement.pairs);
    json.member("world_inputs", measurement.world_inputs);
    json.member("keep", arguments.keep);
    json.member("frames", arguments.frames);
    json.member("median_ms", measurement.frame_ms.median);
    json.member("min_ms", measurement.frame_ms.least);
    json.member("max_ms", measurement.slowest_ms);
    write_timings(json, measurement.timings);
    json.end_object();
    stream << '\n';
}

void write_bench_summary(std::ostream& stream, const Measurement& measurement, const Scene& scene,
                         bool keep, const std::string& device, std::string_view technique) {
    stream << "device            " << device_text(device) << '\n'
           << "technique         " << technique << '\n'
           << "queries           " << scene.queries.size() << '\n'
           << "pairs             " << measurement.pairs << '\n';
    if (measurement.world_inputs > 0) {
        stream << "world inputs      " << measurement.world_inputs << '\n';
    }
    stream << "frames            " << measurement.frame_ms.count << (keep ? ", shapes kept" : "")
           << '\n'
           << "median            " << short_number(measurement.frame_ms.median) << " ms a frame ("
           << short_number(measurement.frame_ms.least) << " to "
           << short_number(measurement.slowest_ms) << ")\n";
    write_timings_summary(stream, measurement.timings);
}

/// Timestamps take time, so frames that are measured have none.
Settings untimed(const BenchArguments& arguments) {
    Settings settings = parse_settings(arguments.settings);
    settings.timestamps = false;
    return settings;
}

/// Medians of a few frames of their own, with timestamps.
std::vector<PassTime> passes_of(const Scene& scene, const BenchArguments& arguments,
                                const Settings& settings) {
    Context context = open_context(settings, techniques_of(scene));
    SceneRunner runner(scene, arguments.scene, context);
    BenchArguments few = arguments;
    few.frames = std::min<std::uint32_t>(arguments.frames, 9);
    few.warm_up = std::min<std::uint32_t>(arguments.warm_up, 2);
    return measure(runner, few).timings.passes;
}

/// Of the largest rows, unless the user sets another limit.
constexpr std::uint64_t memory_of_gpu_table = std::uint64_t{4} << 30U;

/// Of the frames of a scene.
void add_frame_options(CLI::App& command, BenchArguments& arguments, CLI::Option* scene) {
    add_count_option(command, "--frames", arguments.frames, {1, 1'000'000},
                     "Frames that are measured; default 50")
        ->type_name("COUNT")
        ->needs(scene);
    add_count_option(command, "--warmup", arguments.warm_up, {0, 1'000'000},
                     "Frames before them that are not measured; default 5")
        ->type_name("COUNT")
        ->needs(scene);
    command
        .add_flag("--keep", arguments.keep,
                  "Frames in which only poses change: the shapes are passed once, before the "
                  "first one; default: every frame passes all vertices anew")
        ->needs(scene);
}

}  // namespace

CLI::App* add_bench_command(CLI::App& program, BenchArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "bench",
        "Report median times (ms) of whole frames: of the standard table, or of a scene's queries "
        "as one batch a frame");
    CLI::Option* const scene =
        command
            ->add_option("--scene", arguments.scene,
                         "Scene: shapes, instances (shape and pose) and queries; default: the "
                         "standard table, by each technique")
            ->type_name("FILE.json");
    CLI::Option* const filter =
        command
            ->add_option(
                "--filter", arguments.filter,
                "Only the rows of the standard table, or of --gpu, whose names hold this text")
            ->type_name("TEXT")
            ->excludes(scene);
    CLI::Option* const paper =
        command
            ->add_flag("--paper", arguments.paper,
                       "The paper's Tables 2 and 3: proximity queries of its simulations, by each "
                       "technique, the paper's figures beside them")
            ->excludes(scene)
            ->excludes(filter);
    command
        ->add_flag("--gpu", arguments.gpu,
                   "The amount of work from which a GPU is faster than the CPU: 1,000 to 100,000 "
                   "pairs and fields of 256 to 4096 cells a side, by each technique; takes minutes "
                   "on a software device; --memory-limit is 4096 by default")
        ->excludes(scene)
        ->excludes(paper);
    add_parsed_option(*command, "--curves", arguments.curves, parse_png_name,
                      "Of --paper: draw how times grow with lines and tolerance; default none")
        ->type_name("FILE.png")
        ->needs(paper);
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic, of all queries, those of all instances "
                     "included; default as the scene says")
        ->type_name("NAME")
        ->needs(scene);
    add_settings_options(*command, arguments.settings);
    add_frame_options(*command, arguments, scene);
    command
        ->add_option("--json", arguments.json,
                     "Write the times as JSON, milliseconds; - for the standard output, the "
                     "summary then goes to the standard error; default none")
        ->type_name("FILE|-");
    return command;
}

void run_bench(const BenchArguments& arguments) {
    catch_ctrl_c();
    if (arguments.paper) {
        run_paper_tables(untimed(arguments), arguments.json, arguments.curves);
        return;
    }
    if (arguments.gpu) {
        Settings settings = untimed(arguments);
        if (!arguments.settings.memory_limit) {
            settings.memory_limit = memory_of_gpu_table;
        }
        run_gpu_table(arguments.filter, settings, arguments.json);
        return;
    }
    if (arguments.scene.empty()) {
        run_standard_table(arguments.filter, untimed(arguments), arguments.json);
        return;
    }
    const std::optional<Technique> technique = parse_technique_option(arguments.technique);
    Settings settings = untimed(arguments);
    Scene scene = read_scene(arguments.scene);
    print_notes(scene);
    set_technique(scene, technique);
    if (scene.queries.empty()) {
        throw InputError(arguments.scene + ": queries: there is none to measure");
    }
    ReportTarget report(arguments.json);
    Context context = open_context(settings, techniques_of(scene));
    SceneRunner runner(scene, arguments.scene, context);
    Measurement measurement = measure(runner, arguments);
    if (!context.device_name().empty()) {
        settings.timestamps = true;
        measurement.timings.passes = passes_of(scene, arguments, settings);
    }
    if (std::ostream* json = report.json()) {
        write_bench_json(*json, measurement, arguments, context.device_name(), runner.technique());
    }
    write_bench_summary(report.summary(), measurement, scene, arguments.keep, context.device_name(),
                        runner.technique());
    report.commit();
}

}  // namespace nearfield::tools
