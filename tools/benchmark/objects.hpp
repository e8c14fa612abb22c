#pragma once

#include <tools/io/scene.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::benchmark {

/// The position of an object in rows of `columns`, with this spacing.
[[nodiscard]] inline Vector2 in_rows(std::size_t index, std::size_t columns, Vector2 spacing) {
    const std::size_t row = index / columns;
    return {spacing.x * static_cast<double>(index % columns), spacing.y * static_cast<double>(row)};
}

/// Adds an object with its own shape to a scene.
inline void add_object(tools::Scene& scene, std::vector<Ring> rings, const Pose& pose) {
    const std::size_t number = scene.shapes.size();
    scene.shapes.push_back({"s" + std::to_string(number), std::move(rings), 0.0});
    scene.instances.push_back({"o" + std::to_string(number), number, pose});
}

/// The number of vertices of all shapes, which equals their number of edges.
[[nodiscard]] inline std::size_t vertex_count(const tools::Scene& scene) {
    std::size_t count = 0;
    for (const tools::SceneShape& shape : scene.shapes) {
        for (const Ring& ring : shape.rings) {
            count += ring.size();
        }
    }
    return count;
}

}  // namespace nearfield::benchmark
