#pragma once

#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// Finds the nearest instances, or edges, of one point after the other. For one thread; several
/// objects may work on one world at the same time. Keeps its memory.
class NearestQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const NearestQuery& query);

    /// Fills `hits`, of which there are as many as the query wants.
    void find(const Vector2& point, std::span<NearestHit> hits);

private:
    /// One of the nearest found so far.
    struct Found {
        double distance;
        std::uint64_t number;  // of the instance
        std::uint32_t instance;
        std::uint32_t edge;
        geometry::NearestOnSegment on_edge;

        [[nodiscard]] bool operator<(const Found& other) const {
            return distance != other.distance ? distance < other.distance
                   : number != other.number   ? number < other.number
                                              : edge < other.edge;
        }
    };

    /// Boundaries farther from the point than this are of no interest.
    [[nodiscard]] double reach() const;
    [[nodiscard]] double squared_reach(double rounding) const;
    void find_in(std::uint32_t index);
    void find_on(std::uint32_t index);
    void find_edges_of(std::uint32_t index);
    void take(const Found& found);

    const Instances* instances_ = nullptr;
    NearestQuery query_;
    geometry::Vector point_ = geometry::Vector::Zero();
    std::vector<Found> nearest_;        // in ascending order
    std::uint32_t guess_ = UINT32_MAX;  // the nearest instance of the point before
};

}  // namespace nearfield::world
