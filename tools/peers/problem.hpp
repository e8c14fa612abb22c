#pragma once

#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::peers {

/// The tasks that nearfield and its peers perform.
enum class Task {
    vertex_penetration,    ///< which vertices of A are inside B, and the greatest depth
    boundary_penetration,  ///< the same for samples along A's boundary, at most a cell apart
    separation,            ///< the distance between two shapes
    intersection_test,     ///< whether two shapes share a point
    common_area,           ///< the area of the intersection of two shapes
    field,                 ///< signed distances at the centres of a grid
};

/// A row: a task for pairs of shapes (for a field: single shapes), given by the scene's queries,
/// none of which is for all pairs. The first ring of a shape is its outer boundary, the others are
/// holes.
struct Problem {
    std::string name;
    Task task{};
    tools::Scene scene;
};

/// The sample positions of a field.
struct Grid {
    Vector2 origin;
    double cell = 0.0;
    std::size_t width = 0;
    std::size_t height = 0;

    [[nodiscard]] Vector2 center(std::size_t column, std::size_t row) const {
        return {origin.x + cell * (static_cast<double>(column) + 0.5),
                origin.y + cell * (static_cast<double>(row) + 0.5)};
    }
};

/// The grid of a query for a square field.
[[nodiscard]] Grid grid_of(const tools::QueryRequest& request);

/// A shape in world coordinates and its bounding box.
struct PlacedShape {
    std::vector<Ring> rings;
    Rectangle box;
};

/// Transforms all instances to world coordinates, as a program must for a library without poses.
/// Reuses the memory of `placed`.
void place(const tools::Scene& scene, std::vector<PlacedShape>& placed);

/// The points of `a` in `box` that a penetration query with this spacing tests: vertices if it is
/// 0, else samples along the edges from each vertex on, no farther apart.
void points_in(const PlacedShape& a, double spacing, const Rectangle& box,
               std::vector<Vector2>& points);

/// The answer to one query; members that a task does not need keep their defaults.
struct Answer {
    std::uint64_t count = 0;
    double number = 0.0;        ///< greatest depth, separation, area; or 1 if the shapes intersect
    std::vector<float> values;  ///< row by row from the lowest
};

/// All rows.
[[nodiscard]] std::vector<Problem> all_problems();

}  // namespace nearfield::peers
