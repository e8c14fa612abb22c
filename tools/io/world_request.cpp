#include <tools/io/input_error.hpp>
#include <tools/io/json_document.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/values.hpp>
#include <tools/io/world_request.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <utility>

namespace nearfield::tools {
namespace {

using nlohmann::json;

constexpr const char* point_form = "[x, y] (two numbers)";
constexpr const char* pose_form = "[x, y, degrees] (three numbers)";
constexpr const char* segment_form = "[x0, y0, x1, y1] (four numbers)";
constexpr const char* sweep_form = "[[x, y, degrees], [x, y, degrees]] (six numbers)";

/// An array of pairs of poses.
NumberTable read_pose_pairs(const JsonPlace& place) {
    NumberTable table{.numbers = {}, .columns = 6};
    const json& rows = place.require_array().value();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const json& row = rows[i];
        if (!row.is_array() || row.size() != 2) {
            place.element(i).fail(std::string("expected ") + sweep_form);
        }
        for (std::size_t pose = 0; pose < 2; ++pose) {
            if (!append_row(row[pose], 3, table.numbers)) {
                static_cast<void>(numbers(place.element(i).element(pose), 3, pose_form));
            }
        }
    }
    return table;
}

/// Reads one query.
class WorldRequestReader {
public:
    WorldRequestReader(const JsonPlace& place, const Scene& scene, std::vector<std::string>& files)
        : place_(place), scene_(scene), files_(files) {}

    WorldRequest read(WorldQueryType type) {
        request_.type = type;
        read_own_members();
        if (place_.has("against")) {
            request_.against = read_instance_group(place_.member("against"), scene_);
        }
        if (place_.has("except")) {
            request_.except = find_entry(scene_.instances, place_.member("except"), "instance");
        }
        if (place_.has("technique")) {
            request_.technique = read_name<Technique>(place_.member("technique"));
        }
        if (place_.has("records")) {
            request_.records = place_.member("records").boolean();
        }
        if (place_.has("values")) {
            read_values_path();
        }
        return std::move(request_);
    }

private:
    void require_members(std::initializer_list<std::string_view> own) {
        std::vector<std::string_view> known{"query",     "against", "except",
                                            "technique", "records", "values"};
        known.insert(known.end(), own.begin(), own.end());
        require_known_members(place_, known);
    }

    void read_own_members() {
        switch (request_.type) {
            case WorldQueryType::poses:
                require_members(
                    {"shape", "poses", "poses_file", "answer", "min_clearance", "max_clearance"});
                read_poses_query();
                break;
            case WorldQueryType::nearest:
                require_members({"points", "points_file", "shape", "poses", "poses_file", "count",
                                 "kind", "max_distance"});
                read_nearest_query();
                break;
            case WorldQueryType::rays:
                require_members({"segments", "segments_file", "hits"});
                read_segments();
                request_.all_hits = has_choice("hits", "first", "all");
                break;
            case WorldQueryType::cast:
                require_members(
                    {"shape", "sweeps", "sweeps_file", "tolerance", "contact_distance"});
                read_cast_query();
                break;
            case WorldQueryType::overlap:
                require_members({"rectangles", "rectangles_file", "points", "points_file", "shape",
                                 "poses", "poses_file"});
                read_overlap_query();
                break;
        }
    }

    void read_poses_query() {
        read_shape();
        read_poses();
        request_.clearance = has_choice("answer", "hits", "clearance");
        for (const auto& [key, limit] :
             {std::pair{"min_clearance", &WorldRequest::min_clearance},
              std::pair{"max_clearance", &WorldRequest::max_clearance}}) {
            if (place_.has(key)) {
                if (!request_.clearance) {
                    place_.member(key).fail("belongs to the answer \"clearance\"");
                }
                request_.*limit = place_.member(key).number();
            }
        }
        if (request_.max_clearance < 0.0) {
            place_.member("max_clearance").fail("expected a number of at least 0");
        }
        if (request_.min_clearance >= request_.max_clearance) {
            place_.member("min_clearance").fail("expected less than \"max_clearance\"");
        }
    }

    void read_nearest_query() {
        require_one_table({"points", "poses"}, "either \"points\", or \"shape\" and \"poses\"");
        read_places();
        request_.kind =
            has_choice("kind", "instances", "edges") ? NearestKind::edges : NearestKind::instances;
        if (place_.has("count")) {
            request_.count = read_count(place_.member("count"));
        }
        if (place_.has("max_distance")) {
            request_.max_distance = read_not_negative("max_distance");
        }
    }

    void read_cast_query() {
        read_shape();
        read_sweeps();
        request_.tolerance = read_above_zero(place_.member("tolerance"));
        if (place_.has("contact_distance")) {
            request_.contact_distance = read_not_negative("contact_distance");
        }
    }

    void read_overlap_query() {
        require_one_table({"rectangles", "points", "poses"},
                          "either \"rectangles\", \"points\", or \"shape\" and \"poses\"");
        read_places();
    }

    void require_one_table(std::initializer_list<const char*> keys, const std::string& needed) {
        const auto count = std::count_if(keys.begin(), keys.end(),
                                         [this](const char* key) { return has_table(key); });
        if (count != 1) {
            place_.fail("needs " + needed);
        }
    }

    /// Reads the one table that there is: of poses of a shape, points or rectangles.
    void read_places() {
        if (has_table("poses")) {
            read_shape();
            read_poses();
            return;
        }
        if (place_.has("shape")) {
            place_.member("shape").fail("belongs to \"poses\"");
        }
        if (has_table("points")) {
            read_points();
        } else {
            read_rectangles();
        }
    }

    /// A name that is one of two, the first by default: true if it is the second.
    [[nodiscard]] bool has_choice(const char* key, const std::string& first,
                                  const std::string& second) const {
        if (!place_.has(key)) {
            return false;
        }
        const std::string& name = place_.member(key).string();
        if (name != first && name != second) {
            place_.member(key).fail("\"" + name + "\" is none of " + first + ", " + second);
        }
        return name == second;
    }

    [[nodiscard]] double read_not_negative(const char* key) const {
        const double number = place_.member(key).number();
        if (number < 0.0) {
            place_.member(key).fail("expected a number of at least 0");
        }
        return number;
    }

    void read_shape() {
        request_.shape = find_entry(scene_.shapes, place_.member("shape"), "shape");
    }

    [[nodiscard]] bool has_table(const std::string& key) const {
        return place_.has(key) || place_.has(key + "_file");
    }

    /// Reads the rows of `key`, or of the file that `key`_file names.
    template <class Read>
    NumberTable read_table(const std::string& key, std::size_t columns, const std::string& form,
                           Read read_array) {
        const std::string file_key = key + "_file";
        if (place_.has(key) == place_.has(file_key)) {
            place_.fail("needs either \"" + key + "\" or \"" + file_key + "\"");
        }
        if (place_.has(key)) {
            return read_array(place_.member(key));
        }
        const JsonPlace name = place_.member(file_key);
        const std::string path = read_path(name);
        files_.push_back(path);
        try {
            return read_number_table({path, read_bytes(path)}, columns, form);
        } catch (const InputError& error) {
            name.fail(error.what());
        }
    }

    NumberTable read_table(const std::string& key, std::size_t columns, const std::string& form) {
        return read_table(key, columns, form,
                          [&](const JsonPlace& rows) { return read_rows(rows, columns, form); });
    }

    /// "poses[3]" in the scene, or the row in the file.
    [[noreturn]] void fail_row(const std::string& key, std::size_t row, const std::string& reason) {
        const std::string number = std::to_string(row);
        if (place_.has(key)) {
            throw InputError(place_.member(key).text() + "[" + number + "]: " + reason);
        }
        place_.member(key + "_file").fail(files_.back() + ": row " + number + ": " + reason);
    }

    void read_poses() {
        const NumberTable table = read_table("poses", 3, pose_form);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double* const row = table.row(i);
            require_point("poses", i, row);
            require_angle_of("poses", i, row[2]);
            request_.poses.push_back(to_pose({row[0], row[1], row[2]}));
        }
    }

    /// `axis`: "x" or "y".
    void require_coordinate(const char* key, std::size_t row, const char* axis, double number) {
        if (std::abs(number) > largest_coordinate) {
            char text[120];
            std::snprintf(text, sizeof text,
                          "%s is %.17g; coordinates must be at most %g in "
                          "magnitude",
                          axis, number, largest_coordinate);
            fail_row(key, row, text);
        }
    }

    void require_point(const char* key, std::size_t row, const double* point) {
        require_coordinate(key, row, "x", point[0]);
        require_coordinate(key, row, "y", point[1]);
    }

    void require_angle_of(const char* key, std::size_t row, double degrees) {
        if (const std::string problem = angle_problem(degrees); !problem.empty()) {
            fail_row(key, row, problem);
        }
    }

    void read_points() {
        const NumberTable table = read_table("points", 2, point_form);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            require_point("points", i, table.row(i));
            request_.points.push_back({table.row(i)[0], table.row(i)[1]});
        }
    }

    void read_segments() {
        const NumberTable table = read_table("segments", 4, segment_form);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double* const row = table.row(i);
            require_point("segments", i, row);
            require_point("segments", i, row + 2);
            request_.segments.push_back({{row[0], row[1]}, {row[2], row[3]}});
        }
    }

    void read_rectangles() {
        const NumberTable table = read_table("rectangles", 4, segment_form);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double* const row = table.row(i);
            require_point("rectangles", i, row);
            require_point("rectangles", i, row + 2);
            if (row[0] > row[2] || row[1] > row[3]) {
                fail_row("rectangles", i, "expected x0 <= x1 and y0 <= y1");
            }
            request_.rectangles.push_back({{row[0], row[1]}, {row[2], row[3]}});
        }
    }

    void read_sweeps() {
        const NumberTable table = read_table("sweeps", 6, sweep_form, read_pose_pairs);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double* const row = table.row(i);
            require_point("sweeps", i, row);
            require_point("sweeps", i, row + 3);
            require_angle_of("sweeps", i, row[2]);
            require_angle_of("sweeps", i, row[5]);
            request_.sweeps.push_back(
                {to_pose({row[0], row[1], row[2]}), to_end_pose({row[3], row[4], row[5]}, row[2])});
        }
    }

    void read_values_path() {
        const JsonPlace name = place_.member("values");
        request_.values = read_path(name);
        if (!is_npy(request_.values) && !request_.values.ends_with(".csv")) {
            name.fail("\"" + name.string() + "\" ends neither in .npy nor in .csv");
        }
        if (!request_.records) {
            name.fail("there are no records to write: \"records\" is false");
        }
    }

    const JsonPlace& place_;
    const Scene& scene_;
    std::vector<std::string>& files_;
    WorldRequest request_;
};

}  // namespace

std::vector<std::string_view> world_query_type_names() {
    std::vector<std::string_view> all;
    all.reserve(std::size(names<WorldQueryType>));
    for (const auto& [text, type] : names<WorldQueryType>) {
        all.push_back(text);
    }
    return all;
}

WorldRequest read_world_request(const JsonPlace& place, WorldQueryType type, const Scene& scene,
                                std::vector<std::string>& files) {
    return WorldRequestReader(place, scene, files).read(type);
}

InstanceGroup read_instance_group(const JsonPlace& place, const Scene& scene) {
    const std::string& name = place.string();
    if (const auto group = find_name(scene.groups, name)) {
        const SceneGroup& found = scene.groups[*group];
        if (!found.problem.empty()) {
            const std::string prefix = place.file() + ": ";
            place.fail(found.problem.substr(found.problem.starts_with(prefix) ? prefix.size() : 0));
        }
        return {name, found.instances};
    }
    const auto instance = find_name(scene.instances, name);
    if (!instance) {
        place.fail("there is no group or instance \"" + name + "\"");
    }
    return {name, {*instance}};
}

namespace {

/// What messages call a query that the device does not answer; empty for others.
std::string unanswered_by_device(const WorldRequest& request) {
    std::string name(name_of(request.type));
    switch (request.type) {
        case WorldQueryType::poses:
            return request.clearance ? name + " with \"answer\": \"clearance\"" : "";
        case WorldQueryType::nearest:
            if (request.shape) {
                return name + " of a shape";
            }
            return request.count > 1 ? name + " with a \"count\" above 1" : "";
        case WorldQueryType::rays:
            return request.all_hits ? name + " with \"hits\": \"all\"" : "";
        case WorldQueryType::cast:
        case WorldQueryType::overlap:
            break;
    }
    return name;
}

}  // namespace

Technique answering_technique(const WorldRequest& request) {
    return request.technique == Technique::compute ? Technique::compute : Technique::cpu;
}

std::string technique_problem(const WorldRequest& request) {
    if (request.technique == Technique::raster) {
        return "the technique raster does not answer " + std::string(name_of(request.type)) +
               ", nor any other query of all instances; ask for another, or for automatic";
    }
    const std::string what =
        request.technique == Technique::compute ? unanswered_by_device(request) : "";
    return what.empty() ? ""
                        : "the technique compute does not answer " + what +
                              "; of all instances it answers poses with \"answer\": \"hits\", "
                              "nearest of points with \"count\": 1, and rays with \"hits\": "
                              "\"first\"; ask for cpu, or for automatic";
}

}  // namespace nearfield::tools
