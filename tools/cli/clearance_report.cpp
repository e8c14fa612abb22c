#include <tools/benchmark/spread.hpp>
#include <tools/cli/clearance_report.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/summary.hpp>
#include <tools/io/world_records.hpp>

#include <algorithm>
#include <cstdint>
#include <numbers>

namespace nearfield::tools {
namespace {

using simulation::ClearanceFrame;

void write_frame(JsonWriter& json, const ClearanceFrame& frame) {
    json.begin_object();
    json.member("time", frame.time);
    json.member("query_ms", frame.milliseconds);
    json.member("translation", frame.pose.translation);
    json.member("degrees", frame.pose.angle * 180.0 / std::numbers::pi);
    json.member("free_paths", frame.free_paths);
    json.member("best_path", frame.best_path);
    // An instance is the number of an obstacle.
    JsonRow row(json, [&frame](InstanceHandle /*handle*/) { return frame.neighbor; });
    write_cells(row, frame.clearance);
    json.end_object();
}

benchmark::Spread query_times(const ClearanceReport& report) {
    std::vector<double> times;
    for (const ClearanceFrame& frame : report.frames) {
        times.push_back(frame.milliseconds);
    }
    return benchmark::spread_of(std::move(times));
}

double least_clearance(const ClearanceReport& report) {
    double least = report.frames.front().clearance.distance;
    for (const ClearanceFrame& frame : report.frames) {
        least = std::min(least, frame.clearance.distance);
    }
    return least;
}

}  // namespace

void write_clearance_json(std::ostream& stream, const ClearanceReport& report) {
    const simulation::ClearanceScene& scene = report.scene;
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("scene", scene.name());
    json.member("technique", to_string(Technique::cpu));
    json.key("device").null();
    json.member("min_clearance", scene.query().min_clearance);
    json.member("max_clearance", scene.query().max_clearance);
    json.member("objects", scene.obstacles().size());
    json.member("lines", scene.line_count());
    json.member("paths_a_frame", report.frames.back().paths);
    json.member("poses_a_frame", report.frames.back().poses);
    json.member("least_clearance", least_clearance(report));
    json.member("median_query_ms", query_times(report).median);
    json.list("frames", report.frames,
              [&json](const ClearanceFrame& frame) { write_frame(json, frame); });
    json.end_object();
    stream << '\n';
}

void write_clearance_summary(std::ostream& stream, const ClearanceReport& report) {
    const benchmark::Spread times = query_times(report);
    const ClearanceFrame& last = report.frames.back();
    const auto blocked = static_cast<std::size_t>(
        std::count_if(report.frames.begin(), report.frames.end(),
                      [](const ClearanceFrame& frame) { return frame.free_paths == 0; }));
    stream << "scene             " << report.scene.name() << ", technique "
           << to_string(Technique::cpu) << '\n'
           << "objects, lines    " << report.scene.obstacles().size() << ", "
           << report.scene.line_count() << '\n'
           << "frames            " << report.frames.size() << "; " << short_number(last.time)
           << " s\n"
           << "asked a frame     " << last.poses << " poses, " << last.paths << " paths\n"
           << "queries           " << short_number(times.median) << " ms a frame, median ("
           << short_number(times.lower_quartile) << " - " << short_number(times.upper_quartile)
           << ")\n"
           << "clearance         " << short_number(least_clearance(report)) << " at least; "
           << blocked << " frames without a free path\n"
           << "last frame        " << short_number(last.clearance.distance) << ", "
           << last.free_paths << " paths free\n";
}

}  // namespace nearfield::tools
