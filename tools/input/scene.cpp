#include <tools/input/geojson.hpp>
#include <tools/input/json_document.hpp>
#include <tools/input/outline.hpp>
#include <tools/input/scene.hpp>
#include <tools/input/text_file.hpp>
#include <tools/input/values.hpp>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

using nlohmann::json;

void require_known_members(const JsonPlace& place, std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : place.require_object().value().items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            place.member(key).fail("is not known here");
        }
    }
}

std::vector<double> numbers(const JsonPlace& place, std::size_t count, const std::string& form) {
    if (place.require_array().value().size() != count) {
        place.fail("expected " + form);
    }
    std::vector<double> numbers;
    for (std::size_t index = 0; index < count; ++index) {
        numbers.push_back(place.element(index).number());
    }
    return numbers;
}

SceneShape read_shape(const std::string& name, const JsonPlace& place) {
    require_known_members(place, {"file", "rings"});
    if (place.has("file") == place.has("rings")) {
        place.fail("needs either \"file\" or \"rings\"");
    }
    SceneShape shape{name, {}};
    if (place.has("rings")) {
        append_rings(place.member("rings"), shape.rings);
    } else {
        const std::filesystem::path folder = std::filesystem::path(place.file()).parent_path();
        shape.rings = read_outline((folder / place.member("file").string()).string());
    }
    return shape;
}

/// The index of the entry that has the name standing at a place.
template <class Entry>
std::size_t find_entry(const std::vector<Entry>& entries, const JsonPlace& place,
                       const std::string& kind) {
    const std::string& name = place.string();
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    if (found == entries.end()) {
        place.fail("there is no " + kind + " \"" + name + "\"");
    }
    return static_cast<std::size_t>(found - entries.begin());
}

SceneInstance read_instance(const std::string& name, const JsonPlace& place, const Scene& scene) {
    require_known_members(place, {"shape", "pose"});
    SceneInstance instance;
    instance.name = name;
    instance.shape = find_entry(scene.shapes, place.member("shape"), "shape");
    if (place.has("pose")) {
        const std::vector<double> pose =
            numbers(place.member("pose"), 3, "[x, y, degrees] (three numbers)");
        instance.pose = pose_from_degrees(pose[0], pose[1], pose[2]);
    }
    return instance;
}

double read_tolerance(const JsonPlace& place) {
    const double tolerance = place.number();
    if (!(tolerance > 0.0)) {
        place.fail("expected a number greater than 0");
    }
    return tolerance;
}

Rectangle read_rectangle(const JsonPlace& place) {
    const std::vector<double> corners = numbers(place, 4, "[x0, y0, x1, y1] (four numbers)");
    if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
        place.fail("expected x0 < x1 and y0 < y1");
    }
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

/// Reads a name with one of the parsers the command line uses, and lets it say where it stands.
template <class Parse>
auto parse_member(const JsonPlace& place, const std::string& key, Parse parse) {
    const JsonPlace member = place.member(key);
    return parse(member.string(), member.text());
}

void read_field_request(const JsonPlace& place, QueryRequest& request) {
    if (place.has("rect")) {
        request.rectangle = read_rectangle(place.member("rect"));
    }
    if (place.has("sign")) {
        request.sign = parse_member(place, "sign", parse_sign);
    }
    for (const auto& [key, asked] : {std::pair{"values", &QueryRequest::values},
                                     std::pair{"features", &QueryRequest::features},
                                     std::pair{"gradients", &QueryRequest::gradients}}) {
        if (place.has(key)) {
            request.*asked = place.member(key).boolean();
        }
    }
    if (place.has("at")) {
        const JsonPlace points = place.member("at");
        for (std::size_t i = 0; i < points.require_array().value().size(); ++i) {
            const std::vector<double> point = numbers(points.element(i), 2, "[x, y] (two numbers)");
            request.at.push_back({point[0], point[1]});
        }
    }
    if (place.has("gradient")) {
        request.gradient = parse_member(place, "gradient", parse_gradient);
        if (!request.gradients && request.at.empty()) {
            place.member("gradient").fail("there is no gradient asked for, by gradients or at");
        }
    }
}

QueryRequest read_request(const JsonPlace& place) {
    QueryRequest request;
    request.type = parse_member(place, "query", parse_query_type);
    request.tolerance = read_tolerance(place.member("tolerance"));
    if (place.has("technique")) {
        parse_member(place, "technique", check_technique);
    }
    if (place.has("strategy")) {
        parse_member(place, "strategy", check_strategy);
    }
    switch (request.type) {
        case QueryType::penetration:
            require_known_members(place, {"query", "a", "b", "tolerance", "technique", "strategy",
                                          "records", "points"});
            if (place.has("points")) {
                request.points = parse_member(place, "points", parse_points);
            }
            break;
        case QueryType::intersection:
            require_known_members(place, {"query", "a", "b", "tolerance", "technique", "strategy",
                                          "records", "kind"});
            if (place.has("kind")) {
                request.kind = parse_member(place, "kind", parse_kind);
            }
            break;
        case QueryType::distance_field:
            require_known_members(
                place, {"query", "a", "b", "tolerance", "technique", "strategy", "records", "rect",
                        "sign", "gradient", "gradients", "features", "values", "at"});
            read_field_request(place, request);
            break;
    }
    if (place.has("records")) {
        request.records = place.member("records").boolean();
    }
    return request;
}

SceneQuery read_query(const JsonPlace& place, const Scene& scene) {
    if (place.require_object().has("pairs")) {
        place.member("pairs").fail("this version answers single pairs only, given by a and b");
    }
    SceneQuery query;
    query.request = read_request(place);
    query.a = find_entry(scene.instances, place.member("a"), "instance");
    query.b = find_entry(scene.instances, place.member("b"), "instance");
    return query;
}

}  // namespace

Scene read_scene(const std::string& path) {
    const json document = parse_json(read_text(path), path);
    const JsonPlace root(document, path);
    const JsonPlace shapes = root.member("shapes");
    const JsonPlace instances = root.member("instances");
    const JsonPlace queries = root.member("queries");
    Scene scene;
    for (const auto& [name, value] : shapes.require_object().value().items()) {
        scene.shapes.push_back(read_shape(name, shapes.member(name)));
    }
    for (const auto& [name, value] : instances.require_object().value().items()) {
        scene.instances.push_back(read_instance(name, instances.member(name), scene));
    }
    for (std::size_t index = 0; index < queries.require_array().value().size(); ++index) {
        scene.queries.push_back(read_query(queries.element(index), scene));
    }
    return scene;
}

}  // namespace nearfield::tools
