#pragma once

#include <nearfield/world.hpp>

#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
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

}  // namespace nearfield::tools
