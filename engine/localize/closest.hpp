#pragma once

#include <engine/localize/lazy_tree.hpp>
#include <engine/localize/overlap.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::localize {

/// Finds the parts of two boundaries that can contain the closest features: branch and bound over
/// both lazily evaluated hierarchies, down to their leaves (section 2.1 of the paper, "closest
/// feature pairs"). Reuses its memory between calls.
class ClosestChains {
public:
    /// Appends to `chains` the parts of A's boundary, leaf by leaf and in order along its rings,
    /// that can contain a point closest to B's boundary. Omitted parts contain none. `options.grow`
    /// is ignored.
    Effort find(const geometry::TransformedPolygon& a, const geometry::TransformedPolygon& b,
                const OverlapOptions& options, std::vector<Chain>& chains);

    /// Of the last search: an upper bound on the distance between the boundaries.
    [[nodiscard]] double upper_bound() const;

private:
    struct LeafPair {
        std::uint32_t a = 0;
        double squared = 0.0;  // squared lower bound on the distance between points of the leaves
    };
    struct Leaves;

    LazyTree tree_a_;
    LazyTree tree_b_;
    double squared_bound_ = 0.0;
    std::vector<LeafPair> pairs_;
    std::vector<std::uint32_t> kept_;
};

}  // namespace nearfield::localize
