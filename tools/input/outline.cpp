#include <tools/input/geojson.hpp>
#include <tools/input/input_error.hpp>
#include <tools/input/outline.hpp>
#include <tools/input/text_file.hpp>
#include <tools/input/wkt.hpp>

#include <algorithm>
#include <filesystem>

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

std::vector<Ring> read_outline(const std::string& path) {
    const std::string text = read_text(path);
    const std::string extension = lower_case_extension(path);
    if (extension == ".geojson" || extension == ".json") {
        return parse_geojson(text, path);
    }
    if (extension == ".wkt") {
        return parse_wkt(text, path);
    }
    const char first = text[text.find_first_not_of(" \t\r\n")];
    if (first == '{') {
        return parse_geojson(text, path);
    }
    if ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z')) {
        return parse_wkt(text, path);
    }
    throw InputError(path + ":1:1: neither GeoJSON nor well-known text");
}

}  // namespace nearfield::tools
