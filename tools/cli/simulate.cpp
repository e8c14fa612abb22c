#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>
#include <tools/benchmark/measuring.hpp>
#include <tools/cli/options.hpp>
#include <tools/cli/simulate.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/drawing/view.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/world_report.hpp>
#include <tools/rendering/pictures.hpp>
#include <tools/rendering/vulkan_painter.hpp>
#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/simulation_choice.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

using simulation::ClearanceFrame;

/// The width of pictures and videos, pixels.
constexpr double frame_width = 960.0;

/// What paints pictures.
struct PaintingDevice {
    GpuInstance instance;
    Gpu gpu{instance};
};

/// The pictures of a run, in files or a video, if any are requested, and the device that paints
/// them.
class FrameOutput {
public:
    /// Throws InputError if a file cannot be written, NoGpu if there is no device to paint on.
    FrameOutput(const SimulateArguments& arguments, const View& view, double frame_time);

    /// The device that paints; null if no picture is requested.
    [[nodiscard]] const Gpu* gpu() const { return device_ ? &device_->gpu : nullptr; }

    /// Paints a frame if it is requested. `draw` is called only then.
    void add(std::uint32_t frame, const std::function<void(Drawing&)>& draw);
    void finish();

private:
    const SimulateArguments& arguments_;
    std::optional<FrameFiles> files_;
    std::optional<VideoFile> video_;
    std::optional<PaintingDevice> device_;
    std::optional<OffscreenPage> page_;
    Drawing drawing_;
};

FrameOutput::FrameOutput(const SimulateArguments& arguments, const View& view, double frame_time)
    : arguments_(arguments) {
    const auto width = static_cast<std::uint32_t>(view.page().max.x);
    const auto height = static_cast<std::uint32_t>(view.page().max.y);
    if (arguments.image) {
        files_.emplace(*arguments.image);
    }
    if (arguments.video) {
        video_.emplace(*arguments.video, width, height,
                       static_cast<std::uint32_t>(std::round(1.0 / frame_time)));
    }
    if (files_ || video_) {
        device_.emplace();
        page_.emplace(device_->gpu, width, height);
    }
}

void FrameOutput::add(std::uint32_t frame, const std::function<void(Drawing&)>& draw) {
    const bool in_a_file = files_ && (frame % arguments_.every == 0 || frame == arguments_.frames);
    if (!in_a_file && !video_) {
        return;
    }
    drawing_.clear();
    draw(drawing_);
    const FrameImage image = page_->paint(drawing_);
    if (in_a_file) {
        files_->write(frame, png_of(image));
    }
    if (video_) {
        video_->add(image.pixels);
    }
}

void FrameOutput::finish() {
    if (video_) {
        video_->finish();
    }
}

/// Runs frames 1, 2, ... until the last one or Ctrl-C, and shows the progress on a terminal;
/// returns the exit status.
int run_frames(std::uint32_t count, const std::function<void(std::uint32_t)>& run_frame) {
    const StatusLine line;
    for (std::uint32_t frame = 1; frame <= count; ++frame) {
        line.show("frame", frame, count);
        run_frame(frame);
        if (was_ctrl_c_pressed()) {
            break;
        }
    }
    return was_ctrl_c_pressed() ? exit_status::stopped : exit_status::done;
}

/// What a run of a scene of clearances asked and found, at least one frame.
struct ClearanceReport {
    const simulation::ClearanceScene& scene;
    std::vector<simulation::ClearanceFrame> frames;
};

/// The results of a simulation run.
struct SimulationReport {
    std::string scene;
    std::string response;
    std::string technique;
    std::string device;
    double tolerance = 0.0;
    std::size_t objects = 0;
    std::size_t lines = 0;
    unsigned steps = 0;  ///< per frame
    std::vector<simulation::FrameReport> frames;
};

void write_frame(JsonWriter& json, const ClearanceFrame& frame) {
    json.begin_object();
    json.member("time", frame.time);
    json.member("query_ms", frame.milliseconds);
    json.member("translation", frame.pose.translation);
    json.member("degrees", frame.pose.angle * 180.0 / std::numbers::pi);
    json.member("free_paths", frame.free_paths);
    json.member("best_path", frame.best_path);
    // An instance is the number of an obstacle.
    JsonRow row(json, [&frame](InstanceHandle /*handle*/) { return frame.neighbor; });
    write_cells(row, frame.clearance);
    json.end_object();
}

/// Of a frame's queries, in milliseconds.
template <class Report>
benchmark::Spread query_times(const Report& report) {
    std::vector<double> times;
    for (const auto& frame : report.frames) {
        if constexpr (requires { frame.queries; }) {
            times.push_back(frame.queries.milliseconds);
        } else {
            times.push_back(frame.milliseconds);
        }
    }
    return benchmark::spread_of(std::move(times));
}

double least_clearance(const ClearanceReport& report) {
    double least = report.frames.front().clearance.distance;
    for (const ClearanceFrame& frame : report.frames) {
        least = std::min(least, frame.clearance.distance);
    }
    return least;
}

/// Writes the run as JSON with a final line feed.
void write_clearance_json(std::ostream& stream, const ClearanceReport& report) {
    const simulation::ClearanceScene& scene = report.scene;
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("scene", scene.name());
    json.member("technique", to_string(Technique::cpu));
    json.key("device").null();
    json.member("min_clearance", scene.query().min_clearance);
    json.member("max_clearance", scene.query().max_clearance);
    json.member("objects", scene.obstacles().size());
    json.member("lines", scene.line_count());
    json.member("paths_a_frame", report.frames.back().paths);
    json.member("poses_a_frame", report.frames.back().poses);
    json.member("least_clearance", least_clearance(report));
    json.member("median_query_ms", query_times(report).median);
    json.list("frames", report.frames,
              [&json](const ClearanceFrame& frame) { write_frame(json, frame); });
    json.end_object();
    stream << '\n';
}

/// Writes the run as text, one item per line.
void write_clearance_summary(std::ostream& stream, const ClearanceReport& report) {
    const benchmark::Spread times = query_times(report);
    const ClearanceFrame& last = report.frames.back();
    const auto blocked = static_cast<std::size_t>(
        std::count_if(report.frames.begin(), report.frames.end(),
                      [](const ClearanceFrame& frame) { return frame.free_paths == 0; }));
    stream << "scene             " << report.scene.name() << ", technique "
           << to_string(Technique::cpu) << '\n'
           << "objects, lines    " << report.scene.obstacles().size() << ", "
           << report.scene.line_count() << '\n'
           << "frames            " << report.frames.size() << "; " << short_number(last.time)
           << " s\n"
           << "asked a frame     " << last.poses << " poses, " << last.paths << " paths\n"
           << "queries           " << short_number(times.median) << " ms a frame, median ("
           << short_number(times.lower_quartile) << " - " << short_number(times.upper_quartile)
           << ")\n"
           << "clearance         " << short_number(least_clearance(report)) << " at least; "
           << blocked << " frames without a free path\n"
           << "last frame        " << short_number(last.clearance.distance) << ", "
           << last.free_paths << " paths free\n";
}

double worst_penetration(const SimulationReport& report) {
    double worst = 0.0;
    for (const simulation::FrameReport& frame : report.frames) {
        worst = std::max(worst, frame.worst_penetration);
    }
    return worst;
}

void write_energies(JsonWriter& json, const simulation::Energies& energies) {
    json.key("energies").begin_object();
    json.member("kinetic", energies.kinetic);
    json.member("potential", energies.potential);
    json.member("elastic", energies.elastic);
    json.member("contact", energies.contact);
    json.member("total", energies.total());
    json.end_object();
}

void write_frame(JsonWriter& json, const simulation::FrameReport& frame) {
    json.begin_object();
    json.member("time", frame.time);
    write_energies(json, frame.energies);
    json.member("query_ms", frame.queries.milliseconds);
    json.member("queries", frame.queries.queries);
    json.member("batches", frame.queries.batches);
    json.member("contacts", frame.contacts);
    json.member("worst_penetration", frame.worst_penetration);
    json.member("events", frame.events);
    json.member("stopped", frame.stopped);
    json.end_object();
}

/// Writes the run as JSON with a final line feed.
void write_simulation_json(std::ostream& stream, const SimulationReport& report) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("scene", report.scene);
    json.member("response", report.response);
    json.member("technique", report.technique);
    json.member("device", report.device, !report.device.empty());
    json.member("tolerance", report.tolerance);
    json.member("objects", report.objects);
    json.member("lines", report.lines);
    json.member("steps_a_frame", report.steps);
    json.member("worst_penetration", worst_penetration(report));
    json.member("median_query_ms", query_times(report).median);
    write_energies(json, report.frames.back().energies);
    json.list("frames", report.frames,
              [&json](const simulation::FrameReport& frame) { write_frame(json, frame); });
    json.end_object();
    stream << '\n';
}

/// Writes the run as text, one item per line.
void write_simulation_summary(std::ostream& stream, const SimulationReport& report) {
    const benchmark::Spread times = query_times(report);
    const simulation::FrameReport& last = report.frames.back();
    std::size_t batches = 0;
    std::size_t stopped = 0;
    for (const simulation::FrameReport& frame : report.frames) {
        batches += frame.queries.batches;
        stopped += frame.stopped;
    }
    stream << "scene             " << report.scene << ", " << report.response << '\n'
           << "device            " << device_text(report.device) << ", technique "
           << report.technique << '\n'
           << "objects, lines    " << report.objects << ", " << report.lines << '\n'
           << "frames            " << report.frames.size() << ", " << report.steps
           << " steps each; " << short_number(last.time) << " s\n"
           << "queries           " << short_number(times.median) << " ms a frame, median ("
           << short_number(times.lower_quartile) << " - " << short_number(times.upper_quartile)
           << "); " << batches << " batches\n"
           << "penetration       " << short_number(worst_penetration(report)) << " at worst; d is "
           << short_number(report.tolerance) << '\n'
           << "energy            " << short_number(last.energies.total()) << " (kinetic "
           << short_number(last.energies.kinetic) << ")\n";
    if (stopped > 0) {
        stream << "waiting           " << stopped << " times a body, for the rest of a step\n";
    }
}

constexpr const char* default_response = "penalty";

simulation::World make_world(Context& context, const SimulateArguments& arguments,
                             simulation::Scene scene, simulation::Response response,
                             Technique technique) {
    try {
        return {context, std::move(scene), response, technique};
    } catch (const std::invalid_argument& error) {
        throw InputError("--response backtracking: " + arguments.scene + ": " + error.what());
    }
}

void draw_frame(Drawing& drawing, const SimulateArguments& arguments, Context& context,
                simulation::World& world, const View& view) {
    if (arguments.field) {
        drawing.cells(field_overlay(context, world, view, FieldOverlay::distance));
    }
    draw_bodies(drawing, world.scene(), view);
    // With more bodies than this, marks would hide them all.
    constexpr std::size_t max_bodies_with_marks = 100;
    if (world.scene().bodies.size() <= max_bodies_with_marks) {
        draw_observations(drawing, observe(world), view);
    }
}

SimulationReport report_of(const simulation::World& world, const SimulateArguments& arguments,
                           const Context& context, Technique technique) {
    const simulation::Scene& scene = world.scene();
    SimulationReport report;
    report.scene = scene.name;
    report.response = arguments.response.value_or(default_response);
    report.technique = to_string(technique);
    report.device = context.device_name();
    report.tolerance = scene.tolerance;
    report.objects = scene.bodies.size();
    report.lines = line_count(scene);
    report.steps = scene.steps;
    return report;
}

/// A world is asked for clearances, which the CPU answers exactly; no body is pushed.
void refuse_what_does_not_apply(const SimulateArguments& arguments) {
    const auto refuse = [&arguments](bool is_given, const std::string& option) {
        if (is_given) {
            throw InputError(option + ": does not apply to " + arguments.scene +
                             ", which asks a world for exact clearances and pushes no bodies");
        }
    };
    refuse(arguments.response.has_value(), "--response");
    refuse(arguments.bodies.has_value(), "--bodies");
    refuse(arguments.tolerance.has_value(), "--tolerance");
    refuse(arguments.field, "--field");
    refuse(arguments.settings.boxes.has_value(), "--boxes");
    refuse(arguments.settings.height.has_value(), "--height");
    refuse(arguments.settings.memory_limit.has_value(), "--memory-limit");
    const std::optional<Technique> technique = parse_technique_option(arguments.technique);
    refuse(technique && technique != Technique::cpu && technique != Technique::automatic,
           "--technique " + arguments.technique.value_or(""));
}

/// Runs a scene of clearances as run_simulate() does.
int run_clearances(const SimulateArguments& arguments,
                   const simulation::NamedClearanceScene& named) {
    refuse_what_does_not_apply(arguments);
    Context context = take(Context::create_cpu(parse_settings(arguments.settings)));
    const std::unique_ptr<simulation::ClearanceScene> scene = named.make(context);
    const View view = view_of(scene->view(), frame_width);
    catch_ctrl_c();
    ReportTarget target(arguments.json);
    FrameOutput output(arguments, view, simulation::ClearanceScene::frame_time);
    const auto draw = [&](Drawing& drawing) { draw_clearances(drawing, *scene, view); };

    ClearanceReport report{*scene, {}};
    output.add(0, draw);
    const int status = run_frames(arguments.frames, [&](std::uint32_t frame) {
        scene->advance();
        report.frames.push_back(scene->frame());
        output.add(frame, draw);
    });
    output.finish();
    if (std::ostream* json = target.json()) {
        write_clearance_json(*json, report);
    }
    write_clearance_summary(target.summary(), report);
    target.commit();
    return status;
}

}  // namespace

CLI::App* add_simulate_command(CLI::App& program, SimulateArguments& arguments) {
    CLI::App* command =
        program.add_subcommand("simulate", "Run one of the paper's simulations, or another scene");
    command
        ->add_option("scene", arguments.scene,
                     "map, gears, links, cars or wavy, as in the paper; overlap: the bars of wavy, "
                     "far inside each other; pour: 1,000 stars; nest: an item dragged over others "
                     "in a strip; robots: paths between islands; required")
        ->required()
        ->type_name("NAME");
    command
        ->add_option("--response", arguments.response,
                     "penalty (forces at points inside the other body) or backtracking (to just "
                     "before a contact, and impulses there); default penalty; not of nest and "
                     "robots")
        ->type_name("NAME");
    add_count_option(*command, "--frames", arguments.frames, {1, 10'000'000},
                     "How many frames; default 300")
        ->type_name("COUNT");
    add_count_option(*command, "--bodies", arguments.bodies, {1, 1000},
                     "Of pour: how many stars; default 1000")
        ->type_name("COUNT");
    command
        ->add_option("-d,--tolerance", arguments.tolerance,
                     "Tolerance d of the queries; default as the scene has it")
        ->type_name("LENGTH");
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic; default automatic")
        ->type_name("NAME");
    add_settings_options(*command, arguments.settings);
    CLI::Option* const image =
        add_parsed_option(*command, "--image", arguments.image, parse_png_name,
                          "Draw frames into these files: %d, or %04d with the number of digits, "
                          "stands for the frame's number; default none")
            ->type_name("PATTERN.png");
    add_count_option(*command, "--every", arguments.every, {1, 10'000'000},
                     "Draw frames whose number this divides, and the last one; default 1")
        ->type_name("COUNT")
        ->needs(image);
    command
        ->add_option("--video", arguments.video,
                     "Draw all frames into a video, by the program ffmpeg; default none")
        ->type_name("FILE");
    command->add_flag("--field", arguments.field,
                      "Draw the distance to the nearest body behind them; not of nest and robots");
    command
        ->add_option("--json", arguments.json,
                     "Write energies, query times and the worst penetration of each frame as JSON, "
                     "of nest and robots the clearances; - for the standard output, the summary "
                     "then goes to the standard error; default none")
        ->type_name("FILE|-");
    return command;
}

int run_simulate(const SimulateArguments& arguments) {
    if (const auto* const clearances = find_clearance_scene(arguments.scene)) {
        return run_clearances(arguments, *clearances);
    }
    simulation::Scene scene = make_scene(arguments.scene, arguments.tolerance, arguments.bodies);
    const simulation::Response response = parse_name<simulation::Response>(
        arguments.response.value_or(default_response), "--response");
    const Technique technique =
        parse_technique_option(arguments.technique).value_or(Technique::automatic);
    const Settings settings = parse_settings(arguments.settings);
    const View view = view_of(scene.view, frame_width);
    catch_ctrl_c();
    ReportTarget target(arguments.json);
    FrameOutput output(arguments, view, scene.frame_time);
    AskedTechniques asked;
    asked.add(technique);
    Context context = output.gpu() != nullptr && technique != Technique::cpu
                          ? take(Context::create(output.gpu()->host_device(), settings))
                          : open_context(settings, asked);
    simulation::World world = make_world(context, arguments, std::move(scene), response, technique);

    SimulationReport report = report_of(world, arguments, context, technique);
    const auto draw = [&](Drawing& drawing) {
        draw_frame(drawing, arguments, context, world, view);
    };
    output.add(0, draw);
    const int status = run_frames(arguments.frames, [&](std::uint32_t frame) {
        report.frames.push_back(world.advance());
        output.add(frame, draw);
    });
    output.finish();
    if (std::ostream* json = target.json()) {
        write_simulation_json(*json, report);
    }
    write_simulation_summary(target.summary(), report);
    target.commit();
    return status;
}

}  // namespace nearfield::tools
