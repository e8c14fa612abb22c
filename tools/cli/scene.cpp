#include <nearfield/context.hpp>

#include <tools/cli/open_context.hpp>
#include <tools/cli/scene.hpp>
#include <tools/cli/world_values_files.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/query_json.hpp>
#include <tools/io/report_target.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/summary.hpp>

#include <cstddef>
#include <iostream>
#include <vector>

namespace nearfield::tools {
namespace {

/// Lists what is wrong on the standard error; returns the exit status, that of bad input first.
int report_problems(const SceneRunner& runner) {
    int status = exit_status::done;
    for (const Status& problem : runner.problems()) {
        std::cerr << "nearfield: " << problem.message() << memory_hint(problem.message()) << '\n';
        const int own = exit_status_of(problem.code());
        status = status == exit_status::done || own == exit_status::bad_input ? own : status;
    }
    if (const std::size_t count = runner.dependent_count(); count > 0) {
        std::cerr << "nearfield: not answered because of what is listed above: " << count
                  << (count == 1 ? " query\n" : " queries\n");
    }
    return status;
}

}  // namespace

CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "scene",
        "Answer the queries of a scene (shapes, instances, groups, queries) in one batch: of pairs "
        "of instances, and of all instances (poses, nearest, rays, cast, overlap). Bad shapes and "
        "queries are listed on the standard error and have their own status; the others are "
        "answered");
    command
        ->add_option("scene", arguments.scene,
                     "Scene: shapes, instances (shape and pose), groups and queries")
        ->required()
        ->type_name("FILE.json");
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic, of all queries; default as the scene says")
        ->type_name("NAME");
    command->add_flag(
        "--strict", arguments.strict,
        "Refuse rings that enclose nothing; otherwise they are dropped, and listed on "
        "the standard error");
    add_settings_options(*command, arguments.settings);
    command
        ->add_option("--json", arguments.json,
                     "Write the answers as JSON; - for the standard output, the summary then goes "
                     "to the standard error; default none")
        ->type_name("FILE|-");
    return command;
}

void print_notes(const Scene& scene) {
    for (const SceneShape& shape : scene.shapes) {
        if (!shape.note.empty()) {
            std::cerr << "nearfield: " << shape.note << '\n';
        }
    }
}

int run_scene(const SceneArguments& arguments) {
    const std::optional<Technique> technique = parse_technique_option(arguments.technique);
    const Settings settings = parse_settings(arguments.settings);
    Scene scene = read_scene(arguments.scene, BadEntries::recorded,
                             arguments.strict ? EmptyRings::kept : EmptyRings::dropped);
    print_notes(scene);
    set_technique(scene, technique);
    WorldValuesFiles values(scene, arguments.json);
    ReportTarget report(arguments.json);
    Context context = open_context(settings, techniques_of(scene));
    SceneRunner runner(scene, arguments.scene, context, BadEntries::recorded);
    runner.run_what_fits();
    const std::vector<SceneAnswer> answers = runner.answers();
    if (std::ostream* json = report.json()) {
        write_scene_json(*json, answers, runner.timings(), context.device_name(),
                         runner.technique());
    }
    write_scene_summary(report.summary(), answers, runner.timings(), context.device_name(),
                        runner.technique());
    values.write(answers);
    values.commit();
    report.commit();
    return report_problems(runner);
}

}  // namespace nearfield::tools
