#pragma once

#include <engine/exact/picked_edges.hpp>
#include <engine/exact/placed_edges.hpp>

namespace nearfield::exact {

/// Which edges of two placed polygons may meet: two small polygons are looked at edge by edge,
/// others by boxes over their edges. Keeps its memory from pair to pair.
class MeetingPairs {
public:
    /// Calls `use` with an EdgePair for every pair of an edge of A and one of B that come as close
    /// as the vertices' rounding, and hardly any other, as long as it says true; returns whether it
    /// said false. In ascending order where both are small; where either is not both are complete.
    template <class Use>
    bool for_each(const PlacedEdges& a, const PlacedEdges& b, Use&& use) {
        return is_small(a) && is_small(b) ? for_each_of_small(a, b, use)
                                          : for_each_by_boxes(a, b, use);
    }

private:
    template <class Use>
    bool for_each_of_small(const PlacedEdges& a, const PlacedEdges& b, Use& use) {
        const double margin = a.rounding + b.rounding;
        if (!pick_near(a, b, 2.0 * margin)) {
            return false;
        }
        const EdgeArrays picked_a = of_a_.edges();
        const EdgeArrays picked_b = of_b_.edges();
        EdgePair pair;
        while (kernels::find_meeting_pair(picked_a, picked_b, margin, pair)) {
            if (!use(EdgePair{of_a_.index(pair.first), of_b_.index(pair.second)})) {
                return true;
            }
            ++pair.second;
        }
        return false;
    }

    template <class Use>
    static bool for_each_by_boxes(const PlacedEdges& a, const PlacedEdges& b, Use& use) {
        const auto pass_on = [](void* user, const EdgePair& pair) -> bool {
            return (*static_cast<Use*>(user))(pair);
        };
        return kernels::for_meeting_pairs(a.tree(), b.tree(), a.rounding + b.rounding,
                                          {pass_on, &use});
    }

    /// The edges in both boxes, which grow by so much; false where there are none of either.
    [[nodiscard]] bool pick_near(const PlacedEdges& a, const PlacedEdges& b, double grow);

    PickedEdges of_a_;
    PickedEdges of_b_;
};

}  // namespace nearfield::exact
