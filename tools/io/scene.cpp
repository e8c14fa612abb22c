#include <tools/io/geojson.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/json_document.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

using nlohmann::json;

/// A member that is not known: of a scene that is not understood.
class UnknownMember : public InputError {
public:
    using InputError::InputError;
};

void require_known_members(const JsonPlace& place, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : place.require_object().value().items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw UnknownMember(place.member(key).text() + ": is not known here");
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

double read_above_zero(const JsonPlace& place) {
    const double number = place.number();
    if (!(number > 0.0)) {
        place.fail("expected a number greater than 0");
    }
    return number;
}

Outline read_shape(const JsonPlace& place) {
    require_known_members(place, {"file", "rings", "deviation", "fill_rule", "clean_width"});
    if (place.has("file") == place.has("rings")) {
        place.fail("needs either \"file\" or \"rings\"");
    }
    Outline outline;
    if (place.has("rings")) {
        append_rings(place.member("rings"), outline.rings);
        outline.file = place.member("rings").text();
    } else {
        const std::filesystem::path folder = std::filesystem::path(place.file()).parent_path();
        outline = read_outline((folder / place.member("file").string()).string());
    }
    if (place.has("deviation") && !outline.curved()) {
        place.member("deviation").fail("the shape has no curves");
    }
    return outline;
}

/// The maximum deviation of a shape's rings from its curves: stated by the shape, or derived from
/// the tolerances of its queries.
double shape_deviation(const JsonPlace& place, std::size_t shape, const Scene& scene) {
    if (place.has("deviation")) {
        return read_above_zero(place.member("deviation"));
    }
    const bool is_placed =
        std::any_of(scene.instances.begin(), scene.instances.end(),
                    [&](const SceneInstance& instance) { return instance.shape == shape; });
    double smallest = std::numeric_limits<double>::infinity();
    for (const SceneQuery& query : scene.queries) {
        if (!query.problem.empty()) {
            continue;
        }
        const bool takes_part = query.all_pairs ? is_placed
                                                : scene.instances[query.a].shape == shape ||
                                                      scene.instances[query.b].shape == shape;
        if (takes_part && query.request.tolerance > 0.0) {
            smallest = std::min(smallest, query.request.tolerance);
        }
    }
    if (!std::isfinite(smallest)) {
        place.fail("has curves and is in no query with a tolerance; needs \"deviation\"");
    }
    return usual_deviation * smallest;
}

OutlineTreatment read_treatment(const JsonPlace& place, EmptyRings empty) {
    OutlineTreatment treatment{.strict = empty == EmptyRings::kept};
    if (place.has("fill_rule")) {
        const JsonPlace rule = place.member("fill_rule");
        treatment.fill_rule = parse_fill_rule(rule.string(), rule.text());
    }
    if (place.has("clean_width")) {
        treatment.clean_width = read_above_zero(place.member("clean_width"));
    }
    return treatment;
}

/// Adds to what is said about a place; nothing where there is nothing to say.
void add_note(std::string& note, const JsonPlace& place, const std::string& text) {
    if (!text.empty()) {
        const bool names_place = text.starts_with(place.text());
        note += note.empty() ? (names_place ? text : place.text() + ": " + text) : "; " + text;
    }
}

/// Finds the index of the entry named by the string at a place.
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

void require_angle(const JsonPlace& pose, double degrees) {
    if (const std::string problem = angle_problem(degrees); !problem.empty()) {
        pose.fail(problem);
    }
}

SceneInstance read_instance(const std::string& name, const JsonPlace& place, const Scene& scene) {
    require_known_members(place, {"shape", "pose", "end_pose"});
    SceneInstance instance;
    instance.name = name;
    instance.shape = find_entry(scene.shapes, place.member("shape"), "shape");
    const std::string form = "[x, y, degrees] (three numbers)";
    std::vector<double> pose{0.0, 0.0, 0.0};
    if (place.has("pose")) {
        pose = numbers(place.member("pose"), 3, form);
        require_angle(place.member("pose"), pose[2]);
        instance.pose = to_pose({pose[0], pose[1], pose[2]});
    }
    if (place.has("end_pose")) {
        const std::vector<double> end = numbers(place.member("end_pose"), 3, form);
        require_angle(place.member("end_pose"), end[2]);
        instance.end_pose = to_end_pose({end[0], end[1], end[2]}, pose[2]);
    }
    return instance;
}

Rectangle read_rectangle(const JsonPlace& place) {
    const std::vector<double> corners = numbers(place, 4, "[x0, y0, x1, y1] (four numbers)");
    if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
        place.fail("expected x0 < x1 and y0 < y1");
    }
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

/// Parses a name with one of the command line's parsers; its errors name the place.
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

std::uint32_t read_count(const JsonPlace& place) {
    const double number = place.number();
    if (!(number >= 1.0 && number <= 1e9 && number == std::floor(number))) {
        place.fail("expected a whole number from 1 to 1000000000");
    }
    return static_cast<std::uint32_t>(number);
}

void read_motion_request(const JsonPlace& place, QueryRequest& request) {
    if (place.has("time_bound")) {
        request.time_bound = read_above_zero(place.member("time_bound"));
    }
    if (place.has("most_steps")) {
        request.max_steps = read_count(place.member("most_steps"));
    }
}

/// The members that a query of a type may have.
std::vector<std::string_view> members_of(QueryType type) {
    std::vector<std::string_view> members{"query", "a", "b", "pairs", "tolerance", "technique"};
    const auto add = [&members](std::initializer_list<std::string_view> more) {
        members.insert(members.end(), more);
    };
    if (is_sampled(type)) {
        add({"reach", "strategy", "records"});
    }
    switch (type) {
        case QueryType::penetration:
            add({"points"});
            break;
        case QueryType::intersection:
            add({"kind"});
            break;
        case QueryType::distance_field:
            add({"rect", "sign", "gradient", "gradients", "features", "values", "at"});
            break;
        case QueryType::contacts:
            add({"contact_distance", "normals"});
            break;
        case QueryType::time_of_impact:
            add({"contact_distance", "time_bound", "most_steps"});
            break;
        case QueryType::closest_point:
        case QueryType::separation:
        case QueryType::intersection_test:
        case QueryType::containment:
            break;
        case QueryType::separation_vector:
            add({"most_work"});
            break;
    }
    return members;
}

/// Reads the members that several types of query share.
void read_shared_members(const JsonPlace& place, QueryRequest& request) {
    if (!is_exact(request.type) || place.has("tolerance")) {
        request.tolerance = read_above_zero(place.member("tolerance"));
    }
    if (place.has("strategy")) {
        request.strategy = parse_member(place, "strategy", parse_strategy);
    }
    const bool names_a_way_of_drawing =
        (request.type == QueryType::intersection && place.has("strategy")) ||
        (request.type == QueryType::distance_field && place.has("sign"));
    if (place.has("technique")) {
        request.technique = parse_member(place, "technique", parse_technique);
    } else if (names_a_way_of_drawing) {
        request.technique = Technique::raster;
    }
    if (place.has("contact_distance")) {
        request.contact_distance = read_above_zero(place.member("contact_distance"));
    }
    if (place.has("records")) {
        request.records = place.member("records").boolean();
    }
}

QueryRequest read_request(const JsonPlace& place) {
    QueryRequest request;
    request.type = parse_member(place, "query", parse_query_type);
    if (place.has("reach") && !(place.has("pairs") && request.type == QueryType::separation)) {
        place.member("reach").fail("belongs to the separation of all pairs");
    }
    require_known_members(place, members_of(request.type));
    read_shared_members(place, request);
    if (place.has("points")) {
        request.points = parse_member(place, "points", parse_points);
    }
    if (place.has("kind")) {
        request.kind = parse_member(place, "kind", parse_kind);
    }
    if (place.has("normals")) {
        request.normals = parse_member(place, "normals", parse_normals);
    }
    if (request.type == QueryType::distance_field) {
        read_field_request(place, request);
    }
    if (request.type == QueryType::time_of_impact) {
        read_motion_request(place, request);
    }
    if (place.has("most_work")) {
        request.max_work = read_count(place.member("most_work"));
    }
    return request;
}

/// Reads "pairs": "all", which replaces two instances.
void read_pairs(const JsonPlace& place, SceneQuery& query) {
    const JsonPlace pairs = place.member("pairs");
    if (pairs.string() != "all") {
        pairs.fail("\"" + pairs.string() + "\" is not all");
    }
    for (const char* key : {"a", "b"}) {
        if (place.has(key)) {
            place.member(key).fail("stands beside \"pairs\"");
        }
    }
    query.all_pairs = true;
    if (query.request.type == QueryType::separation) {
        query.reach = read_above_zero(place.member("reach"));
    }
}

SceneQuery read_query(const JsonPlace& place, const Scene& scene) {
    SceneQuery query;
    query.request = read_request(place.require_object());
    if (place.has("pairs")) {
        read_pairs(place, query);
        return query;
    }
    query.a = find_entry(scene.instances, place.member("a"), "instance");
    query.b = find_entry(scene.instances, place.member("b"), "instance");
    return query;
}

/// The text of a member as the file has it; empty where there is none.
std::string text_of(const JsonPlace& place, const char* key) {
    const json& value = place.value();
    const bool has_text = value.is_object() && value.contains(key) && value[key].is_string();
    return has_text ? value[key].get<std::string>() : std::string();
}

/// Reads shapes, instances and queries, in this order.
class SceneReader {
public:
    SceneReader(const JsonPlace& root, BadEntries bad, EmptyRings empty)
        : bad_(bad),
          empty_(empty),
          shapes_(root.member("shapes")),
          instances_(root.member("instances")),
          queries_(root.member("queries")) {}

    Scene read() {
        for (const auto& [name, value] : shapes_.require_object().value().items()) {
            read_outline_of(name);
        }
        for (const auto& [name, value] : instances_.require_object().value().items()) {
            read_instance_of(name);
        }
        for (std::size_t index = 0; index < queries_.require_array().value().size(); ++index) {
            read_query_of(queries_.element(index));
        }
        for (std::size_t index = 0; index < outlines_.size(); ++index) {
            tessellate_shape(index);
        }
        return std::move(scene_);
    }

private:
    /// Reads one entry; what is wrong with it becomes its problem, where that is asked for.
    template <class Read>
    void attempt(const JsonPlace& place, std::string& problem, Read read) {
        try {
            read(place);
        } catch (const UnknownMember&) {
            throw;
        } catch (const InputError& error) {
            if (bad_ == BadEntries::refused) {
                throw;
            }
            const std::string text = error.what();  // may name only the outline's file
            problem = text.starts_with(place.text()) ? text : place.text() + ": " + text;
        }
    }

    void read_outline_of(const std::string& name) {
        SceneShape shape{.name = name};
        Outline outline;
        attempt(shapes_.member(name), shape.problem, [&](const JsonPlace& place) {
            outline = read_shape(place);
            if (!outline.skipped.empty()) {
                add_note(shape.note, place, skipped_note(outline));
            }
        });
        scene_.shapes.push_back(std::move(shape));
        outlines_.push_back(std::move(outline));
    }

    void read_instance_of(const std::string& name) {
        SceneInstance instance{.name = name};
        std::string problem;
        attempt(instances_.member(name), problem,
                [&](const JsonPlace& place) { instance = read_instance(name, place, scene_); });
        instance.problem = problem;
        scene_.instances.push_back(std::move(instance));
    }

    void read_query_of(const JsonPlace& place) {
        SceneQuery query;
        std::string problem;
        attempt(place, problem, [&](const JsonPlace& where) { query = read_query(where, scene_); });
        query.problem = problem;
        query.kind = text_of(place, "query");
        query.name_a = text_of(place, "a");
        query.name_b = text_of(place, "b");
        scene_.queries.push_back(std::move(query));
    }

    void tessellate_shape(std::size_t index) {
        SceneShape& shape = scene_.shapes[index];
        if (!shape.problem.empty()) {
            return;
        }
        attempt(shapes_.member(shape.name), shape.problem, [&](const JsonPlace& place) {
            const Outline& outline = outlines_[index];
            const double deviation = outline.curved() ? shape_deviation(place, index, scene_) : 0.0;
            ShapeRings rings = make_shape_rings(outline, deviation, read_treatment(place, empty_));
            shape.rings = std::move(rings.rings);
            shape.deviation = rings.deviation;
            add_note(shape.note, place, rings.note);
        });
    }

    BadEntries bad_;
    EmptyRings empty_;
    JsonPlace shapes_;
    JsonPlace instances_;
    JsonPlace queries_;
    std::vector<Outline> outlines_;
    Scene scene_;
};

}  // namespace

Scene read_scene(const std::string& path, BadEntries bad, EmptyRings empty) {
    const json document = parse_json(read_text(path), path);
    return SceneReader(JsonPlace(document, path), bad, empty).read();
}

}  // namespace nearfield::tools
