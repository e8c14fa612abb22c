#pragma once

#include <nearfield/result.hpp>
#include <nearfield/world.hpp>

#include <tools/io/json_writer.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nearfield::tools {

/// The nearest of many points or poses: those of input i are hits[offsets[i]] to
/// hits[offsets[i + 1] - 1].
template <class Hit>
struct NearestLists {
    std::vector<std::uint32_t> offsets;
    std::vector<Hit> hits;
};

/// What a query of a world found: one record per pose, segment or sweep, or a list of records per
/// point, segment or other input.
using WorldRecords = std::variant<std::vector<std::uint8_t>,   // poses: 1 if it intersects
                                  std::vector<Clearance>,      // poses
                                  std::vector<RayHit>,         // rays: the first hits
                                  std::vector<ShapeCastHit>,   // cast
                                  NearestLists<NearestHit>,    // nearest of points
                                  NearestLists<Clearance>,     // nearest of a shape at poses
                                  NearestLists<ShapeEdgeHit>,  // the same of edges
                                  RayHits,                     // rays: all hits
                                  InstanceLists>;              // overlap

/// The answer to a query of a world. Refers to objects that the caller keeps.
struct WorldAnswer {
    static constexpr std::size_t no_instance = std::numeric_limits<std::size_t>::max();

    const WorldRequest* request = nullptr;
    const Scene* scene = nullptr;
    std::span<const std::size_t> instances;  ///< into Scene::instances, by InstanceHandle::index
    WorldRecords records;

    /// Index into Scene::instances; `no_instance` of a handle that names none.
    [[nodiscard]] std::size_t index_of(InstanceHandle handle) const noexcept {
        return handle == InstanceHandle{} ? no_instance : instances[handle.index];
    }
    /// The name of an instance that there is.
    [[nodiscard]] const std::string& name_of(InstanceHandle handle) const {
        return scene->instances[index_of(handle)].name;
    }
};

// What the records of a world's answers consist of, said once for all formats. A Row has the
// functions number, index, truth, instance, point (which may be missing), feature and state, each
// of which gets the name of the member first.

/// True of a unit vector; a direction that there is not is (0, 0).
[[nodiscard]] inline bool is_direction(Vector2 vector) noexcept {
    return vector.x != 0.0 || vector.y != 0.0;
}

/// True of a handle that names an instance.
[[nodiscard]] inline bool is_instance(InstanceHandle handle) noexcept {
    return !(handle == InstanceHandle{});
}

/// A row whose cells are members of a JSON object that is open. `InstanceOf` makes the value of an
/// instance from its handle.
template <class InstanceOf>
class JsonRow {
public:
    JsonRow(JsonWriter& json, InstanceOf instance_of) : json_(json), instance_of_(instance_of) {}

    void number(std::string_view name, double number) { json_.member(name, number); }
    void truth(std::string_view name, bool truth) { json_.member(name, truth); }
    void instance(std::string_view name, InstanceHandle handle) {
        json_.member(name, instance_of_(handle));
    }
    void state(std::string_view name, ImpactState state) { json_.member(name, name_of(state)); }
    void index(std::string_view name, std::uint32_t index, bool is_there) {
        json_.member(name, index, is_there);
    }
    void point(std::string_view name, Vector2 point, bool is_there) {
        json_.member(name, point, is_there);
    }
    void feature(std::string_view name, Feature feature) { json_.member(name, feature); }

private:
    JsonWriter& json_;
    InstanceOf instance_of_;
};

template <class Row>
void write_cells(Row& row, std::uint8_t intersects) {
    row.truth("hit", intersects != 0);
}

template <class Row>
void write_cells(Row& row, const Clearance& clearance) {
    const bool has_direction = is_direction(clearance.direction);
    row.number("distance", clearance.distance);
    row.number("error_bound", clearance.error_bound);
    row.instance("instance", clearance.instance);
    row.point("point", clearance.point, has_direction);
    row.point("nearest", clearance.nearest, has_direction);
    row.point("direction", clearance.direction, has_direction);
}

template <class Row>
void write_cells(Row& row, const ShapeEdgeHit& hit) {
    row.instance("instance", hit.instance);
    row.index("edge", hit.edge, true);
    row.number("distance", hit.distance);
    row.number("error_bound", hit.error_bound);
    row.point("point", hit.point, true);
    row.point("nearest", hit.nearest, true);
    row.point("direction", hit.direction, is_direction(hit.direction));
}

template <class Row>
void write_cells(Row& row, const RayHit& hit) {
    const bool is_hit = is_instance(hit.instance);
    row.instance("instance", hit.instance);
    row.number("parameter", hit.parameter);
    row.number("error_bound", hit.error_bound);
    row.point("point", hit.point, is_hit);
    row.point("normal", hit.normal, is_hit);
    row.index("edge", hit.edge, is_hit);
}

template <class Row>
void write_cells(Row& row, const ShapeCastHit& hit) {
    row.state("state", hit.state);
    row.instance("instance", hit.instance);
    row.number("time", hit.time);
    row.number("time_error_bound", hit.time_error_bound);
    row.number("error_bound", hit.error_bound);
    row.point("point", hit.point, is_instance(hit.instance));
    row.point("nearest", hit.nearest, is_instance(hit.instance));
    row.point("direction", hit.direction, is_direction(hit.direction));
}

template <class Row>
void write_cells(Row& row, const NearestHit& hit) {
    row.instance("instance", hit.instance);
    row.number("distance", hit.distance);
    row.number("error_bound", hit.error_bound);
    row.point("nearest", hit.nearest, true);
    row.feature("feature", hit.feature);
}

template <class Row>
void write_cells(Row& row, InstanceHandle instance) {
    row.instance("instance", instance);
}

/// The records of an answer with lists.
template <class Hit>
[[nodiscard]] const std::vector<Hit>& records_of(const NearestLists<Hit>& lists) {
    return lists.hits;
}
[[nodiscard]] inline const std::vector<RayHit>& records_of(const RayHits& lists) {
    return lists.hits;
}
[[nodiscard]] inline const std::vector<InstanceHandle>& records_of(const InstanceLists& lists) {
    return lists.instances;
}
/// The records of an answer without lists.
template <class Record>
[[nodiscard]] const std::vector<Record>& records_of(const std::vector<Record>& records) {
    return records;
}

/// True of an answer with a list of records per input.
template <class Records>
inline constexpr bool has_lists = requires(const Records& records) {
    records.offsets;
};

/// True of a record that says that its input hits something.
[[nodiscard]] inline bool is_hit(std::uint8_t intersects) noexcept {
    return intersects != 0;
}
[[nodiscard]] inline bool is_hit(const RayHit& hit) noexcept {
    return is_instance(hit.instance);
}
[[nodiscard]] inline bool is_hit(const ShapeCastHit& hit) noexcept {
    return hit.state != ImpactState::separated;
}

/// Writes the records as CSV with a line of names. Cells of what there is not are empty.
void write_world_csv(std::ostream& stream, const WorldAnswer& answer);

/// Writes the records in NumPy's format: float64, shape (records, columns). Instances are indices
/// into Scene::instances and states those of ImpactState; what there is not is -1, points NaN.
void write_world_npy(std::ostream& stream, const WorldAnswer& answer);

/// Writes the members of an object that is open: the query, the summary and the records, or where
/// they are written to.
void write_world_answer(JsonWriter& json, const WorldAnswer& answer);

/// Writes the lines of a text for people.
void write_world_summary(std::ostream& stream, const WorldAnswer& answer);

}  // namespace nearfield::tools
