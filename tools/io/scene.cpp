#include <tools/io/input_error.hpp>
#include <tools/io/json_document.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

using nlohmann::json;

Outline read_shape(const JsonPlace& place) {
    require_known_members(
        place, {"file", "rings", "units", "deviation", "fill_rule", "clean_width", "offset"});
    if (place.has("file") == place.has("rings")) {
        place.fail("needs either \"file\" or \"rings\"");
    }
    Outline outline;
    if (place.has("rings")) {
        append_rings(place.member("rings"), outline.rings);
        outline.file = place.member("rings").text();
        if (place.has("units")) {
            place.member("units").fail("belongs to \"file\"");
        }
    } else {
        const LengthUnit unit =
            place.has("units") ? read_name<LengthUnit>(place.member("units")) : LengthUnit::user;
        outline = read_outline(read_path(place.member("file")), unit);
    }
    if (place.has("deviation")) {
        static_cast<void>(read_above_zero(place.member("deviation")));
    }
    return outline;
}

/// True of a query whose answer may depend on a shape.
bool takes_part(const SceneQuery& query, std::size_t shape, bool is_placed, const Scene& scene) {
    if (query.world) {
        return is_placed || query.world->shape == shape;
    }
    return query.all_pairs
               ? is_placed
               : scene.instances[query.a].shape == shape || scene.instances[query.b].shape == shape;
}

/// The maximum deviation of a shape's rings from its curves and those of its offset: stated by the
/// shape, or derived from the tolerances of its queries.
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
        const double tolerance = query.world ? query.world->tolerance : query.request.tolerance;
        if (tolerance > 0.0 && takes_part(query, shape, is_placed, scene)) {
            smallest = std::min(smallest, tolerance);
        }
    }
    if (!std::isfinite(smallest)) {
        place.fail(
            "has curves or an offset and is in no query with a tolerance; needs \"deviation\"");
    }
    return usual_deviation * smallest;
}

OutlineTreatment read_treatment(const JsonPlace& place, EmptyRings empty) {
    OutlineTreatment treatment{.strict = empty == EmptyRings::kept};
    if (place.has("fill_rule")) {
        treatment.fill_rule = read_name<FillRule>(place.member("fill_rule"));
    }
    if (place.has("clean_width")) {
        treatment.clean_width = read_above_zero(place.member("clean_width"));
    }
    if (place.has("offset")) {
        const JsonPlace offset = place.member("offset");
        treatment.offset = offset.number();
        if (*treatment.offset == 0.0) {
            offset.fail("expected a number other than 0");
        }
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

/// Reads {"between": [GROUP, GROUP]}.
GroupPair read_between(const JsonPlace& pairs, const Scene& scene) {
    require_known_members(pairs, {"between"});
    const JsonPlace between = pairs.member("between");
    if (between.require_array().value().size() != 2) {
        between.fail("expected [GROUP, GROUP] (two names)");
    }
    return {read_instance_group(between.element(0), scene),
            read_instance_group(between.element(1), scene)};
}

/// Reads "pairs": "all" or {"between": ...}, which replaces two instances.
void read_pairs(const JsonPlace& place, const Scene& scene, SceneQuery& query) {
    const JsonPlace pairs = place.member("pairs");
    if (pairs.value().is_object()) {
        query.between = read_between(pairs, scene);
    } else if (pairs.string() != "all") {
        pairs.fail("\"" + pairs.string() + "\" is not all");
    }
    for (const char* key : {"a", "b"}) {
        if (place.has(key)) {
            place.member(key).fail("stands beside \"pairs\"");
        }
    }
    query.all_pairs = true;
    query.hits_only = place.has("hits_only") && place.member("hits_only").boolean();
    if (query.request.type == QueryType::separation) {
        query.reach = read_above_zero(place.member("reach"));
    }
}

SceneQuery read_query(const JsonPlace& place, const Scene& scene, std::vector<std::string>& files) {
    SceneQuery query;
    const auto type = find_named<WorldQueryType>(place.require_object().member("query").string());
    if (type) {
        query.world = read_world_request(place, *type, scene, files);
        return query;
    }
    query.request = read_query_request(place);
    if (place.has("pairs")) {
        read_pairs(place, scene, query);
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

/// The names of instances, each once and not their own group.
void read_group(const JsonPlace& place, const Scene& scene, SceneGroup& group) {
    if (find_name(scene.instances, group.name)) {
        place.fail("is also the name of an instance");
    }
    for (std::size_t i = 0; i < place.require_array().value().size(); ++i) {
        group.instances.push_back(find_entry(scene.instances, place.element(i), "instance"));
    }
    std::sort(group.instances.begin(), group.instances.end());
    const auto twice = std::adjacent_find(group.instances.begin(), group.instances.end());
    if (twice != group.instances.end()) {
        place.fail("names \"" + scene.instances[*twice].name + "\" twice");
    }
}

/// Reads shapes, instances, groups and queries, in this order.
class SceneReader {
public:
    SceneReader(const JsonPlace& root, BadEntries bad, EmptyRings empty)
        : bad_(bad),
          empty_(empty),
          root_(root),
          shapes_(root.member("shapes")),
          instances_(root.member("instances")),
          queries_(root.member("queries")) {}

    Scene read() {
        scene_.files.push_back(root_.file());
        for (const auto& [name, value] : shapes_.require_object().value().items()) {
            read_outline_of(name);
        }
        for (const auto& [name, value] : instances_.require_object().value().items()) {
            read_instance_of(name);
        }
        if (root_.has("groups")) {
            const JsonPlace groups = root_.member("groups");
            for (const auto& [name, value] : groups.require_object().value().items()) {
                read_group_of(groups.member(name), name);
            }
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
            if (place.value().is_object() && place.has("file")) {
                scene_.files.push_back(read_path(place.member("file")));
            }
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

    void read_group_of(const JsonPlace& place, const std::string& name) {
        SceneGroup group{.name = name};
        attempt(place, group.problem,
                [&](const JsonPlace& where) { read_group(where, scene_, group); });
        scene_.groups.push_back(std::move(group));
    }

    void read_query_of(const JsonPlace& place) {
        SceneQuery query;
        std::string problem;
        attempt(place, problem,
                [&](const JsonPlace& where) { query = read_query(where, scene_, scene_.files); });
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
            const OutlineTreatment treatment = read_treatment(place, empty_);
            const double deviation =
                needs_deviation(outline, treatment) ? shape_deviation(place, index, scene_) : 0.0;
            ShapeRings rings = make_shape_rings(outline, deviation, treatment);
            shape.rings = std::move(rings.rings);
            shape.deviation = rings.deviation;
            add_note(shape.note, place, rings.note);
        });
    }

    BadEntries bad_;
    EmptyRings empty_;
    JsonPlace root_;
    JsonPlace shapes_;
    JsonPlace instances_;
    JsonPlace queries_;
    std::vector<Outline> outlines_;
    Scene scene_;
};

}  // namespace

bool holds_scene(const InputFile& file) {
    const std::string extension = lower_case_extension(file.name);
    const std::size_t first = file.bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    const bool is_object = first != std::string::npos && file.bytes[first] == '{';
    if (extension == ".geojson" || (extension != ".json" && !is_object)) {
        return false;
    }
    const auto has = [&](const char* word) { return file.bytes.find(word) != std::string::npos; };
    return has("\"shapes\"") || !has("\"type\"");  // the type of GeoJSON
}

Scene read_scene(const InputFile& file, BadEntries bad, EmptyRings empty) {
    const json document = parse_json(to_text(file.bytes, file.name), file.name);
    return SceneReader(JsonPlace(document, file.name), bad, empty).read();
}

Scene read_scene(const std::string& path, BadEntries bad, EmptyRings empty) {
    return read_scene(read_input(path), bad, empty);
}

namespace {

/// The longer side of the box of points on the outline.
double longer_side(const Outline& outline) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Vector2 low{infinite, infinite};
    Vector2 high{-infinite, -infinite};
    for (const Ring& ring : tessellate_outline(outline, largest_coordinate).rings) {
        for (const Vector2& vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
        }
    }
    return std::max(high.x - low.x, high.y - low.y);
}

class LayoutReader {
public:
    explicit LayoutReader(const LayoutRequest& request) : request_(request) {}

    Scene read(std::vector<InputFile> files) {
        for (InputFile& file : files) {
            scene_.files.push_back(file.name);
            if (format_of(file) == OutlineFormat::svg) {
                add_svg(std::move(file));
            } else {
                add_outline(std::move(file));
            }
        }
        for (const QueryRequest& query : request_.queries) {
            add_query(query);
        }
        return std::move(scene_);
    }

private:
    void add_svg(InputFile file) {
        const std::string text = to_text(std::move(file.bytes), file.name);
        Outline whole{.file = file.name};
        SvgLayout layout = parse_svg_layout(text, file.name, whole.skipped, request_.unit);
        const std::size_t first = scene_.shapes.size();
        for (std::size_t i = 0; i < layout.shapes.size(); ++i) {
            Outline outline{.file = file.name + ": " + layout.shape_names[i],
                            .path = std::move(layout.shapes[i].path),
                            .parts = std::move(layout.shapes[i].parts)};
            add_shape(layout.shape_names[i], outline);
        }
        if (!whole.skipped.empty()) {
            whole.parts.emplace_back();
            std::string& note = scene_.shapes[first].note;
            note = skipped_note(whole) + (note.empty() ? "" : "; " + note);
        }
        for (SvgItem& item : layout.items) {
            add_instance(item.name, first + item.shape, item.pose);
        }
    }

    void add_outline(InputFile file) {
        const std::string name = std::filesystem::path(file.name).stem().string();
        const Outline outline = parse_outline(std::move(file), request_.unit);
        add_shape(name, outline);
        if (!outline.skipped.empty()) {
            std::string& note = scene_.shapes.back().note;
            note = skipped_note(outline) + (note.empty() ? "" : "; " + note);
        }
        add_instance(name, scene_.shapes.size() - 1, {});
    }

    void add_shape(const std::string& name, const Outline& outline) {
        SceneShape shape{.name = name};
        try {
            ShapeRings rings = make_shape_rings(outline, deviation_of(outline), request_.treatment);
            shape.rings = std::move(rings.rings);
            shape.deviation = rings.deviation;
            shape.note = std::move(rings.note);
        } catch (const InputError& error) {
            shape.problem = error.what();
        }
        scene_.shapes.push_back(std::move(shape));
    }

    [[nodiscard]] double deviation_of(const Outline& outline) const {
        if (!needs_deviation(outline, request_.treatment)) {
            return 0.0;
        }
        if (request_.deviation) {
            return *request_.deviation;
        }
        double tolerance = 0.0;
        for (const QueryRequest& query : request_.queries) {
            tolerance = std::max(tolerance, query.tolerance);
        }
        return tolerance > 0.0 ? usual_deviation * tolerance
                               : layout_deviation * longer_side(outline);
    }

    void add_instance(const std::string& name, std::size_t shape, const Pose& pose) {
        std::string unique = name;
        for (int& count = counts_[name]; !taken_.emplace(unique, true).second;) {
            unique = name + "#" + std::to_string(++count + 1);
        }
        scene_.instances.push_back({.name = std::move(unique), .shape = shape, .pose = pose});
    }

    void add_query(const QueryRequest& request) {
        SceneQuery query{.request = request, .all_pairs = true};
        query.kind = std::string(name_of(request.type));
        query.hits_only = request_.hits_only;
        // Of the items of a layout all pairs are meant, however far apart.
        query.reach = request.type == QueryType::separation ? largest_coordinate : 0.0;
        scene_.queries.push_back(std::move(query));
    }

    const LayoutRequest& request_;
    Scene scene_;
    std::map<std::string, int> counts_;
    std::map<std::string, bool> taken_;
};

}  // namespace

Scene read_layout(std::vector<InputFile> files, const LayoutRequest& request) {
    for (const QueryRequest& query : request.queries) {
        const std::string kind(name_of(query.type));
        if (query.type == QueryType::distance_field || query.type == QueryType::time_of_impact) {
            throw InputError("--query: " + kind + " is not asked of all pairs of outlines");
        }
        if (query.tolerance == 0.0 && !is_exact(query.type)) {
            throw InputError("-d: required for " + kind);
        }
    }
    return LayoutReader(request).read(std::move(files));
}

}  // namespace nearfield::tools
