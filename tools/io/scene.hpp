#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/query_request.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A shape of a scene.
struct SceneShape {
    std::string name;
    std::vector<Ring> rings;
    double deviation = 0.0;  ///< the maximum distance of the rings from its curves
};

/// A shape of a scene with a pose.
struct SceneInstance {
    std::string name;
    std::size_t shape = 0;  ///< index into Scene::shapes
    Pose pose;
    std::optional<Pose> end_pose = std::nullopt;  ///< for time of impact: the end of the motion
};

/// A query of a scene between two of its instances, or between all pairs that are near each other.
struct SceneQuery {
    QueryRequest request;
    std::size_t a = 0;  ///< index into Scene::instances
    std::size_t b = 0;  ///< index into Scene::instances
    /// Instead of a and b: all pairs whose boxes meet a condition. Ordered pairs: boxes overlap
    /// (for contacts: within the contact distance). Unordered pairs: boxes within `reach` (for
    /// separation); boxes overlap (for intersection tests and separation vectors); boxes that
    /// contain the whole motion are within the contact distance (for time of impact).
    bool all_pairs = false;
    double reach = 0.0;  ///< for separation of all pairs, world units
};

/// Shapes, poses and queries for one batch.
struct Scene {
    std::vector<SceneShape> shapes;
    std::vector<SceneInstance> instances;
    std::vector<SceneQuery> queries;
};

/// Reads a scene and the outlines it names, whose paths are relative to the scene's folder. Throws
/// InputError with the file and the place in it. Curves are tessellated with the shape's
/// `deviation`, or else with usual_deviation of the smallest tolerance among the queries that use
/// it. Unknown members of a shape, an instance or a query are rejected: a misspelt one would
/// silently change the answer.
[[nodiscard]] Scene read_scene(const std::string& path);

}  // namespace nearfield::tools
