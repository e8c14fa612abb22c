#include <tools/io/dxf.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/io/svg_values.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

bool begins_hex_wkb(std::string_view text) {
    if (is_hex_prefix(text)) {
        text.remove_prefix(2);
    }
    // A byte order, 00 or 01; no well-known text begins with a digit.
    return text.size() > 1 && text[0] == '0' && (text[1] == '0' || text[1] == '1');
}

/// A drawing begins with a group of code 0, SECTION, or a comment, 999.
bool begins_dxf(std::string_view text) {
    const std::size_t end = text.find_first_of("\r\n");
    const std::string_view code = text.substr(0, end);
    return end != std::string_view::npos && (code == "0" || code == "999");
}

/// The format of a file of another extension. Precondition: it is not empty.
OutlineFormat guess_format(std::string_view bytes, const std::string& name) {
    if (bytes.front() == '\0' || bytes.front() == '\1') {
        return OutlineFormat::binary_wkb;
    }
    const std::string_view text = bytes.substr(bytes.find_first_not_of(" \t\r\n"));
    const char first = text.front();
    if (first == '{' || first == '\x1E') {
        return OutlineFormat::geojson;
    }
    if (first == '<') {
        return OutlineFormat::svg;
    }
    if (begins_dxf(text)) {
        return OutlineFormat::dxf;
    }
    if (begins_hex_wkb(text)) {
        return OutlineFormat::hex_wkb;
    }
    // Path data begins with a move; MULTIPOLYGON does not, since a number follows a move.
    const bool word = text.size() > 1 && is_letter(text[1]);
    if ((first == 'M' || first == 'm') && !word) {
        return OutlineFormat::path;
    }
    if (is_letter(first)) {
        return OutlineFormat::wkt;
    }
    throw InputError(
        name + ":1:1: neither GeoJSON, well-known text or binary, SVG, SVG path data nor DXF");
}

/// A byte order mark says that bytes are text, and nothing else.
std::string_view without_mark(std::string_view bytes) {
    return bytes.starts_with("\xEF\xBB\xBF") ? bytes.substr(3) : bytes;
}

}  // namespace

OutlineFormat format_of(const InputFile& file) {
    const std::string_view bytes = without_mark(file.bytes);
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        throw InputError(file.name + ": is empty");
    }
    const std::string extension = lower_case_extension(file.name);
    if (extension == ".geojson" || extension == ".json" || extension == ".geojsonl" ||
        extension == ".geojsons" || extension == ".ndjson") {
        return OutlineFormat::geojson;
    }
    if (extension == ".wkt" || extension == ".wkb") {
        if (begins_hex_wkb(bytes.substr(bytes.find_first_not_of(" \t\r\n")))) {
            return OutlineFormat::hex_wkb;
        }
        return extension == ".wkt" ? OutlineFormat::wkt : OutlineFormat::binary_wkb;
    }
    if (extension == ".svg") {
        return OutlineFormat::svg;
    }
    if (extension == ".path") {
        return OutlineFormat::path;
    }
    if (extension == ".dxf") {
        return OutlineFormat::dxf;
    }
    return guess_format(bytes, file.name);
}

Outline parse_outline(InputFile file, LengthUnit unit) {
    const OutlineFormat format = format_of(file);
    Outline outline;
    outline.file = file.name;
    const std::string& name = outline.file;
    if (format == OutlineFormat::binary_wkb) {
        outline.rings = parse_wkb(file.bytes, name, outline.skipped, &outline.part_sizes);
        return outline;
    }
    const std::string text = to_text(std::move(file.bytes), name);
    if (format == OutlineFormat::geojson) {
        outline.rings = parse_geojson(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == OutlineFormat::wkt) {
        outline.rings = parse_wkt(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == OutlineFormat::hex_wkb) {
        outline.rings = parse_hex_wkb(text, name, outline.skipped, &outline.part_sizes);
    } else if (format == OutlineFormat::svg) {
        SvgDrawing drawing = parse_svg(text, name, outline.skipped, unit);
        outline.path = std::move(drawing.path);
        outline.parts = std::move(drawing.parts);
    } else if (format == OutlineFormat::dxf) {
        outline.path = parse_dxf(text, name, outline.skipped, unit);
    } else {
        outline.path = parse_path_file(text, name);
    }
    return outline;
}

bool Outline::curved() const {
    return std::any_of(path.contours().begin(), path.contours().end(), [](const auto& contour) {
        return std::any_of(
            contour.segments.begin(), contour.segments.end(),
            [](const auto& segment) { return segment.kind != CurveSegment::Kind::line; });
    });
}

Outline read_outline(const std::string& path, LengthUnit unit) {
    return parse_outline(read_input(path), unit);
}

std::string skipped_note(const Outline& outline) {
    return outline.file +
           (outline.parts.empty() ? ": skipped what holds no area: "
                                  : ": skipped what has no outline: ") +
           outline.skipped.text();
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
