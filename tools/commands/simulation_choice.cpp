#include <tools/commands/simulation_choice.hpp>
#include <tools/input/input_error.hpp>
#include <tools/input/values.hpp>
#include <tools/scenes/scenes.hpp>

#include <cmath>

namespace nearfield::tools {

dynamics::Scene make_scene(const std::string& name, const std::optional<std::string>& tolerance,
                           std::optional<std::uint32_t> bodies) {
    std::string names;
    for (const scenes::NamedScene& scene : scenes::all_scenes()) {
        if (name == scene.name) {
            if (bodies && name != "pour") {
                throw InputError("--bodies: belongs to pour, not to " + name);
            }
            dynamics::Scene made = bodies ? scenes::pour_scene(*bodies) : scene.make();
            if (tolerance) {
                made.tolerance = parse_positive(*tolerance, "-d");
            }
            return made;
        }
        names += std::string(names.empty() ? "" : ", ") + scene.name;
    }
    throw InputError("\"" + name + "\" is none of the scenes " + names);
}

dynamics::Response parse_response(const std::string& name) {
    if (name == "penalty") {
        return dynamics::Response::penalty;
    }
    if (name == "backtracking") {
        return dynamics::Response::backtracking;
    }
    throw InputError("--response: \"" + name + "\" is none of penalty, backtracking");
}

View view_of(const dynamics::Scene& scene, double page_width) {
    const Rectangle& world = scene.view;
    // Even numbers of pixels, which video needs.
    const double height = 2.0 * std::round(0.5 * page_width * (world.max.y - world.min.y) /
                                           (world.max.x - world.min.x));
    return {world, {{0.0, 0.0}, {page_width, height}}};
}

}  // namespace nearfield::tools
