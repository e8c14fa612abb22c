#include <tools/simulation/scenes.hpp>

namespace nearfield::simulation {
namespace {

constexpr NamedScene scenes[] = {
    {"map", map_scene},
    {"gears", gears_scene},
    {"links", links_scene},
    {"cars", cars_scene},
    {"wavy", wavy_scene},
    {"overlap", overlap_scene},
    {"pour", [] { return pour_scene(); }},
};

}  // namespace

std::span<const NamedScene> all_scenes() {
    return scenes;
}

std::span<const NamedScene> paper_scenes() {
    return std::span(scenes).first(5);
}

}  // namespace nearfield::simulation
