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

/// The members of a clearance; an instance is the number of an obstacle.
class ClearanceRow {
public:
    ClearanceRow(JsonWriter& json, const ClearanceFrame& frame) : json_(json), frame_(frame) {}

    void number(std::string_view name, double number) { json_.key(name).value(number); }
    void instance(std::string_view name, InstanceHandle /*handle*/) {
        json_.key(name);
        frame_.neighbor ? json_.value(std::uint64_t{*frame_.neighbor}) : json_.null();
    }
    void point(std::string_view name, Vector2 point, bool is_there) {
        json_.key(name);
        is_there ? json_.value(point) : json_.null();
    }

private:
    JsonWriter& json_;
    const ClearanceFrame& frame_;
};

void write_frame(JsonWriter& json, const ClearanceFrame& frame) {
    json.begin_object();
    json.key("time").value(frame.time);
    json.key("query_ms").value(frame.milliseconds);
    json.key("translation").value(frame.pose.translation);
    json.key("degrees").value(frame.pose.angle * 180.0 / std::numbers::pi);
    json.key("free_paths").value(std::uint64_t{frame.free_paths});
    json.key("best_path").value(std::uint64_t{frame.best_path});
    ClearanceRow row(json, frame);
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
    json.key("scene").value(std::string_view(scene.name()));
    json.key("technique").value(to_string(Technique::cpu));
    json.key("device").null();
    json.key("min_clearance").value(scene.query().min_clearance);
    json.key("max_clearance").value(scene.query().max_clearance);
    json.key("objects").value(std::uint64_t{scene.obstacles().size()});
    json.key("lines").value(std::uint64_t{scene.line_count()});
    json.key("paths_a_frame").value(std::uint64_t{report.frames.back().paths});
    json.key("poses_a_frame").value(std::uint64_t{report.frames.back().poses});
    json.key("least_clearance").value(least_clearance(report));
    json.key("median_query_ms").value(query_times(report).median);
    json.key("frames").begin_array(JsonWriter::Layout::lines);
    for (const ClearanceFrame& frame : report.frames) {
        write_frame(json, frame);
    }
    json.end_array();
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
