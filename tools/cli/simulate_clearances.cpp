#include <nearfield/context.hpp>

#include <tools/cli/clearance_report.hpp>
#include <tools/cli/frame_output.hpp>
#include <tools/cli/simulate_clearances.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <tools/rendering/clearance_picture.hpp>
#include <tools/simulation/simulation_choice.hpp>

#include <memory>
#include <string>

namespace nearfield::tools {
namespace {

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

}  // namespace

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

}  // namespace nearfield::tools
