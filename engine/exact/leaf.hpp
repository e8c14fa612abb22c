#pragma once

#include <engine/localize/hierarchy.hpp>

#include <array>
#include <cstdint>

namespace nearfield::exact {

/// An edge with its ends in the world.
struct Edge {
    std::uint32_t index = 0;
    geometry::Vector start;
    geometry::Vector end;
};

/// The edges of a small node, placed in the world.
class Leaf {
public:
    /// So few edges are looked at one by one: computing smaller boxes would cost as much.
    static constexpr std::uint32_t most_edges = 8;

    [[nodiscard]] static bool is_leaf(const localize::Node& node) {
        return node.rings == 1 && node.count <= most_edges;
    }

    Leaf(const geometry::PlacedPolygon& placed, const localize::Node& node)
        : first_(node.first), count_(node.count) {
        for (std::uint32_t i = 0; i < count_; ++i) {
            vertices_[i] = placed.vertex(first_ + i);
        }
        vertices_[count_] = placed.vertex(placed.polygon().next(first_ + count_ - 1));
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] Edge edge(std::uint32_t i) const {
        return {first_ + i, vertices_[i], vertices_[i + 1]};
    }

private:
    std::uint32_t first_;
    std::uint32_t count_;
    std::array<geometry::Vector, most_edges + 1> vertices_;
};

}  // namespace nearfield::exact
