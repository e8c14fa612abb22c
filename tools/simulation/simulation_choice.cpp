#include <tools/io/input_error.hpp>
#include <tools/io/values.hpp>
#include <tools/simulation/scenes.hpp>
#include <tools/simulation/simulation_choice.hpp>

#include <cmath>

namespace nearfield::tools {

simulation::Scene make_scene(const std::string& name, const std::optional<std::string>& tolerance,
                             std::optional<std::uint32_t> bodies) {
    std::string names;
    for (const simulation::NamedScene& scene : simulation::all_scenes()) {
        if (name == scene.name) {
            if (bodies && name != "pour") {
                throw InputError("--bodies: belongs to pour, not to " + name);
            }
            simulation::Scene made = bodies ? simulation::pour_scene(*bodies) : scene.make();
            if (tolerance) {
                made.tolerance = parse_positive(*tolerance, "-d");
            }
            return made;
        }
        names += std::string(names.empty() ? "" : ", ") + scene.name;
    }
    throw InputError("\"" + name + "\" is none of the scenes " + names);
}

simulation::Response parse_response(const std::string& name) {
    if (name == "penalty") {
        return simulation::Response::penalty;
    }
    if (name == "backtracking") {
        return simulation::Response::backtracking;
    }
    throw InputError("--response: \"" + name + "\" is none of penalty, backtracking");
}

View view_of(const simulation::Scene& scene, double page_width) {
    const Rectangle& world = scene.view;
    // An even number of pixels, as videos require.
    const double height = 2.0 * std::round(0.5 * page_width * (world.max.y - world.min.y) /
                                           (world.max.x - world.min.x));
    return {world, {{0.0, 0.0}, {page_width, height}}};
}

}  // namespace nearfield::tools
