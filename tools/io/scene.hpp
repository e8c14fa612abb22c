#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>
#include <tools/io/world_request.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A shape of a scene.
struct SceneShape {
    std::string name;
    std::vector<Ring> rings = {};
    double deviation = 0.0;    ///< how far the rings may be from its curves
    std::string problem = {};  ///< why it cannot be used; empty where it can
    std::string note = {};     ///< what was skipped or dropped of it; empty where nothing was
};

/// A shape of a scene with a pose.
struct SceneInstance {
    std::string name;
    std::size_t shape = 0;  ///< index into Scene::shapes
    Pose pose = {};
    std::optional<Pose> end_pose = std::nullopt;  ///< of times of impact: where it moves to
    std::string problem = {};                     ///< why it cannot be used; empty where it can
};

/// Instances of a scene that queries name together.
struct SceneGroup {
    std::string name;
    std::vector<std::size_t> instances = {};  ///< indices into Scene::instances, ascending
    std::string problem = {};                 ///< why it cannot be used; empty where it can
};

/// The groups between which pairs are formed.
struct GroupPair {
    InstanceGroup first;
    InstanceGroup second;
};

/// A query of a scene between two of its instances, between all pairs that are near each other, or
/// of all its instances.
struct SceneQuery {
    QueryRequest request;
    std::size_t a = 0;  ///< index into Scene::instances
    std::size_t b = 0;  ///< index into Scene::instances
    /// Instead of a and b: all pairs whose boxes meet a condition. Ordered pairs: boxes overlap
    /// (for contacts: within the contact distance). Unordered pairs: boxes within `reach` (for
    /// separation); boxes overlap (for intersection tests and separation vectors); boxes that
    /// contain the whole motion are within the contact distance (for time of impact).
    bool all_pairs = false;
    double reach = 0.0;  ///< of separation of all pairs, world units
    /// "query", "a" and "b" as the file has them; empty where they are not there.
    std::string kind = {};
    std::string name_a = {};
    std::string name_b = {};
    std::string problem = {};  ///< why it cannot be asked; empty where it can
    /// Of all pairs: only those with an instance of one group and one of the other.
    std::optional<GroupPair> between = std::nullopt;
    bool hits_only = false;  ///< of all pairs: only results for which is_hit() holds
    /// Instead of pairs: a query of all instances. Nothing else but `problem` counts then.
    std::optional<WorldRequest> world = std::nullopt;
};

/// Shapes, poses and queries for one batch.
struct Scene {
    std::vector<SceneShape> shapes;
    std::vector<SceneInstance> instances;
    std::vector<SceneQuery> queries;
    std::vector<SceneGroup> groups = {};
    std::vector<std::string> files = {};  ///< what was read: the scene, outlines, tables
};

/// What becomes of a shape, an instance or a query that is wrong in itself.
enum class BadEntries {
    refused,   ///< InputError: the scene is refused
    recorded,  ///< its `problem` says why it cannot be used; the others can be
};

/// What becomes of rings that enclose nothing.
enum class EmptyRings {
    dropped,  ///< with a note
    kept,     ///< the library refuses them
};

/// True of a file that is read as a scene in JSON, and not as an outline.
[[nodiscard]] bool holds_scene(const InputFile& file);

/// Reads a scene and the outlines it names, whose paths are relative to the scene's folder. Throws
/// InputError with the file and the place in it. Curves are tessellated with the `deviation` a
/// shape states, else with usual_deviation of the smallest tolerance among the queries that use it.
///
/// The scene as a whole is refused where it is not JSON, where `shapes`, `instances` or `queries`
/// is not there, and where a shape, an instance or a query has a member that is not known: a
/// misspelt one would change the answer silently.
[[nodiscard]] Scene read_scene(const InputFile& file, BadEntries bad = BadEntries::refused,
                               EmptyRings empty = EmptyRings::dropped);
/// Likewise; "-" reads the standard input, and paths are relative to the current folder.
[[nodiscard]] Scene read_scene(const std::string& path, BadEntries bad = BadEntries::refused,
                               EmptyRings empty = EmptyRings::dropped);

/// What is asked of a layout.
struct LayoutRequest {
    std::vector<QueryRequest> queries = {};  ///< each of all pairs
    bool hits_only = false;                  ///< only results for which is_hit() holds
    OutlineTreatment treatment = {};
    LengthUnit unit = LengthUnit::user;
    /// How far edges may be off curves, those of an offset too. None: usual_deviation of the
    /// tolerances, without one layout_deviation of the longer side of a shape.
    std::optional<double> deviation = {};
};

/// The deviation of curves and offsets in a layout without a tolerance, in longer sides of a shape.
inline constexpr double layout_deviation = 1e-5;

/// A scene of the items in outline files: of SVG those of parse_svg_layout(), of any other file
/// one, at the pose 0. Items of the same name get numbers: "disc", "disc#2". What is wrong with the
/// rings of a shape becomes its problem. Throws InputError for a file that cannot be read, and for
/// a query that needs more than a layout has.
[[nodiscard]] Scene read_layout(std::vector<InputFile> files, const LayoutRequest& request);

}  // namespace nearfield::tools
