#pragma once

#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::world {

/// Finds what one segment after the other hits. For one thread; several objects may work on one
/// world at the same time. Keeps its memory.
class RayQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const WorldFilter& filter);

    [[nodiscard]] RayHit first(const Segment& segment);
    /// Appends all hits, in order along the segment.
    void find_all(const Segment& segment, std::vector<RayHit>& hits);

private:
    /// An edge that the segment hits.
    struct Found {
        double parameter;
        std::uint64_t number;  // of the instance
        std::uint32_t instance;
        std::uint32_t edge;

        [[nodiscard]] bool operator<(const Found& other) const {
            return parameter != other.parameter ? parameter < other.parameter
                   : number != other.number     ? number < other.number
                                                : edge < other.edge;
        }
    };

    void search(const Segment& segment, bool all);
    void search_edges_of(std::uint32_t index);
    void take(const Found& found);
    [[nodiscard]] RayHit hit_of(const Found& found) const;

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
    simd::Path path_;
    geometry::Vector from_ = geometry::Vector::Zero();
    geometry::Vector to_ = geometry::Vector::Zero();
    double rounding_ = 0.0;
    bool all_ = false;
    std::vector<Found> found_;  // the first alone, unless all are wanted
};

}  // namespace nearfield::world
