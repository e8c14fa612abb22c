#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstdint>

namespace nearfield::exact {

/// Some of the edges of a small polygon in arrays of their own, in ascending order. Keeps its
/// memory from polygon to polygon.
class PickedEdges {
public:
    /// Those whose boxes meet a box.
    void pick(const PlacedEdges& from, const Extent& box);

    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// Precondition: not empty.
    [[nodiscard]] EdgeArrays edges() const;
    /// Its index in the polygon.
    [[nodiscard]] std::uint32_t index(std::uint32_t edge) const { return indices_[edge]; }

private:
    static constexpr std::size_t room = padded(most_edges_one_by_one);
    std::uint32_t count_ = 0;
    std::uint32_t indices_[room];
    double start_x_[room];
    double start_y_[room];
    double end_x_[room];
    double end_y_[room];
    double inverse_length_[room];
};

}  // namespace nearfield::exact
