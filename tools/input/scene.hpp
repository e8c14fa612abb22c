#pragma once

#include <nearfield/shape.hpp>

#include <tools/input/query_request.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A shape of a scene.
struct SceneShape {
    std::string name;
    std::vector<Ring> rings;
    double deviation = 0.0;  ///< how far the rings may be from its curves
};

/// A shape of a scene at a place.
struct SceneInstance {
    std::string name;
    std::size_t shape = 0;  ///< index into Scene::shapes
    Pose pose;
    std::optional<Pose> end_pose = std::nullopt;  ///< of times of impact: where it moves to
};

/// A query of a scene between two of its instances, or between all that are near each other.
struct SceneQuery {
    QueryRequest request;
    std::size_t a = 0;  ///< index into Scene::instances
    std::size_t b = 0;  ///< index into Scene::instances
    /// In place of a and b: every ordered pair whose boxes meet (for contacts: come within the
    /// contact distance; for separation: every unordered pair within `reach`; for intersection
    /// tests and separation vectors: every unordered pair whose boxes meet; for times of impact:
    /// every unordered pair of which boxes that hold all of the motion come within the contact
    /// distance).
    bool all_pairs = false;
    double reach = 0.0;  ///< of separation of all pairs, world units
};

/// Many shapes, poses and queries: what one batch is made of.
struct Scene {
    std::vector<SceneShape> shapes;
    std::vector<SceneInstance> instances;
    std::vector<SceneQuery> queries;
};

/// Reads a scene and the outlines it names, whose paths are relative to the scene's folder. Throws
/// InputError with the file and the place in it. Curves are tessellated with the `deviation` a
/// shape states, else with usual_deviation of the smallest tolerance among the queries that use it.
/// A shape, an instance or a query with a member that is not known is refused: a misspelt one would
/// change the answer silently.
[[nodiscard]] Scene read_scene(const std::string& path);

}  // namespace nearfield::tools
