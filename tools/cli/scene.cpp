#include <nearfield/context.hpp>

#include <tools/cli/open_context.hpp>
#include <tools/cli/scene.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/query_json.hpp>
#include <tools/io/report_target.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/summary.hpp>

#include <vector>

namespace nearfield::tools {
CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "scene", "Answer the queries of a scene (shapes, instances, queries) in one batch");
    command
        ->add_option("scene", arguments.scene,
                     "Scene: shapes, instances (shape and pose) and queries")
        ->required()
        ->type_name("FILE.json");
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic, of all queries; default as the scene says")
        ->type_name("NAME");
    add_settings_options(*command, arguments.settings);
    command
        ->add_option("--json", arguments.json,
                     "Write the answers as JSON; - for the standard output, the summary then goes "
                     "to the standard error; default none")
        ->type_name("FILE|-");
    return command;
}

void run_scene(const SceneArguments& arguments) {
    const std::optional<Technique> technique = parse_technique_option(arguments.technique);
    const Settings settings = parse_settings(arguments.settings);
    Scene scene = read_scene(arguments.scene);
    set_technique(scene, technique);
    ReportTarget report(arguments.json);
    Context context = open_context(settings, techniques_of(scene));
    SceneRunner runner(scene, arguments.scene, context);
    runner.run_frame();
    runner.require_results();
    const std::vector<SceneAnswer> answers = runner.answers();
    if (std::ostream* json = report.json()) {
        write_scene_json(*json, answers, runner.timings(), context.device_name(),
                         runner.technique());
    }
    write_scene_summary(report.summary(), answers, runner.timings(), context.device_name(),
                        runner.technique());
    report.commit();
}

}  // namespace nearfield::tools
