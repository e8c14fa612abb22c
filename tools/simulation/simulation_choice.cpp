#include <tools/io/input_error.hpp>
#include <tools/io/values.hpp>
#include <tools/simulation/scenes.hpp>
#include <tools/simulation/simulation_choice.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace nearfield::tools {
namespace {

template <class Scene>
const Scene* find_by_name(std::span<const Scene> scenes, const std::string& name) {
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&name](const Scene& scene) { return name == scene.name; });
    return found == scenes.end() ? nullptr : &*found;
}

std::string scene_names() {
    std::string names;
    const auto append = [&names](const auto& scenes) {
        for (const auto& scene : scenes) {
            names += std::string(names.empty() ? "" : ", ") + scene.name;
        }
    };
    append(simulation::all_scenes());
    append(simulation::clearance_scenes());
    return names;
}

}  // namespace

simulation::Scene make_scene(const std::string& name, const std::optional<std::string>& tolerance,
                             std::optional<std::uint32_t> bodies) {
    const simulation::NamedScene* const scene = find_by_name(simulation::all_scenes(), name);
    if (scene == nullptr) {
        throw InputError("\"" + name + "\" is none of the scenes " + scene_names());
    }
    if (bodies && name != "pour") {
        throw InputError("--bodies: belongs to pour, not to " + name);
    }
    simulation::Scene made = bodies ? simulation::pour_scene(*bodies) : scene->make();
    if (tolerance) {
        made.tolerance = parse_positive(*tolerance, "-d");
    }
    return made;
}

const simulation::NamedClearanceScene* find_clearance_scene(const std::string& name) {
    return find_by_name(simulation::clearance_scenes(), name);
}

View view_of(const Rectangle& world, double page_width) {
    // An even number of pixels, as videos require.
    const double height = 2.0 * std::round(0.5 * page_width * (world.max.y - world.min.y) /
                                           (world.max.x - world.min.x));
    return {world, {{0.0, 0.0}, {page_width, height}}};
}

}  // namespace nearfield::tools
