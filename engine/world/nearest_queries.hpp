#pragma once

#include <engine/world/instances.hpp>
#include <engine/world/nearest_list.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>

namespace nearfield::world {

/// Finds the nearest instances, or edges, of one point after the other. For one thread; several
/// objects may work on one world at the same time. Keeps its memory.
class NearestQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const NearestQuery& query, const WorldFilter& filter);

    /// Fills `hits`, of which there are as many as the query wants.
    void find(const Vector2& point, std::span<NearestHit> hits);

private:
    struct Found : NearInstanceEdge {
        geometry::NearestOnSegment on_edge;
    };

    void find_in(std::uint32_t index);
    void find_on(std::uint32_t index);
    void find_edges_of(std::uint32_t index);

    const Instances* instances_ = nullptr;
    NearestQuery query_;
    WorldFilter filter_;
    geometry::Vector point_ = geometry::Vector::Zero();
    NearestList<Found> nearest_;
    std::uint32_t guess_ = UINT32_MAX;  // the nearest instance of the point before
};

}  // namespace nearfield::world
