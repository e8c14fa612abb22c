#include <nearfield/context.hpp>

#include <tools/cli/frame_output.hpp>
#include <tools/cli/open_context.hpp>
#include <tools/cli/simulate.hpp>
#include <tools/cli/simulate_clearances.hpp>
#include <tools/cli/simulation_report.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <tools/rendering/scene_picture.hpp>
#include <tools/simulation/simulation_choice.hpp>
#include <tools/simulation/world.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::tools {
namespace {

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
        drawing.cells(field_overlay(context, world, view, FieldLayer::distance));
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
