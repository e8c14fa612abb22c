#pragma once

#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/world.hpp>

#include <tools/io/json_document.hpp>
#include <tools/io/names.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

struct Scene;

/// The kinds of queries that a scene asks of its instances as a whole.
enum class WorldQueryType { poses, nearest, rays, cast, overlap };

template <>
inline constexpr auto names<WorldQueryType> = std::to_array<NamedValue<WorldQueryType>>({
    {"poses", WorldQueryType::poses},
    {"nearest", WorldQueryType::nearest},
    {"rays", WorldQueryType::rays},
    {"cast", WorldQueryType::cast},
    {"overlap", WorldQueryType::overlap},
});

[[nodiscard]] std::vector<std::string_view> world_query_type_names();

/// Instances that a query names together.
struct InstanceGroup {
    std::string name;                    ///< of a group or of one instance
    std::vector<std::size_t> instances;  ///< indices into Scene::instances, ascending
};

/// A query of a scene's instances. Poses are in radians.
struct WorldRequest {
    WorldQueryType type = WorldQueryType::poses;
    std::optional<std::size_t> shape;      ///< of poses and sweeps: index into Scene::shapes
    std::optional<InstanceGroup> against;  ///< the instances considered; default all
    std::optional<std::size_t> except;     ///< an instance that is not: index into Scene::instances
    Technique technique = Technique::automatic;  ///< see answering_technique()
    bool records = true;                         ///< false: the summary only
    /// The file into which the records go, beside the scene unless it is absolute; empty: none.
    std::string values;

    // What is asked about: one of these, as the type says.
    std::vector<Pose> poses;
    std::vector<Vector2> points;
    std::vector<Segment> segments;
    std::vector<Sweep> sweeps;
    std::vector<Rectangle> rectangles;

    // For poses.
    bool clearance = false;  ///< the least distances; otherwise whether they intersect
    double min_clearance = -std::numeric_limits<double>::infinity();
    double max_clearance = std::numeric_limits<double>::infinity();
    // For nearest.
    std::uint32_t count = 1;
    NearestKind kind = NearestKind::instances;
    double max_distance = std::numeric_limits<double>::infinity();
    bool all_hits = false;  ///< for rays; otherwise the first one
    // For cast.
    double tolerance = 0.0;
    double contact_distance = 0.0;

    /// The number of poses, points, segments, sweeps or rectangles.
    [[nodiscard]] std::size_t size() const noexcept {
        return poses.size() + points.size() + segments.size() + sweeps.size() + rectangles.size();
    }
};

/// Reads a query of a known type at a place. Tables of numbers come from files where the scene says
/// so; `files` gets their paths. Throws InputError with the place and the reason.
[[nodiscard]] WorldRequest read_world_request(const JsonPlace& place, WorldQueryType type,
                                              const Scene& scene, std::vector<std::string>& files);

/// The instances that the string at a place names: a group, or one instance.
[[nodiscard]] InstanceGroup read_instance_group(const JsonPlace& place, const Scene& scene);

/// The technique that answers a query of all instances: `cpu`, unless it requests `compute`.
[[nodiscard]] Technique answering_technique(const WorldRequest& request);

/// Why the technique that a query requests does not answer it; empty if it does.
[[nodiscard]] std::string technique_problem(const WorldRequest& request);

}  // namespace nearfield::tools
