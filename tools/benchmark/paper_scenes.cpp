#include <tools/benchmark/objects.hpp>
#include <tools/benchmark/outlines.hpp>
#include <tools/benchmark/paper_scenes.hpp>
#include <tools/io/values.hpp>

namespace nearfield::benchmark {

tools::Scene map_scene(std::size_t scale) {
    tools::Scene scene;
    for (std::size_t index = 0; index < 6; ++index) {
        const std::size_t vertices = index == 5 ? 119 : 120;
        add_object(scene, {coast(index + 1, scale * vertices)},
                   {in_rows(index, 3, {1.95, 1.95}), 0.0});
    }
    return scene;
}

tools::Scene gears_scene(std::size_t scale) {
    tools::Scene scene;
    Random random(1);
    for (std::size_t index = 0; index < 13; ++index) {
        std::vector<Ring> rings{gear(index % 2 == 1 ? 8 : 7)};
        if (index == 0) {
            rings.push_back({{0.2, 0.0}, {-0.1, 0.15}, {-0.1, -0.15}});
        }
        for (Ring& ring : rings) {
            ring = refined(random, ring, scale);
        }
        const Vector2 place = index < 12 ? in_rows(index, 4, {1.8, 1.8}) : Vector2{7.2, 0.0};
        add_object(scene, std::move(rings),
                   tools::to_pose({place.x, place.y, 11.0 * static_cast<double>(index)}));
    }
    return scene;
}

tools::Scene links_scene(std::size_t scale) {
    constexpr double height_less_a_touch = 2.38;
    tools::Scene scene;
    for (std::size_t index = 0; index < 15; ++index) {
        const std::size_t vertices = index % 3 == 0 ? 30 : 29;
        add_object(scene, {link(scale * vertices)},
                   {in_rows(index, 5, {link_pitch, height_less_a_touch}), 0.0});
    }
    return scene;
}

tools::Scene cars_scene(std::size_t scale) {
    tools::Scene scene;
    Random random(2);
    for (std::size_t index = 0; index < 18; ++index) {
        const std::size_t vertices = index < 14 ? 15 : 14;
        const Vector2 place = in_rows(index, 6, {2.05, 1.15});
        add_object(scene, {car(scale * vertices)},
                   {{place.x + random.between(-0.1, 0.1), place.y + random.between(-0.1, 0.1)},
                    random.between(-0.1, 0.1)});
    }
    return scene;
}

tools::Scene wavy_scene(std::size_t scale) {
    constexpr double pressed_in = 0.03;
    tools::Scene scene;
    add_object(scene, {wavy_bar(scale * 100, -1.0, pressed_in / 2.0)}, {});
    add_object(scene, {wavy_bar(scale * 100, 1.0, -pressed_in / 2.0)}, {});
    return scene;
}

}  // namespace nearfield::benchmark
