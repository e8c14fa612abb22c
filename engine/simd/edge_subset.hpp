#pragma once

#include <engine/simd/transformed_edges.hpp>

#include <cstdint>

namespace nearfield::simd {

/// A subset of the edges of a small polygon in arrays of their own, in ascending order. Reuses its
/// memory between polygons.
class EdgeSubset {
public:
    /// Selects the edges whose boxes intersect a box.
    void pick(const TransformedEdges& from, const Extent& box);

    void clear() { count_ = 0; }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::uint32_t size() const { return count_; }
    /// Precondition: not empty.
    [[nodiscard]] EdgeArrays edges() const;
    /// The edge's index in the polygon.
    [[nodiscard]] std::uint32_t index(std::uint32_t edge) const { return indices_[edge]; }

private:
    static constexpr std::size_t room = padded(max_edges_one_by_one);
    std::uint32_t count_ = 0;
    std::uint32_t indices_[room];
    double start_x_[room];
    double start_y_[room];
    double end_x_[room];
    double end_y_[room];
    double inverse_length_[room];
};

}  // namespace nearfield::simd
