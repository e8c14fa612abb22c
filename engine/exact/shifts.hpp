#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/exact/work_meter.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::exact {

/// Lengths of way along a direction for which two boundaries do not meet.
struct ShiftGap {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    EdgePair begins_at;  ///< the edges that part there; not for a gap that begins at 0
    EdgePair ends_at;    ///< the edges that meet there; not for one that does not end
};

/// Finds out where, on A's way along a direction, its boundary meets that of B: an edge of A meets
/// an edge of B for one interval of the way, and between the intervals there are gaps. Keeps its
/// memory from pair to pair.
class ShiftFinder {
public:
    /// The gaps from 0 up to `most`, in ascending order, up to rounding; none where to find them
    /// would take more work than is left. The direction is a unit vector.
    [[nodiscard]] const std::vector<ShiftGap>& find(const PlacedEdges& a, const PlacedEdges& b,
                                                    const geometry::Vector& direction, double most,
                                                    WorkMeter& work);

    /// The first of them; one that begins beyond `most` where there is none.
    [[nodiscard]] ShiftGap find_first(const PlacedEdges& a, const PlacedEdges& b,
                                      const geometry::Vector& direction, double most,
                                      WorkMeter& work);

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
        EdgePair edges;
    };

    static void project(const PlacedEdges& edges, const geometry::Vector& direction,
                        std::vector<Level>& levels);
    /// False where there was too little work left.
    [[nodiscard]] bool add_intervals(double most, double rounding, WorkMeter& work);

    std::vector<Level> of_a_;
    std::vector<Level> of_b_;
    std::vector<Interval> intervals_;
    std::vector<ShiftGap> gaps_;
};

}  // namespace nearfield::exact
