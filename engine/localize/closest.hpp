#pragma once

#include <engine/localize/lazy_tree.hpp>
#include <engine/localize/overlap.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::localize {

/// Finds where the closest features of two boundaries can be: branch and bound over both lazily
/// evaluated hierarchies, down to their leaves (section 2.1 of the paper, "closest feature pairs").
/// Keeps its memory from call to call.
class ClosestChains {
public:
    /// Appends to `chains` those parts of A's boundary, leaf by leaf and in order along its rings,
    /// that can hold a point as near to B's boundary as any. What is left out holds none. Of the
    /// options, `grow` has no meaning here.
    Effort find(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                const OverlapOptions& options, std::vector<Chain>& chains);

    /// Of the last search: some two boundary points are this close together.
    [[nodiscard]] double upper_bound() const;

private:
    struct LeafPair {
        std::uint32_t a = 0;
        double squared = 0.0;  // no two points of the leaves are closer
    };
    struct Leaves;

    LazyTree tree_a_;
    LazyTree tree_b_;
    double squared_bound_ = 0.0;
    std::vector<LeafPair> pairs_;
    std::vector<std::uint32_t> kept_;
};

}  // namespace nearfield::localize
