#include <tools/io/geojson.hpp>

#include <cmath>
#include <cstddef>

namespace nearfield::tools {
namespace {

using nlohmann::json;

/// One ordinate. The place of a vertex is formatted only for an error, because outlines are long.
double ordinate(const JsonPlace& ring, std::size_t vertex, std::size_t axis) {
    const json& value = ring.value()[vertex][axis];
    if (value.is_number()) {
        return value.get<double>();
    }
    return ring.element(vertex).element(axis).number();
}

Ring parse_ring(const JsonPlace& place) {
    const json& positions = place.require_array().value();
    if (positions.empty()) {
        place.fail("an empty ring");
    }
    Ring ring;
    ring.reserve(positions.size());
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
        const json& position = positions[vertex];
        if (!position.is_array()) {
            place.element(vertex).require_array();
        }
        if (position.size() < 2) {
            place.element(vertex).fail("a position needs two numbers, not " +
                                       std::to_string(position.size()));
        }
        ring.push_back({ordinate(place, vertex, 0), ordinate(place, vertex, 1)});
    }
    return ring;
}

void append_multi_polygon(const JsonPlace& coordinates, std::vector<Ring>& rings) {
    const std::size_t count = coordinates.require_array().value().size();
    if (count == 0) {
        coordinates.fail("a MultiPolygon without polygons");
    }
    for (std::size_t polygon = 0; polygon < count; ++polygon) {
        append_rings(coordinates.element(polygon), rings);
    }
}

/// The maximum nesting of collections: untrusted input must not exhaust the stack.
constexpr int deepest_collection = 64;

void append_geometry(const JsonPlace& geometry, std::vector<Ring>& rings, int depth = 0) {
    const JsonPlace type = geometry.member("type");
    if (type.string() == "Polygon") {
        append_rings(geometry.member("coordinates"), rings);
    } else if (type.string() == "MultiPolygon") {
        append_multi_polygon(geometry.member("coordinates"), rings);
    } else if (type.string() == "GeometryCollection") {
        const JsonPlace geometries = geometry.member("geometries");
        const std::size_t count = geometries.require_array().value().size();
        if (count == 0) {
            geometries.fail("a GeometryCollection without geometries");
        }
        if (depth == deepest_collection) {
            type.fail("collections nested too deep");
        }
        for (std::size_t index = 0; index < count; ++index) {
            append_geometry(geometries.element(index), rings, depth + 1);
        }
    } else {
        type.fail("\"" + type.string() + "\" is none of Polygon, MultiPolygon, GeometryCollection");
    }
}

void append_feature(const JsonPlace& feature, std::vector<Ring>& rings) {
    append_geometry(feature.member("geometry"), rings);
}

void append_collection(const JsonPlace& features, std::vector<Ring>& rings) {
    const std::size_t count = features.require_array().value().size();
    if (count == 0) {
        features.fail("a FeatureCollection without features");
    }
    for (std::size_t index = 0; index < count; ++index) {
        const JsonPlace feature = features.element(index);
        const JsonPlace type = feature.member("type");
        if (type.string() != "Feature") {
            type.fail("\"" + type.string() + "\" is not Feature");
        }
        append_feature(feature, rings);
    }
}

}  // namespace

void append_rings(const JsonPlace& coordinates, std::vector<Ring>& rings) {
    const std::size_t count = coordinates.require_array().value().size();
    if (count == 0) {
        coordinates.fail("a polygon without rings");
    }
    for (std::size_t ring = 0; ring < count; ++ring) {
        rings.push_back(parse_ring(coordinates.element(ring)));
    }
}

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file) {
    const json document = parse_json(text, file);
    const JsonPlace root(document, file);
    const std::string& type = root.member("type").string();
    std::vector<Ring> rings;
    if (type == "Feature") {
        append_feature(root, rings);
    } else if (type == "FeatureCollection") {
        append_collection(root.member("features"), rings);
    } else {
        append_geometry(root, rings);
    }
    return rings;
}

}  // namespace nearfield::tools
