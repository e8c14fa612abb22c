// Compares nearfield with libraries that answer some of the same queries: the same pairs, process
// and core, in alternating turns. All answers are compared first; if they differ by more than
// nearfield's stated bounds, the program ends. The same then for worlds, with libraries that keep
// an index, too.
//   bench_peers [--filter TEXT] [--json FILE|-]

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>
#include <sched.h>
#include <tools/benchmark/measuring.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/output_file.hpp>
#include <tools/peers/race.hpp>
#include <tools/peers/report.hpp>

#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace nearfield;

/// Call before any thread is made, so that a driver's threads stay on that core too.
void pin_to_one_core() {
    cpu_set_t core;
    CPU_ZERO(&core);
    CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);
    if (sched_setaffinity(0, sizeof core, &core) != 0) {
        throw std::runtime_error("the process cannot be pinned to a core");
    }
}

void run(const std::string& filter, const std::optional<std::string>& json) {
    tools::ReportTarget report(json);
    pin_to_one_core();
    Context context = tools::take(Context::create_headless());
    const benchmark::Machine machine = benchmark::this_machine();
    const tools::StatusLine line;
    std::vector<peers::ProblemTimes> table;
    peers::write_head(report.summary(), machine, context.device_name());
    for (const peers::Problem& problem : peers::all_problems()) {
        if (problem.name.find(filter) != std::string::npos) {
            line.show(problem.name);
            table.push_back(peers::race(problem, context));
            line.show({});
            peers::write_row(report.summary(), table.back());
        }
    }
    peers::write_notes(report.summary(), table);
    std::vector<peers::WorldTimes> worlds;
    for (const peers::WorldProblem& problem : peers::world_problems()) {
        if (problem.name.find(filter) != std::string::npos) {
            line.show(problem.name);
            worlds.push_back(peers::race(problem));
        }
    }
    line.show({});
    if (table.empty() && worlds.empty()) {
        throw std::runtime_error("--filter: no row has \"" + filter + "\" in its name");
    }
    peers::write_worlds(report.summary(), worlds);
    if (std::ostream* stream = report.json()) {
        peers::write_json(*stream, table, worlds, machine, context.device_name());
    }
    report.commit();
}

}  // namespace

int main(int count, char** arguments) {
    CLI::App program("nearfield and its peers, turn by turn on one core", "bench_peers");
    std::string filter;
    std::optional<std::string> json;
    program.add_option("--filter", filter, "Only the rows whose names hold this text");
    program.add_option("--json", json, "Write the times as JSON; - for the standard output");
    CLI11_PARSE(program, count, arguments);
    try {
        run(filter, json);
    } catch (const std::exception& error) {
        std::cerr << "bench_peers: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
