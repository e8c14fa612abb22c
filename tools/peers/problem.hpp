#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/scene.hpp>

#include <cmath>
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
    // These are asked of all shapes together.
    pose_hits,       ///< at which poses an item shares a point with a shape
    pose_distances,  ///< the least distance of an item from a shape, at each pose
    nearest,         ///< the distance of each point from the nearest shape
    first_hits,  ///< the parameter at which each segment first meets a shape; 2 where it does not
};

}  // namespace nearfield::peers

namespace nearfield::tools {

template <>
inline constexpr auto names<peers::Task> = std::to_array<NamedValue<peers::Task>>({
    {"vertices", peers::Task::vertex_penetration},
    {"boundary", peers::Task::boundary_penetration},
    {"separation", peers::Task::separation},
    {"intersection test", peers::Task::intersection_test},
    {"area", peers::Task::common_area},
    {"field", peers::Task::field},
    {"poses, hit or not", peers::Task::pose_hits},
    {"poses, least distances", peers::Task::pose_distances},
    {"nearest", peers::Task::nearest},
    {"rays", peers::Task::first_hits},
});

}  // namespace nearfield::tools

namespace nearfield::peers {

/// A row: a task for pairs of shapes (for a field: single shapes), given by the scene's queries,
/// none of which is for all pairs; or for a world, given by one query of all instances. The first
/// ring of a shape is its outer boundary, the others are holes.
struct Problem {
    std::string name;
    Task task{};
    tools::Scene scene;

    [[nodiscard]] bool is_of_world() const noexcept { return task >= Task::pose_hits; }
    /// What a world is asked.
    [[nodiscard]] const tools::WorldRequest& request() const { return *scene.queries[0].world; }
    /// The shape at the poses; none where there are no poses.
    [[nodiscard]] std::vector<Ring> item() const {
        return request().shape ? scene.shapes[*request().shape].rings : std::vector<Ring>();
    }
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

/// Transforms points of a shape at a pose to world coordinates.
class Placement {
public:
    explicit Placement(const Pose& pose)
        : cosine_(std::cos(pose.angle)), sine_(std::sin(pose.angle)), by_(pose.translation) {}
    [[nodiscard]] Vector2 operator()(const Vector2& point) const {
        return {cosine_ * point.x - sine_ * point.y + by_.x,
                sine_ * point.x + cosine_ * point.y + by_.y};
    }

private:
    double cosine_;
    double sine_;
    Vector2 by_;
};

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
    double number = 0.0;         ///< greatest depth, separation, area; or 1 if the shapes intersect
    std::vector<double> values;  ///< of a field, row by row from the lowest; of a world, in order
};

/// All rows, those of worlds last.
[[nodiscard]] std::vector<Problem> all_problems();

}  // namespace nearfield::peers
