#include <nearfield/version.hpp>

#include <CLI/CLI.hpp>
#include <tools/cli/bench.hpp>
#include <tools/cli/hash.hpp>
#include <tools/cli/info.hpp>
#include <tools/cli/options.hpp>
#include <tools/cli/query.hpp>
#include <tools/cli/scene.hpp>
#include <tools/cli/simulate.hpp>
#include <tools/common/library.hpp>
#include <tools/io/input_error.hpp>
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
    tools::HashArguments hash_arguments;
    const CLI::App* const query = tools::add_query_command(program, query_arguments);
    const CLI::App* const scene = tools::add_scene_command(program, scene_arguments);
    const CLI::App* const bench = tools::add_bench_command(program, bench_arguments);
    const CLI::App* const simulate = tools::add_simulate_command(program, simulate_arguments);
    const CLI::App* const hash = tools::add_hash_command(program, hash_arguments);
    tools::add_info_command(program);
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
    const auto done = [](const auto& command, const auto& its_arguments) {
        command(its_arguments);
        return exit_status::done;
    };
    return query->parsed()      ? tools::run_query(query_arguments)
           : scene->parsed()    ? tools::run_scene(scene_arguments)
           : simulate->parsed() ? tools::run_simulate(simulate_arguments)
           : bench->parsed()    ? done(tools::run_bench, bench_arguments)
           : hash->parsed()     ? done(tools::run_hash, hash_arguments)
                                : tools::run_info();
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
