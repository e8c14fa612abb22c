// Compares nearfield with libraries that answer some of the same queries: the same pairs or worlds,
// process and core, in alternating turns. All answers are compared first; if they differ by more
// than nearfield's stated bounds, the program ends.
//
//   bench_peers [--filter TEXT] [--json FILE|-]

#include <CLI/CLI.hpp>
#include <sched.h>
#include <tools/benchmark/workloads.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/peers/race.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <set>

namespace {

using namespace nearfield;
using benchmark::three_digits;
using peers::PeerTimes;
using peers::ProblemTimes;
using tools::JsonWriter;

/// Call before any thread is made, so that a driver's threads stay on that core too.
void pin_to_one_core() {
    cpu_set_t core;
    CPU_ZERO(&core);
    CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);
    if (sched_setaffinity(0, sizeof core, &core) != 0) {
        throw std::runtime_error("the process cannot be pinned to a core");
    }
}

/// The peers' time as a multiple of nearfield's; below 1, nearfield is slower.
std::optional<double> times_as_long(const ProblemTimes& times, benchmark::Spread PeerTimes::*peers,
                                    const benchmark::Spread& ours) {
    const std::optional<double> quickest = times.quickest(peers);
    return quickest && ours.count > 0 ? std::optional(*quickest / ours.median) : std::nullopt;
}

constexpr const char* peer_names[] = {"GEOS", "Boost", "Boost R-tree", "CGAL", "Clipper", "Box2D"};

/// Writes the lines above the rows.
void write_head(std::ostream& stream, const benchmark::Surroundings& surroundings) {
    benchmark::write_surroundings(stream, surroundings);
    stream
        << "\n\n"
        << "Milliseconds, medians, built / kept: with all shapes passed, and geometries and "
           "indices "
           "made, each frame, and with all\n"
        << "of that made before and nothing moved; of worlds, kept alone. nearfield: a whole frame "
           "by automatic. The last columns:\n"
        << "how many times as long as nearfield the quickest peer takes, built and kept; below 1 "
           "nearfield is behind.\n\n"
        << "| row | queries | nearfield | by";
    for (const char* const name : peer_names) {
        stream << " | " << name;
    }
    stream << " | built | kept |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n"
           << std::flush;
}

std::string cell(const benchmark::Spread& built, const benchmark::Spread& kept) {
    return (built.count > 0 ? three_digits(built.median) + " / " : "") + three_digits(kept.median);
}

/// Writes a row in Markdown.
void write_row(std::ostream& stream, const ProblemTimes& times) {
    stream << "| " << times.name << " | " << times.queries << " | "
           << cell(times.built_ms, times.kept_ms) << " | " << times.technique;
    for (const std::string_view name : peer_names) {
        const auto peer = std::find_if(times.peers.begin(), times.peers.end(),
                                       [&](const PeerTimes& any) { return any.name == name; });
        stream << " | " << (peer != times.peers.end() ? cell(peer->built_ms, peer->kept_ms) : "");
    }
    for (const auto& ratio : {times_as_long(times, &PeerTimes::built_ms, times.built_ms),
                              times_as_long(times, &PeerTimes::kept_ms, times.kept_ms)}) {
        stream << " | " << (ratio ? three_digits(*ratio) : "");
    }
    stream << " |\n" << std::flush;
}

/// Writes which task each peer answered and how, for the rows in the table.
void write_notes(std::ostream& stream, const std::vector<ProblemTimes>& table) {
    std::set<std::string> notes;
    for (const ProblemTimes& times : table) {
        for (const PeerTimes& peer : times.peers) {
            notes.insert(peer.name + ", " + std::string(times.task) + ": " + peer.how);
            if (peer.apart > 0) {
                notes.insert(peer.name + ", " + times.name + ": " + std::to_string(peer.apart) +
                             " answers differ by more than its rounding");
            }
        }
    }
    stream << '\n';
    for (const std::string& note : notes) {
        stream << "- " << note << '\n';
    }
}

void write_spread(JsonWriter& json, std::string_view name, const benchmark::Spread& spread) {
    if (spread.count == 0) {
        return;
    }
    json.key(name).begin_object();
    json.member("median", spread.median);
    json.member("min", spread.least);
    json.member("quartiles", std::array{spread.lower_quartile, spread.upper_quartile});
    json.member("frames", spread.count);
    json.end_object();
}

void write_peer(JsonWriter& json, const PeerTimes& peer) {
    json.key(peer.name).begin_object(JsonWriter::Layout::lines);
    json.member("how", peer.how);
    write_spread(json, "built_ms", peer.built_ms);
    write_spread(json, "kept_ms", peer.kept_ms);
    json.member("largest_difference", peer.largest_difference);
    json.member("allowed", peer.allowed);
    json.member("apart", peer.apart);
    json.end_object();
}

/// Writes everything as JSON with a final line feed.
void write_json(std::ostream& stream, const std::vector<ProblemTimes>& table,
                const benchmark::Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    benchmark::write_surroundings(json, surroundings);
    json.list("rows", table, [&json](const ProblemTimes& times) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", times.name);
        json.member("queries", times.queries);
        json.member("technique", times.technique);
        write_spread(json, "nearfield_built_ms", times.built_ms);
        write_spread(json, "nearfield_kept_ms", times.kept_ms);
        json.key("peers").begin_object(JsonWriter::Layout::lines);
        for (const PeerTimes& peer : times.peers) {
            write_peer(json, peer);
        }
        json.end_object();
        json.member("quickest_built_to_nearfield",
                    times_as_long(times, &PeerTimes::built_ms, times.built_ms));
        json.member("quickest_kept_to_nearfield",
                    times_as_long(times, &PeerTimes::kept_ms, times.kept_ms));
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

void run(const std::string& filter, const std::optional<std::string>& json) {
    tools::ReportTarget report(json);
    pin_to_one_core();
    Context context = tools::take(Context::create_headless());
    const benchmark::Surroundings surroundings = benchmark::surroundings_of(context.device_name());
    std::vector<ProblemTimes> table;
    write_head(report.summary(), surroundings);
    for (const peers::Problem& problem : benchmark::rows_with(filter, peers::all_problems())) {
        {
            const tools::StatusLine line;
            line.show(problem.name);
            table.push_back(peers::race(problem, context));
        }
        write_row(report.summary(), table.back());
    }
    write_notes(report.summary(), table);
    if (std::ostream* stream = report.json()) {
        write_json(*stream, table, surroundings);
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
