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
    json.key("kinetic").value(energies.kinetic);
    json.key("potential").value(energies.potential);
    json.key("elastic").value(energies.elastic);
    json.key("contact").value(energies.contact);
    json.key("total").value(energies.total());
    json.end_object();
}

void write_frame(JsonWriter& json, const simulation::FrameReport& frame) {
    json.begin_object();
    json.key("time").value(frame.time);
    write_energies(json, frame.energies);
    json.key("query_ms").value(frame.queries.milliseconds);
    json.key("queries").value(std::uint64_t{frame.queries.queries});
    json.key("batches").value(std::uint64_t{frame.queries.batches});
    json.key("contacts").value(std::uint64_t{frame.contacts});
    json.key("worst_penetration").value(frame.worst_penetration);
    json.key("events").value(std::uint64_t{frame.events});
    json.key("stopped").value(std::uint64_t{frame.stopped});
    json.end_object();
}

}  // namespace

void write_simulation_json(std::ostream& stream, const SimulationReport& report) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.key("scene").value(std::string_view(report.scene));
    json.key("response").value(std::string_view(report.response));
    json.key("technique").value(std::string_view(report.technique));
    json.key("device").value_or_null(report.device);
    json.key("tolerance").value(report.tolerance);
    json.key("objects").value(std::uint64_t{report.objects});
    json.key("lines").value(std::uint64_t{report.lines});
    json.key("steps_a_frame").value(std::uint64_t{report.steps});
    json.key("worst_penetration").value(worst_penetration(report));
    json.key("median_query_ms").value(query_times(report).median);
    write_energies(json, report.frames.back().energies);
    json.key("frames").begin_array(JsonWriter::Layout::lines);
    for (const simulation::FrameReport& frame : report.frames) {
        write_frame(json, frame);
    }
    json.end_array();
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
