#pragma once

#include <engine/base/interruption.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/overlap.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::raster {

/// The nodes of a hierarchy that one query has visited so far. A node is computed on first use and
/// kept for the rest of the query, because a pair search returns to it; only the memory outlives
/// the query, so shapes may deform freely.
class LazyTree {
public:
    /// Restarts with only the root. The polygon must outlive the queries.
    void plant(const geometry::TransformedPolygon& polygon,
               const geometry::OverlapOptions& options);

    /// The node of the whole boundary.
    static constexpr std::uint32_t root = 0;

    [[nodiscard]] const geometry::TransformedPolygon& polygon() const {
        return hierarchy_->polygon();
    }
    [[nodiscard]] const geometry::Node& operator[](std::uint32_t index) const {
        return nodes_[index];
    }
    [[nodiscard]] bool splits(std::uint32_t index) const {
        return hierarchy_->splits(nodes_[index]);
    }
    /// Index of the first half of a node; the second follows it. Precondition: the node splits.
    [[nodiscard]] std::uint32_t first_half(std::uint32_t index);

    [[nodiscard]] std::uint64_t nodes_evaluated() const { return hierarchy_->nodes_evaluated(); }

private:
    static constexpr std::uint32_t unknown = 0;  // the root is never a half

    std::optional<geometry::Hierarchy> hierarchy_;
    std::vector<geometry::Node> nodes_;
    std::vector<std::uint32_t> halves_;  // by node: its first half, if requested
};

/// Finds the parts of two boundaries that can contain the closest features: branch and bound over
/// both lazily evaluated hierarchies, down to their leaves (section 2.1 of the paper, "closest
/// feature pairs"). Visits the nearer pair of nodes first, and skips pairs whose boxes are farther
/// apart than the best distance so far. Reuses its memory between calls.
class ClosestChains {
public:
    /// Appends to `chains` the parts of A's boundary, leaf by leaf and in order along its rings,
    /// that can contain a point closest to B's boundary. Omitted parts contain none. `options.grow`
    /// is ignored.
    geometry::Effort find(const geometry::TransformedPolygon& a,
                          const geometry::TransformedPolygon& b,
                          const geometry::OverlapOptions& options,
                          std::vector<geometry::Chain>& chains);

    /// Of the last search: an upper bound on the distance between the boundaries.
    [[nodiscard]] double upper_bound() const;

private:
    struct LeafPair {
        std::uint32_t a = 0;
        double squared = 0.0;  // squared lower bound on the distance between points of the leaves
    };

    [[nodiscard]] double squared_distance(std::uint32_t a, std::uint32_t b) const {
        return geometry::squared_distance(tree_a_[a], tree_b_[b], volume_);
    }
    void visit(std::uint32_t a, std::uint32_t b, double squared);
    void visit_nearer_first(std::uint32_t a1, std::uint32_t b1, std::uint32_t a2, std::uint32_t b2);
    void tighten(const LazyTree& one, std::uint32_t i, const LazyTree& other, std::uint32_t j);

    LazyTree tree_a_;
    LazyTree tree_b_;
    BoundingVolume volume_ = BoundingVolume::axis_aligned;
    SparseCheckpoint<256> checkpoint_;
    double squared_bound_ = 0.0;
    std::uint64_t pairs_rejected_ = 0;
    std::vector<LeafPair> pairs_;
    std::vector<std::uint32_t> kept_;
};

}  // namespace nearfield::raster
