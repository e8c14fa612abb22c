#include <nearfield/version.hpp>

#include <CLI/CLI.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/values.hpp>
#include <tools/simulation/simulation_choice.hpp>
#include <tools/viewer/viewer.hpp>

#include <array>
#include <exception>
#include <iostream>
#include <string>

namespace {

using namespace nearfield;
namespace exit_status = tools::exit_status;

struct Arguments {
    std::string scene = "map";
    std::string response = "penalty";
    std::optional<std::string> technique;
    std::optional<std::string> tolerance;
    std::uint32_t height = Settings{}.hierarchy_height;
    std::string strategy = "stencil";
    std::string field = "none";
    std::vector<std::string> show = {"contacts", "depths"};
    std::optional<std::uint32_t> frames;
    std::optional<std::string> drag;
    std::array<int, 2> resize{};
    std::optional<std::string> screenshot;
};

void add_options(CLI::App& program, Arguments& arguments) {
    program.add_option("scene", arguments.scene,
                       "map, gears, links, cars, wavy, overlap, pour, nest or robots; default map");
    program.add_option("--response", arguments.response, "penalty or backtracking");
    program.add_option("--technique", arguments.technique,
                       "raster, compute, cpu or automatic; default automatic");
    program.add_option("-d,--tolerance", arguments.tolerance,
                       "Tolerance d of the queries; default as the scene has it");
    tools::add_count_option(program, "--height", arguments.height, {0, 32},
                            "Maximum height of the hierarchies");
    program.add_option("--strategy", arguments.strategy,
                       "How intersections are found: stencil, blend, logic-op or depth");
    program.add_option("--field", arguments.field,
                       "What is drawn behind bodies: none, distance, voronoi or gradient");
    program
        .add_option("--show", arguments.show,
                    "What is drawn over them, separated by commas: contacts, depths, regions, "
                    "tiles, samples; none of them: nothing")
        ->delimiter(',');
    const auto group = "For tests, which have no user";
    CLI::Option* const frames =
        tools::add_count_option(program, "--frames", arguments.frames, {1, 1'000'000},
                                "Leave after so many frames")
            ->group(group);
    program
        .add_option("--drag", arguments.drag,
                    "X0,Y0,X1,Y1: press the mouse at one place of the scene, move it to another in "
                    "half of the frames, and hold")
        ->needs(frames)
        ->group(group);
    program.add_option("--resize", arguments.resize, "WIDTH,HEIGHT: resize the window half-way")
        ->delimiter(',')
        ->check(CLI::Range(1, 16384))
        ->needs(frames)
        ->group(group);
    program.add_option("--screenshot", arguments.screenshot, "Write the last frame (PNG)")
        ->needs(frames)
        ->group(group);
}

tools::FieldOverlay parse_field(const std::string& name) {
    using Layer = tools::FieldOverlay;
    const std::array names{std::pair{"none", Layer::none}, std::pair{"distance", Layer::distance},
                           std::pair{"voronoi", Layer::features},
                           std::pair{"gradient", Layer::gradient}};
    for (const auto& [known, layer] : names) {
        if (name == known) {
            return layer;
        }
    }
    throw tools::InputError("--field: \"" + name +
                            "\" is none of none, distance, voronoi, gradient");
}

void parse_show(const std::vector<std::string>& names, viewer::Overlays& overlays) {
    overlays.contacts = overlays.depths = false;
    for (const std::string& name : names) {
        if (name == "contacts") {
            overlays.contacts = true;
        } else if (name == "depths") {
            overlays.depths = true;
        } else if (name == "regions") {
            overlays.regions = true;
        } else if (name == "tiles") {
            overlays.tiles = true;
        } else if (name == "samples") {
            overlays.samples = true;
        } else if (name != "none") {
            throw tools::InputError(
                "--show: \"" + name +
                "\" is none of contacts, depths, regions, tiles, samples, none");
        }
    }
}

viewer::Wishes parse_wishes(const Arguments& arguments) {
    viewer::Wishes wishes;
    wishes.choices.scene = arguments.scene;
    // Rejects an invalid scene or tolerance before a window opens.
    if (tools::find_clearance_scene(arguments.scene) != nullptr) {
        if (arguments.tolerance) {
            throw tools::InputError("-d: does not apply to " + arguments.scene +
                                    ", whose clearances are exact");
        }
    } else {
        const simulation::Scene scene = tools::make_scene(arguments.scene, arguments.tolerance);
        wishes.choices.tolerance = arguments.tolerance ? scene.tolerance : 0.0;
    }
    wishes.choices.response =
        tools::parse_name<simulation::Response>(arguments.response, "--response");
    wishes.choices.technique =
        tools::parse_technique_option(arguments.technique).value_or(Technique::automatic);
    wishes.choices.hierarchy_height = arguments.height;
    wishes.overlays.strategy =
        tools::parse_name<IntersectionStrategy>(arguments.strategy, "--strategy");
    wishes.overlays.field = parse_field(arguments.field);
    parse_show(arguments.show, wishes.overlays);
    return wishes;
}

std::optional<viewer::Script> parse_script(const Arguments& arguments) {
    if (!arguments.drag) {
        return std::nullopt;
    }
    const std::string& text = *arguments.drag;
    std::size_t comma = 0;
    for (int i = 0; i < 2 && comma != std::string::npos; ++i) {
        comma = text.find(',', comma + (i == 0 ? 0 : 1));
    }
    if (comma == std::string::npos) {
        throw tools::InputError("--drag: \"" + text + "\" is not X0,Y0,X1,Y1");
    }
    return viewer::Script{tools::parse_point(text.substr(0, comma), "--drag"),
                          tools::parse_point(text.substr(comma + 1), "--drag"), *arguments.frames};
}

void run_viewer(const Arguments& arguments) {
    const viewer::Wishes wishes = parse_wishes(arguments);
    const std::optional<viewer::Script> script = parse_script(arguments);
    std::optional<tools::OutputFile> screenshot;
    if (arguments.screenshot) {
        screenshot.emplace(*arguments.screenshot);
    }
    viewer::Viewer viewer({}, wishes);
    if (arguments.resize[0] > 0) {
        viewer.run(*arguments.frames / 2, script);
        viewer.resize(arguments.resize[0], arguments.resize[1]);
        viewer.run(*arguments.frames - *arguments.frames / 2, std::nullopt);
    } else {
        viewer.run(arguments.frames, script);
    }
    if (screenshot) {
        screenshot->stream() << tools::png_of(viewer.picture());
        screenshot->commit();
    }
}

int fail(const std::exception& error, int status) {
    std::cerr << "nearfield_viewer: " << error.what() << '\n';
    return status;
}

}  // namespace

int main(int count, char** words) {
    CLI::App program("Simulations that stand on nearfield's queries, live", "nearfield_viewer");
    program.set_version_flag("--version",
                             std::string("nearfield_viewer ") + nearfield::version().text);
    program.footer(
        "Exit status: 0 done, 2 bad input or usage, 3 no usable device, 1 anything else.");
    Arguments arguments;
    add_options(program, arguments);
    try {
        program.parse(count, words);
        run_viewer(arguments);
        return exit_status::done;
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? program.exit(error)
                                          : fail(error, exit_status::bad_input);
    } catch (const tools::InputError& error) {
        return fail(error, exit_status::bad_input);
    } catch (const tools::LibraryError& error) {
        return fail(error, error.program_status());
    } catch (const tools::NoGpu& error) {
        return fail(error, exit_status::no_device);
    } catch (const std::exception& error) {
        return fail(error, exit_status::other_error);
    }
}
