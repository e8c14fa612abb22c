#include <nearfield/context.hpp>

#include <tools/cli/open_context.hpp>
#include <tools/cli/simulate.hpp>
#include <tools/cli/simulation_report.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/frame_files.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <tools/io/video_file.hpp>
#include <tools/rendering/page.hpp>
#include <tools/rendering/scene_picture.hpp>
#include <tools/simulation/simulation_choice.hpp>
#include <tools/simulation/world.hpp>
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr double frame_width = 960.0;

simulation::World make_world(Context& context, const SimulateArguments& arguments,
                             simulation::Scene scene, simulation::Response response,
                             Technique technique) {
    try {
        return {context, std::move(scene), response, technique};
    } catch (const std::invalid_argument& error) {
        throw InputError("--response backtracking: " + arguments.scene + ": " + error.what());
    }
}

/// The destinations of the requested frames.
struct Outputs {
    std::optional<FrameFiles> files;
    std::optional<VideoFile> video;

    Outputs(const SimulateArguments& arguments, const simulation::Scene& scene, const View& view) {
        if (arguments.image) {
            files.emplace(*arguments.image);
        }
        if (arguments.video) {
            video.emplace(*arguments.video, static_cast<std::uint32_t>(view.page().max.x),
                          static_cast<std::uint32_t>(view.page().max.y),
                          static_cast<std::uint32_t>(std::round(1.0 / scene.frame_time)));
        }
    }
};

/// The device that draws the pictures; nearfield shares it.
struct DrawingDevice {
    GpuInstance instance;
    Gpu gpu{instance};
};

/// Draws frames.
class Pictures {
public:
    Pictures(const SimulateArguments& arguments, Outputs& outputs, const View& view,
             const std::optional<DrawingDevice>& device)
        : arguments_(arguments), outputs_(outputs), view_(view) {
        if (device) {
            page_.emplace(device->gpu, static_cast<std::uint32_t>(view.page().max.x),
                          static_cast<std::uint32_t>(view.page().max.y));
        }
    }

    void add(std::uint32_t frame, Context& context, simulation::World& world) {
        const bool in_a_file =
            outputs_.files && (frame % arguments_.every == 0 || frame == arguments_.frames);
        if (!in_a_file && !outputs_.video) {
            return;
        }
        drawing_.clear();
        if (arguments_.field) {
            drawing_.cells(field_overlay(context, world, view_, FieldLayer::distance));
        }
        draw_bodies(drawing_, world.scene(), view_);
        // With more bodies than this, marks would hide them all.
        constexpr std::size_t max_bodies_with_marks = 100;
        if (world.scene().bodies.size() <= max_bodies_with_marks) {
            draw_observations(drawing_, observe(world), view_);
        }
        const FrameImage image = page_->paint(drawing_);
        if (in_a_file) {
            outputs_.files->write(frame, png_of(image));
        }
        if (outputs_.video) {
            outputs_.video->add(image.pixels);
        }
    }

private:
    const SimulateArguments& arguments_;
    Outputs& outputs_;
    const View& view_;
    Drawing drawing_;
    std::optional<OffscreenPage> page_;  // empty if there is no output
};

SimulationReport report_of(const simulation::World& world, const SimulateArguments& arguments,
                           const Context& context, Technique technique) {
    const simulation::Scene& scene = world.scene();
    SimulationReport report;
    report.scene = scene.name;
    report.response = arguments.response;
    report.technique = to_string(technique);
    report.device = context.device_name();
    report.tolerance = scene.tolerance;
    report.objects = scene.bodies.size();
    report.lines = line_count(scene);
    report.steps = scene.steps;
    return report;
}

}  // namespace

CLI::App* add_simulate_command(CLI::App& program, SimulateArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "simulate", "Run one of the paper's simulations, or another of their kind");
    command
        ->add_option("scene", arguments.scene,
                     "map, gears, links, cars or wavy, as in the paper; overlap: the bars of wavy, "
                     "far inside each other; pour: 1,000 stars; required")
        ->required()
        ->type_name("NAME");
    command
        ->add_option("--response", arguments.response,
                     "penalty (forces at points inside the other body) or backtracking (to just "
                     "before a contact, and impulses there); default penalty")
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
    command
        ->add_option("--image", arguments.image,
                     "Draw frames into these files: %d, or %04d with the number of digits, stands "
                     "for the frame's number; default none")
        ->type_name("PATTERN.png");
    CLI::Option* const image = command->get_option("--image");
    add_count_option(*command, "--every", arguments.every, {1, 10'000'000},
                     "Draw frames whose number this divides, and the last one; default 1")
        ->type_name("COUNT")
        ->needs(image);
    command
        ->add_option("--video", arguments.video,
                     "Draw all frames into a video, by the program ffmpeg; default none")
        ->type_name("FILE");
    command->add_flag("--field", arguments.field,
                      "Draw the distance to the nearest body behind them");
    command
        ->add_option("--json", arguments.json,
                     "Write energies, query times and the worst penetration of each frame as JSON; "
                     "- for the standard output, the summary then goes to the standard error; "
                     "default none")
        ->type_name("FILE|-");
    return command;
}

int run_simulate(const SimulateArguments& arguments) {
    simulation::Scene scene = make_scene(arguments.scene, arguments.tolerance, arguments.bodies);
    const simulation::Response response = parse_response(arguments.response);
    const Technique technique =
        parse_technique_option(arguments.technique).value_or(Technique::automatic);
    const Settings settings = parse_settings(arguments.settings);
    const View view = view_of(scene, frame_width);
    catch_ctrl_c();
    ReportTarget target(arguments.json);
    Outputs outputs(arguments, scene, view);
    std::optional<DrawingDevice> device;
    if (arguments.image || arguments.video) {
        device.emplace();
    }
    AskedTechniques asked;
    asked.add(technique);
    Context context = device && technique != Technique::cpu
                          ? take(Context::create(device->gpu.host_device(), settings))
                          : open_context(settings, asked);
    simulation::World world = make_world(context, arguments, std::move(scene), response, technique);

    SimulationReport report = report_of(world, arguments, context, technique);
    Pictures pictures(arguments, outputs, view, device);
    const bool show_progress = isatty(STDERR_FILENO) == 1;
    pictures.add(0, context, world);
    for (std::uint32_t frame = 1; frame <= arguments.frames; ++frame) {
        if (show_progress) {
            std::cerr << "\rframe " << frame << " of " << arguments.frames << std::flush;
        }
        report.frames.push_back(world.advance());
        pictures.add(frame, context, world);
        if (was_ctrl_c_pressed()) {
            break;
        }
    }
    const bool is_stopped = was_ctrl_c_pressed();
    if (show_progress) {
        std::cerr << '\n';
    }
    if (outputs.video) {
        outputs.video->finish();
    }
    if (std::ostream* json = target.json()) {
        write_simulation_json(*json, report);
    }
    write_simulation_summary(target.summary(), report);
    target.commit();
    return is_stopped ? exit_status::stopped : exit_status::done;
}

}  // namespace nearfield::tools
