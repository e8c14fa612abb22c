#include <tools/benchmark/spread.hpp>
#include <tools/cli/simulation_report.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/summary.hpp>

#include <algorithm>
#include <cstdint>

namespace nearfield::tools {
namespace {

double worst_penetration(const SimulationReport& report) {
    double worst = 0.0;
    for (const simulation::FrameReport& frame : report.frames) {
        worst = std::max(worst, frame.worst_penetration);
    }
    return worst;
}

benchmark::Spread query_times(const SimulationReport& report) {
    std::vector<double> times;
    times.reserve(report.frames.size());
    for (const simulation::FrameReport& frame : report.frames) {
        times.push_back(frame.queries.milliseconds);
    }
    return benchmark::spread_of(std::move(times));
}

void write_energies(JsonWriter& json, const simulation::Energies& energies) {
    json.key("energies").begin_object();
    json.member("kinetic", energies.kinetic);
    json.member("potential", energies.potential);
    json.member("elastic", energies.elastic);
    json.member("contact", energies.contact);
    json.member("total", energies.total());
    json.end_object();
}

void write_frame(JsonWriter& json, const simulation::FrameReport& frame) {
    json.begin_object();
    json.member("time", frame.time);
    write_energies(json, frame.energies);
    json.member("query_ms", frame.queries.milliseconds);
    json.member("queries", frame.queries.queries);
    json.member("batches", frame.queries.batches);
    json.member("contacts", frame.contacts);
    json.member("worst_penetration", frame.worst_penetration);
    json.member("events", frame.events);
    json.member("stopped", frame.stopped);
    json.end_object();
}

}  // namespace

void write_simulation_json(std::ostream& stream, const SimulationReport& report) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("scene", report.scene);
    json.member("response", report.response);
    json.member("technique", report.technique);
    json.member("device", report.device, !report.device.empty());
    json.member("tolerance", report.tolerance);
    json.member("objects", report.objects);
    json.member("lines", report.lines);
    json.member("steps_a_frame", report.steps);
    json.member("worst_penetration", worst_penetration(report));
    json.member("median_query_ms", query_times(report).median);
    write_energies(json, report.frames.back().energies);
    json.list("frames", report.frames,
              [&json](const simulation::FrameReport& frame) { write_frame(json, frame); });
    json.end_object();
    stream << '\n';
}

void write_simulation_summary(std::ostream& stream, const SimulationReport& report) {
    const benchmark::Spread times = query_times(report);
    const simulation::FrameReport& last = report.frames.back();
    std::size_t batches = 0;
    std::size_t stopped = 0;
    for (const simulation::FrameReport& frame : report.frames) {
        batches += frame.queries.batches;
        stopped += frame.stopped;
    }
    stream << "scene             " << report.scene << ", " << report.response << '\n'
           << "device            " << device_text(report.device) << ", technique "
           << report.technique << '\n'
           << "objects, lines    " << report.objects << ", " << report.lines << '\n'
           << "frames            " << report.frames.size() << ", " << report.steps
           << " steps each; " << short_number(last.time) << " s\n"
           << "queries           " << short_number(times.median) << " ms a frame, median ("
           << short_number(times.lower_quartile) << " - " << short_number(times.upper_quartile)
           << "); " << batches << " batches\n"
           << "penetration       " << short_number(worst_penetration(report)) << " at worst; d is "
           << short_number(report.tolerance) << '\n'
           << "energy            " << short_number(last.energies.total()) << " (kinetic "
           << short_number(last.energies.kinetic) << ")\n";
    if (stopped > 0) {
        stream << "waiting           " << stopped << " times a body, for the rest of a step\n";
    }
}

}  // namespace nearfield::tools
