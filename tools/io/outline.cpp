#include <tools/io/characters.hpp>
#include <tools/io/geojson.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/svg_path.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/wkt.hpp>

#include <algorithm>
#include <filesystem>
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

}  // namespace

bool Outline::curved() const {
    return std::any_of(path.contours().begin(), path.contours().end(), [](const auto& contour) {
        return std::any_of(
            contour.segments.begin(), contour.segments.end(),
            [](const auto& segment) { return segment.kind != CurveSegment::Kind::line; });
    });
}

Outline read_outline(const std::string& path) {
    const std::string text = read_text(path);
    const std::string extension = lower_case_extension(path);
    if (extension == ".geojson" || extension == ".json") {
        return {path, parse_geojson(text, path), {}};
    }
    if (extension == ".wkt") {
        return {path, parse_wkt(text, path), {}};
    }
    if (extension == ".svg") {
        return {path, {}, parse_svg(text, path)};
    }
    if (extension == ".path") {
        return {path, {}, parse_path_file(text, path)};
    }
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    const char first = text[start];
    if (first == '{') {
        return {path, parse_geojson(text, path), {}};
    }
    if (first == '<') {
        return {path, {}, parse_svg(text, path)};
    }
    // A word such as MULTIPOLYGON continues with a letter; the M of path data does not.
    const bool word = start + 1 < text.size() && is_letter(text[start + 1]);
    if ((first == 'M' || first == 'm') && !word) {
        return {path, {}, parse_path_file(text, path)};
    }
    if (is_letter(first)) {
        return {path, parse_wkt(text, path), {}};
    }
    throw InputError(path + ":1:1: neither GeoJSON, well-known text, SVG nor SVG path data");
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
