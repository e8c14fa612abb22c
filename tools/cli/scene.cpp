#include <nearfield/context.hpp>

#include <tools/cli/options.hpp>
#include <tools/cli/scene.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/world_report.hpp>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::tools {

namespace {

/// The files into which a scene has the records of its queries written.
class WorldValuesFiles {
public:
    /// `json`: the file of the answers; "-" is the standard output. Throws InputError for a file
    /// that cannot be written, or that would replace an input or another output.
    WorldValuesFiles(const Scene& scene, const std::optional<std::string>& json) {
        std::vector<std::string> outputs;
        if (json && *json != "-") {
            outputs.push_back(*json);
        }
        std::vector<std::string> values;
        for (const SceneQuery& query : scene.queries) {
            if (query.problem.empty() && query.world && !query.world->values.empty()) {
                values.push_back(query.world->values);
            }
        }
        outputs.insert(outputs.end(), values.begin(), values.end());
        require_different_files(scene.files, outputs);
        for (const std::string& path : values) {
            files_.try_emplace(path, path);
        }
    }

    /// Writes the records of the answers that there are. Other files are left as they are.
    void write(std::span<const SceneAnswer> answers) {
        for (const SceneAnswer& answer : answers) {
            if (answer.world == nullptr || answer.world->request->values.empty()) {
                continue;
            }
            File& file = files_.at(answer.world->request->values);
            if (is_npy(answer.world->request->values)) {
                write_world_npy(file.output.stream(), *answer.world);
            } else {
                write_world_csv(file.output.stream(), *answer.world);
            }
            file.is_written = true;
        }
    }

    /// Throws std::runtime_error if writing failed.
    void commit() {
        for (auto& [path, file] : files_) {
            if (file.is_written) {
                file.output.commit();
            }
        }
    }

private:
    struct File {
        explicit File(const std::string& path) : output(path) {}
        OutputFile output;
        bool is_written = false;
    };
    std::map<std::string, File> files_;  ///< by path
};

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
    if (const std::size_t count = runner.cancelled_count(); count > 0) {
        std::cerr << "nearfield: stopped by Ctrl-C: not answered: " << count
                  << (count == 1 ? " query\n" : " queries\n");
    }
    return status;
}

/// Answers the queries; returns whether Ctrl-C ended that.
bool run_until_ctrl_c(SceneRunner& runner) {
    const InterruptibleCalls calls("queries answered");
    runner.run_what_fits(calls.limits());
    return was_ctrl_c_pressed();
}

/// Options that a scene states itself.
void add_outline_options(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--query", arguments.queries,
                    "For outlines: a kind of query for all pairs; repeatable; default containment "
                    "and intersection-test")
        ->type_name("KIND")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_parsed_option(command, "-d", arguments.tolerance, parse_positive,
                      "For outlines: the tolerance, world units, > 0; default none, which sampled "
                      "kinds and separation-vector need")
        ->type_name("TOLERANCE");
    command.add_flag("--hits-only", arguments.hits_only,
                     "For outlines: leave out the results of pairs without a hit");
    add_parsed_option(command, "--units", arguments.unit, parse_name<LengthUnit>,
                      "For outlines: the unit of SVG, as for nearfield query; default user")
        ->type_name("NAME");
    add_parsed_option(
        command, "--deviation", arguments.deviation, parse_positive,
        "For outlines: largest deviation of edges from curves, world units, > 0; default a "
        "sixteenth of the tolerance, without one a 100,000th of a shape's longer side")
        ->type_name("DEVIATION");
    add_parsed_option(
        command, "--fill-rule", arguments.fill_rule, parse_name<FillRule>,
        "For outlines: odd-even, nonzero, positive or union; default as for nearfield query")
        ->type_name("NAME");
    add_parsed_option(command, "--clean-width", arguments.clean_width, parse_positive,
                      "For outlines: drop rings, spikes and vertices that are no wider than this, "
                      "world units, > 0; default only rings that enclose nothing")
        ->type_name("W");
    add_parsed_option(command, "--offset", arguments.offset, parse_nonzero,
                      "For outlines: grow every item by this, world units, with round corners; "
                      "negative: shrink; default not at all")
        ->type_name("DISTANCE");
}

/// Refuses what a scene in JSON states itself.
void require_no_outline_options(const SceneArguments& arguments, const std::string& file) {
    for (const auto& [name, is_given] :
         {std::pair{"--query", !arguments.queries.empty()},
          std::pair{"-d", arguments.tolerance.has_value()},
          std::pair{"--hits-only", arguments.hits_only},
          std::pair{"--units", arguments.unit.has_value()},
          std::pair{"--deviation", arguments.deviation.has_value()},
          std::pair{"--fill-rule", arguments.fill_rule.has_value()},
          std::pair{"--clean-width", arguments.clean_width.has_value()},
          std::pair{"--offset", arguments.offset.has_value()}}) {
        if (is_given) {
            throw InputError(std::string(name) + ": belongs to outlines; " + file +
                             " is a scene, which states its own");
        }
    }
}

LayoutRequest layout_request(const SceneArguments& arguments) {
    if (arguments.strict && arguments.clean_width) {
        throw InputError("--strict: drops nothing, so it cannot stand beside --clean-width");
    }
    LayoutRequest request{.hits_only = arguments.hits_only,
                          .treatment = {arguments.fill_rule, arguments.clean_width,
                                        arguments.offset, arguments.strict},
                          .unit = arguments.unit.value_or(LengthUnit::user),
                          .deviation = arguments.deviation};
    for (const std::string& kind :
         arguments.queries.empty() ? std::vector<std::string>{"containment", "intersection-test"}
                                   : arguments.queries) {
        QueryRequest query;
        query.type = parse_name<QueryType>(kind, "--query");
        query.tolerance = arguments.tolerance.value_or(0.0);
        request.queries.push_back(query);
    }
    return request;
}

Scene read_arguments(const SceneArguments& arguments) {
    std::vector<InputFile> files;
    for (const std::string& file : arguments.files) {
        if (file == "-" && std::count(arguments.files.begin(), arguments.files.end(), "-") > 1) {
            throw InputError("FILE: only one can be -, the standard input");
        }
        files.push_back(read_input(file));
        if (holds_scene(files.back()) && arguments.files.size() > 1) {
            throw InputError(files.back().name + ": a scene stands alone, without other files");
        }
    }
    if (!holds_scene(files.front())) {
        return read_layout(std::move(files), layout_request(arguments));
    }
    require_no_outline_options(arguments, files.front().name);
    return read_scene(files.front(), BadEntries::recorded,
                      arguments.strict ? EmptyRings::kept : EmptyRings::dropped);
}

}  // namespace

CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "scene",
        "Answer the queries of a scene (shapes, instances, groups, queries) in one batch: of pairs "
        "of instances, and of all instances (poses, nearest, rays, cast, overlap). Bad shapes and "
        "queries are listed on the standard error and have their own status; the others are "
        "answered. Of outlines, all pairs are asked about: of an SVG file those of its items (use, "
        "groups of outlines, other outlines), of any other file it as a whole");
    command
        ->add_option(
            "scene", arguments.files,
            "A scene: shapes, instances (shape and pose), groups and queries, as JSON; or "
            "outlines: SVG, DXF, GeoJSON, WKT, WKB, SVG path data. - reads the standard input")
        ->required()
        ->type_name("FILE...");
    add_outline_options(*command, arguments);
    command
        ->add_option("--technique", arguments.technique,
                     "raster, compute, cpu or automatic, of all queries, those of all instances "
                     "included; default as the scene says")
        ->type_name("NAME");
    command->add_flag(
        "--strict", arguments.strict,
        "Refuse rings that enclose nothing; otherwise they are dropped, and listed on "
        "the standard error");
    command->add_flag("--query-times", arguments.query_times,
                      "Write the time of each query of a pair into the JSON (time_ms)");
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
    Scene scene = read_arguments(arguments);
    print_notes(scene);
    set_technique(scene, technique);
    catch_ctrl_c();
    WorldValuesFiles values(scene, arguments.json);
    ReportTarget report(arguments.json);
    Context context = open_context(settings, techniques_of(scene));
    SceneRunner runner(scene, scene.files.front(), context, BadEntries::recorded);
    if (arguments.query_times) {
        runner.time_queries();
    }
    const bool is_stopped = run_until_ctrl_c(runner);
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
    const int status = report_problems(runner);
    return is_stopped ? exit_status::stopped : status;
}

}  // namespace nearfield::tools
