#include <tools/io/characters.hpp>
#include <tools/io/geojson.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/svg_path.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/wkb.hpp>
#include <tools/io/wkt.hpp>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

std::string lower_case_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

enum class Format { geojson, wkt, hex_wkb, binary_wkb, svg, path };

bool begins_hex_wkb(std::string_view text) {
    // A byte order, 00 or 01; no well-known text begins with a digit.
    return text.size() > 1 && text[0] == '0' && (text[1] == '0' || text[1] == '1');
}

/// The format of a file of another extension. Precondition: it is not empty.
Format guess_format(std::string_view bytes, const std::string& name) {
    if (bytes.front() == '\0' || bytes.front() == '\1') {
        return Format::binary_wkb;
    }
    const std::string_view text = bytes.substr(bytes.find_first_not_of(" \t\r\n"));
    const char first = text.front();
    if (first == '{') {
        return Format::geojson;
    }
    if (first == '<') {
        return Format::svg;
    }
    if (begins_hex_wkb(text)) {
        return Format::hex_wkb;
    }
    // Path data begins with a move; MULTIPOLYGON does not, since a number follows a move.
    const bool word = text.size() > 1 && is_letter(text[1]);
    if ((first == 'M' || first == 'm') && !word) {
        return Format::path;
    }
    if (is_letter(first)) {
        return Format::wkt;
    }
    throw InputError(name +
                     ":1:1: neither GeoJSON, well-known text or binary, SVG nor SVG path data");
}

/// The format of a file by its extension, or else by what it holds.
Format find_format(const std::string& extension, std::string_view bytes, const std::string& name) {
    if (extension == ".geojson" || extension == ".json") {
        return Format::geojson;
    }
    if (extension == ".wkt" || extension == ".wkb") {
        if (begins_hex_wkb(bytes.substr(bytes.find_first_not_of(" \t\r\n")))) {
            return Format::hex_wkb;
        }
        return extension == ".wkt" ? Format::wkt : Format::binary_wkb;
    }
    if (extension == ".svg") {
        return Format::svg;
    }
    if (extension == ".path") {
        return Format::path;
    }
    return guess_format(bytes, name);
}

/// A byte order mark says that bytes are text, and nothing else.
std::string_view without_mark(std::string_view bytes) {
    return bytes.starts_with("\xEF\xBB\xBF") ? bytes.substr(3) : bytes;
}

Outline parse_outline(std::string bytes, const std::string& name, const std::string& extension) {
    Outline outline;
    outline.file = name;
    const std::string_view content = without_mark(bytes);
    if (content.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        throw InputError(name + ": is empty");
    }
    const Format format = find_format(extension, content, name);
    if (format == Format::binary_wkb) {
        outline.rings = parse_wkb(bytes, name, outline.skipped, &outline.part_sizes);
        return outline;
    }
    const std::string text = to_text(std::move(bytes), name);
    if (format == Format::geojson) {
        outline.rings = parse_geojson(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == Format::wkt) {
        outline.rings = parse_wkt(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == Format::hex_wkb) {
        outline.rings = parse_hex_wkb(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == Format::svg) {
        outline.path = parse_svg(text, name);
    } else {
        outline.path = parse_path_file(text, name);
    }
    return outline;
}

}  // namespace

bool Outline::curved() const {
    return std::any_of(path.contours().begin(), path.contours().end(), [](const auto& contour) {
        return std::any_of(
            contour.segments.begin(), contour.segments.end(),
            [](const auto& segment) { return segment.kind != CurveSegment::Kind::line; });
    });
}

Outline read_outline(const std::string& path) {
    return parse_outline(read_bytes(path), path, lower_case_extension(path));
}

Outline read_outline(std::istream& stream, const std::string& name) {
    return parse_outline(read_bytes(stream, name), name, "");
}

std::string skipped_note(const Outline& outline) {
    return outline.file + ": skipped what holds no area: " + outline.skipped.text();
}

OutlineRings tessellate_outline(const Outline& outline, double deviation) {
    if (!outline.rings.empty()) {
        return {outline.rings, 0.0};
    }
    const bool curved = outline.curved();
    Expected<std::vector<Ring>> rings =
        tessellate(outline.path, curved ? deviation : largest_coordinate);
    if (!rings) {
        throw InputError(outline.file + ": " + rings.error().message());
    }
    return {std::move(*rings), curved ? deviation : 0.0};
}

}  // namespace nearfield::tools
