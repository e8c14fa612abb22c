#pragma once

#include <tools/input/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::peers {

/// What is asked of nearfield and its peers.
enum class Task {
    vertex_penetration,    ///< which vertices of A lie in B, how deep the deepest
    boundary_penetration,  ///< the same of samples along A's boundary, at most a cell apart
    separation,            ///< the least distance of two shapes
    intersection_test,     ///< whether two shapes have a point in common
    common_area,           ///< the area of what two shapes have in common
    field,                 ///< signed distances at the centres of a grid
};

/// A row: a task asked of pairs (of a field: single shapes), the queries of the scene, none of
/// which is about all pairs. The first ring of a shape is its outer boundary, the others are holes.
struct Problem {
    std::string name;
    Task task{};
    tools::Scene scene;
};

/// Where a field is sampled.
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

/// The grid of a query for a field over a square.
[[nodiscard]] Grid grid_of(const tools::QueryRequest& request);

/// A shape where it stands in the world, and its bounding box.
struct PlacedShape {
    std::vector<Ring> rings;
    Rectangle box;
};

/// Places all instances, as a program has to before it hands them to a library without poses.
/// Keeps the memory of what was there.
void place(const tools::Scene& scene, std::vector<PlacedShape>& placed);

/// The points of `a` that a penetration query with this spacing looks at and that lie in `box`:
/// vertices where it is 0, else samples along the edges from each vertex on, no farther apart.
void points_in(const PlacedShape& a, double spacing, const Rectangle& box,
               std::vector<Vector2>& points);

/// What was found about one query; what a task does not ask for stays as it is here.
struct Answer {
    std::uint64_t count = 0;
    double number = 0.0;        ///< greatest depth, separation, area; 1 where shapes intersect
    std::vector<float> values;  ///< row by row from the lowest
};

/// All rows.
[[nodiscard]] std::vector<Problem> all_problems();

}  // namespace nearfield::peers
