#include <nearfield/diagnostics.hpp>
#include <nearfield/version.hpp>

#include <CLI/CLI.hpp>
#include <tools/cli/bench.hpp>
#include <tools/cli/options.hpp>
#include <tools/cli/query.hpp>
#include <tools/cli/scene.hpp>
#include <tools/cli/simulate.hpp>
#include <tools/common/library.hpp>
#include <tools/hash/sections.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/query_request.hpp>
#include <tools/rendering/gpu.hpp>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace tools = nearfield::tools;
namespace exit_status = nearfield::tools::exit_status;

int fail(const std::exception& error, int status) {
    std::cerr << "nearfield: " << error.what() << tools::memory_hint(error.what()) << '\n';
    return status;
}

/// Prints the version and every device with its status: usable, or what it lacks. Returns the exit
/// status.
int run_info() {
    std::cout << "nearfield " << nearfield::version().text << '\n';
    const std::vector<nearfield::DeviceReport> devices = tools::take(nearfield::list_devices());
    bool any_usable = false;
    for (const nearfield::DeviceReport& device : devices) {
        std::cout << device.name << "\n  driver: " << device.driver << "\n  "
                  << (device.usable ? "usable" : "not usable") << '\n';
        for (const std::string& reason : device.missing) {
            std::cout << "  missing: " << reason << '\n';
        }
        for (const nearfield::OptionalPart& part : device.optional) {
            std::cout << "  optional " << part.name << ": "
                      << (part.available ? "available" : "not available") << "; unlocks "
                      << part.unlocks << '\n';
            for (const std::string& reason : part.missing) {
                std::cout << "    missing: " << reason << '\n';
            }
        }
        for (const nearfield::StrategyReport& report : device.strategies) {
            std::cout << "  strategy " << tools::name_of(report.strategy) << ": "
                      << (report.missing.empty() ? "available" : "not available") << '\n';
            for (const std::string& reason : report.missing) {
                std::cout << "    missing: " << reason << '\n';
            }
        }
        any_usable = any_usable || device.usable;
    }
    if (!any_usable) {
        std::cerr << "nearfield: "
                  << (devices.empty() ? "there is no Vulkan device\n"
                                      : "none of the devices can be used\n");
    }
    return any_usable ? exit_status::done : exit_status::no_device;
}

int run(int count, char** arguments) {
    CLI::App program("2D proximity queries between polygons on a Vulkan GPU", "nearfield");
    program.set_version_flag("--version", std::string("nearfield ") + nearfield::version().text);
    program.footer(
        "Exit status: 0 done, 2 bad input or usage, 3 no usable device, 1 anything else,\n"
        "130 stopped by Ctrl-C.");
    program.formatter(std::make_shared<tools::HelpFormatter>(tools::HelpStyle{}));
    program.require_subcommand(1);
    tools::QueryArguments query_arguments;
    tools::SceneArguments scene_arguments;
    tools::BenchArguments bench_arguments;
    tools::SimulateArguments simulate_arguments;
    const CLI::App* const query = tools::add_query_command(program, query_arguments);
    const CLI::App* const scene = tools::add_scene_command(program, scene_arguments);
    const CLI::App* const bench = tools::add_bench_command(program, bench_arguments);
    const CLI::App* const simulate = tools::add_simulate_command(program, simulate_arguments);
    CLI::App* const hash = program.add_subcommand(
        "hash",
        "Print hashes of the answers of technique cpu to fixed queries, by section. They are the "
        "same on every machine");
    bool quick = false;
    hash->add_flag("--quick", quick, "Only the sections that take seconds on a slow machine");
    program.add_subcommand(
        "info",
        "Print the version and the devices: usable or not, the intersection strategies each "
        "has, and what it lacks");
    std::vector<std::string> words =
        tools::with_kind_first(*query, {arguments + std::min(count, 1), arguments + count});
    std::reverse(words.begin(), words.end());  // the order CLI11 expects
    try {
        program.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {  // help or version was requested
            return program.exit(error);
        }
        if (count > 1 && arguments[1][0] != '-' && program.get_subcommands().empty()) {
            throw tools::InputError(std::string("\"") + arguments[1] +
                                    "\" is none of query, scene, simulate, bench, hash, info");
        }
        if (query->parsed()) {
            tools::explain_refusal(*query);
        }
        return fail(error, exit_status::bad_input);
    }
    if (hash->parsed()) {
        nearfield::hash::print_hashes(nearfield::hash::cpu_context, quick, std::cout);
        return exit_status::done;
    }
    if (bench->parsed()) {
        tools::run_bench(bench_arguments);
        return exit_status::done;
    }
    return query->parsed()      ? tools::run_query(query_arguments)
           : scene->parsed()    ? tools::run_scene(scene_arguments)
           : simulate->parsed() ? tools::run_simulate(simulate_arguments)
                                : run_info();
}

}  // namespace

int main(int count, char** arguments) {
    try {
        const int status = run(count, arguments);
        if (!std::cout.flush()) {
            throw std::runtime_error("the standard output could not be written");
        }
        return status;
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
