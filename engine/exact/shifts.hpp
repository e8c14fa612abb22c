#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::exact {

/// Lengths of way along a direction for which two boundaries do not meet.
struct ShiftGap {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    // The edges that part where the gap begins; not for a gap that begins at 0.
    std::uint32_t edge_a = 0;
    std::uint32_t edge_b = 0;
};

/// Finds out where, on A's way along a direction, its boundary meets that of B: an edge of A meets
/// an edge of B for one interval of the way, and between the intervals there are gaps. Keeps its
/// memory from pair to pair.
class ShiftFinder {
public:
    /// The gaps from 0 up to `most`, in ascending order, up to rounding. The direction is a unit
    /// vector.
    [[nodiscard]] const std::vector<ShiftGap>& find(const PlacedEdges& a, const PlacedEdges& b,
                                                    const geometry::Vector& direction, double most);

    /// In the last find().
    [[nodiscard]] std::uint64_t pairs_looked_at() const { return pairs_looked_at_; }

private:
    /// An edge by how far it is along the direction and across it, from its end that is lower
    /// across.
    struct Level {
        double low = 0.0;
        double high = 0.0;
        double along_low = 0.0;
        double along_high = 0.0;
        std::uint32_t edge = 0;
    };
    struct Interval {
        double from = 0.0;
        double to = 0.0;
        std::uint32_t edge_a = 0;
        std::uint32_t edge_b = 0;
    };

    static void project(const PlacedEdges& edges, const geometry::Vector& direction,
                        std::vector<Level>& levels);
    void add_intervals(double most, double rounding);

    std::vector<Level> of_a_;
    std::vector<Level> of_b_;
    std::vector<Interval> intervals_;
    std::vector<ShiftGap> gaps_;
    std::uint64_t pairs_looked_at_ = 0;
};

}  // namespace nearfield::exact
