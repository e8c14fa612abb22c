#include <tools/io/geojson.hpp>
#include <tools/io/input_error.hpp>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>

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

/// The geometries of a document, one after the other.
class GeojsonReader {
public:
    explicit GeojsonReader(SkippedParts& skipped) : skipped_(skipped) {}

    void read(const JsonPlace& root) {
        const std::string& type = root.member("type").string();
        if (type == "Feature") {
            read_feature(root);
        } else if (type == "FeatureCollection") {
            read_features(root.member("features"));
        } else {
            read_geometry(root, 0);
        }
    }

    /// The rings of all that was read. `file`: for the message if there are none.
    std::vector<Ring> take_rings(const std::string& file) {
        if (rings_.empty()) {
            throw InputError(file + ": " + skipped_.no_polygon_text());
        }
        return std::move(rings_);
    }

    /// The number of rings of each polygon.
    [[nodiscard]] const std::vector<std::uint32_t>& part_sizes() const { return part_sizes_; }

private:
    void read_geometry(const JsonPlace& geometry, int depth) {
        const JsonPlace type = geometry.member("type");
        const std::string& name = type.string();
        if (name == "Polygon") {
            read_polygon(geometry.member("coordinates"));
        } else if (name == "MultiPolygon") {
            const JsonPlace coordinates = geometry.member("coordinates");
            for (std::size_t index = 0, count = count_of(coordinates); index < count; ++index) {
                read_polygon(coordinates.element(index));
            }
        } else if (name == "GeometryCollection") {
            if (depth == deepest_collection) {
                type.fail("collections nested too deep");
            }
            const JsonPlace geometries = geometry.member("geometries");
            for (std::size_t index = 0, count = count_of(geometries); index < count; ++index) {
                read_geometry(geometries.element(index), depth + 1);
            }
        } else if (name == "Point" || name == "MultiPoint" || name == "LineString" ||
                   name == "MultiLineString") {
            skipped_.add(name);
        } else {
            type.fail("\"" + name + "\" is none of Polygon, MultiPolygon, GeometryCollection");
        }
    }

    void read_polygon(const JsonPlace& coordinates) {
        const std::size_t first = rings_.size();
        bool has_outer_ring = true;
        for (std::size_t index = 0, count = count_of(coordinates); index < count; ++index) {
            const JsonPlace ring = coordinates.element(index);
            const bool any = count_of(ring) > 0;
            if (any && !has_outer_ring) {
                ring.fail("an inner ring whose outer ring is empty");
            }
            if (any) {
                rings_.push_back(parse_ring(ring));
            }
            has_outer_ring = has_outer_ring && (any || index > 0);
        }
        if (rings_.size() > first) {
            part_sizes_.push_back(static_cast<std::uint32_t>(rings_.size() - first));
        }
    }

    /// The size of an array, which is counted where it is empty.
    std::size_t count_of(const JsonPlace& array) {
        const std::size_t count = array.require_array().value().size();
        if (count == 0) {
            skipped_.add(empty_part);
        }
        return count;
    }

    void read_feature(const JsonPlace& feature) {
        if (!feature.has("geometry") || feature.member("geometry").value().is_null()) {
            skipped_.add("feature without geometry");
        } else {
            read_geometry(feature.member("geometry"), 0);
        }
    }

    void read_features(const JsonPlace& features) {
        const std::size_t count = features.require_array().value().size();
        for (std::size_t index = 0; index < count; ++index) {
            const JsonPlace feature = features.element(index);
            const JsonPlace type = feature.member("type");
            if (type.string() != "Feature") {
                type.fail("\"" + type.string() + "\" is not Feature");
            }
            read_feature(feature);
        }
    }

    SkippedParts& skipped_;
    std::vector<Ring> rings_;
    std::vector<std::uint32_t> part_sizes_;
};

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

namespace {

/// Separates the texts of a sequence, before each of them (RFC 8142).
constexpr char record_separator = '\x1E';

/// Whether the text is a sequence of JSON texts, one a line: what begins with a record separator,
/// or whose first line is complete and not the last.
bool is_sequence(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] == record_separator) {
        return first != std::string::npos;
    }
    const std::size_t end = text.find('\n', first);
    return end != std::string::npos &&
           text.find_first_not_of(" \t\r\n", end) != std::string::npos &&
           json::accept(text.substr(first, end - first));
}

/// Reads a line of a sequence, unless it is blank.
void read_line(const std::string& line, std::size_t number, const std::string& file,
               GeojsonReader& reader) {
    const std::size_t first = line.find_first_not_of(" \t\r\x1E");
    if (first == std::string::npos) {
        return;
    }
    const std::string text = std::string(first, ' ') + line.substr(first);
    if (!json::accept(text)) {
        // Line breaks are nothing to JSON; with them, the message names the line of the file.
        static_cast<void>(parse_json(std::string(number - 1, '\n') + text, file));
    }
    const std::string place = file + ":" + std::to_string(number);
    const json document = parse_json(text, place);
    reader.read(JsonPlace(document, place));
}

void read_sequence(const std::string& text, const std::string& file, GeojsonReader& reader) {
    std::istringstream stream(text);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        read_line(line, ++number, file, reader);
    }
}

}  // namespace

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file,
                                SkippedParts& skipped, std::vector<std::uint32_t>* part_sizes) {
    GeojsonReader reader(skipped);
    if (is_sequence(text)) {
        read_sequence(text, file, reader);
    } else {
        const json document = parse_json(text, file);
        reader.read(JsonPlace(document, file));
    }
    std::vector<Ring> rings = reader.take_rings(file);
    if (part_sizes != nullptr) {
        *part_sizes = reader.part_sizes();
    }
    return rings;
}

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file) {
    SkippedParts skipped;
    return parse_geojson(text, file, skipped);
}

}  // namespace nearfield::tools
