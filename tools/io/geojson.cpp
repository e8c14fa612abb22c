#include <tools/io/geojson.hpp>
#include <tools/io/input_error.hpp>

#include <algorithm>
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

/// Stands before each text of a sequence (RFC 8142), which may be longer than a line.
constexpr char record_separator = '\x1E';

/// What separates the JSON texts of a sequence: a record separator, if it begins with one, or line
/// breaks, if its first line is complete and not the last. Zero for a single text.
char separator_of(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) {
        return '\0';
    }
    if (text[first] == record_separator) {
        return record_separator;
    }
    const std::size_t end = text.find('\n', first);
    const bool has_lines =
        end != std::string::npos && text.find_first_not_of(" \t\r\n", end) != std::string::npos;
    return has_lines && json::accept(text.substr(first, end - first)) ? '\n' : '\0';
}

/// A text that begins on this line of the file.
json parse_part(const std::string& part, std::size_t line, const std::string& file) {
    try {
        return parse_json(part, file);
    } catch (const InputError&) {
        // Line breaks are nothing to JSON; with them, the message names the place in the file.
        return parse_json(std::string(line - 1, '\n') + part, file);
    }
}

std::size_t lines_in(const std::string& text, std::size_t end) {
    const auto begin = text.begin();
    return static_cast<std::size_t>(
        std::count(begin, begin + static_cast<std::ptrdiff_t>(end), '\n'));
}

void read_sequence(const std::string& text, char separator, const std::string& file,
                   GeojsonReader& reader) {
    std::istringstream stream(text);
    std::size_t line = 1;
    for (std::string part; std::getline(stream, part, separator);) {
        const std::size_t first = part.find_first_not_of(" \t\r\n");
        if (first != std::string::npos) {
            const json document = parse_part(part, line, file);
            const std::size_t its_line = line + lines_in(part, first);
            reader.read(JsonPlace(document, file + ":" + std::to_string(its_line)));
        }
        line += lines_in(part, part.size()) + (separator == '\n' ? 1 : 0);
    }
}

}  // namespace

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file,
                                SkippedParts& skipped, std::vector<std::uint32_t>* part_sizes) {
    GeojsonReader reader(skipped);
    if (const char separator = separator_of(text); separator != '\0') {
        read_sequence(text, separator, file, reader);
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
