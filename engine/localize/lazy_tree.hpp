#pragma once

#include <engine/localize/hierarchy.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::localize {

/// The nodes of a hierarchy that one query has visited so far. A node is computed on first use and
/// kept for the rest of the query, because a pair search returns to it; only the memory outlives
/// the query, so shapes may deform freely.
class LazyTree {
public:
    /// Restarts with only the root. The polygon must outlive the queries.
    void plant(const geometry::TransformedPolygon& polygon, std::uint32_t height,
               BoundingVolume volume = BoundingVolume::axis_aligned);

    /// The node of the whole boundary.
    static constexpr std::uint32_t root = 0;

    [[nodiscard]] const geometry::TransformedPolygon& polygon() const {
        return hierarchy_->polygon();
    }
    [[nodiscard]] BoundingVolume volume() const { return volume_; }
    [[nodiscard]] const Node& operator[](std::uint32_t index) const { return nodes_[index]; }
    [[nodiscard]] bool splits(std::uint32_t index) const {
        return hierarchy_->splits(nodes_[index]);
    }
    /// Index of the first half of a node; the second follows it. Precondition: the node splits.
    [[nodiscard]] std::uint32_t first_half(std::uint32_t index);

    [[nodiscard]] std::uint64_t nodes_evaluated() const { return hierarchy_->nodes_evaluated(); }

private:
    static constexpr std::uint32_t unknown = 0;  // the root is never a half

    std::optional<Hierarchy> hierarchy_;
    BoundingVolume volume_ = BoundingVolume::axis_aligned;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> halves_;  // by node: its first half, if requested
};

}  // namespace nearfield::localize
