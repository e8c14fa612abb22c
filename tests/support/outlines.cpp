#include "outlines.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace nearfield::test {
namespace {

void append_polygon(const nlohmann::json& polygon, Rings& rings) {
    for (const auto& line : polygon) {
        Ring ring;
        for (const auto& position : line) {
            ring.push_back({position.at(0).get<double>(), position.at(1).get<double>()});
        }
        rings.push_back(std::move(ring));
    }
}

}  // namespace

NamedRings read_outline(const std::filesystem::path& file) {
    std::ifstream stream(file);
    NamedRings outline{file.stem().string(), {}};
    try {
        const nlohmann::json geometry = nlohmann::json::parse(stream).at("geometry");
        const auto& coordinates = geometry.at("coordinates");
        if (geometry.at("type") == "Polygon") {
            append_polygon(coordinates, outline.rings);
        } else if (geometry.at("type") == "MultiPolygon") {
            for (const auto& polygon : coordinates) {
                append_polygon(polygon, outline.rings);
            }
        }
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(file.string() + ": " + error.what());
    }
    if (outline.rings.empty()) {
        throw std::runtime_error(file.string() + ": no Polygon or MultiPolygon in it");
    }
    return outline;
}

std::vector<NamedRings> read_outlines(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".geojson") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    std::vector<NamedRings> outlines;
    for (const auto& file : files) {
        outlines.push_back(read_outline(file));
    }
    return outlines;
}

}  // namespace nearfield::test
