#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/simd/neighbour_kernels.hpp>
#include <engine/solvers/resolved_point.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace nearfield::batch {

/// Points whose nearest edges of B are known, a few at a time: their nearest points are computed
/// together. Fastest where consecutive points have the same edge.
class PointBlock {
public:
    static constexpr std::uint32_t capacity = 64;

    /// Forgets all points, and those of another B.
    void begin(const geometry::TransformedPolygon& b) {
        b_.emplace(b);
        edge_ = std::numeric_limits<std::uint32_t>::max();
        ring_begin_ = ring_end_ = 0;
        clear();
    }
    void clear() { count_ = 0; }

    [[nodiscard]] std::uint32_t size() const { return count_; }
    [[nodiscard]] bool is_full() const { return count_ == capacity; }

    /// `index`: for index(). Precondition: it is not full.
    void add(std::uint32_t index, const geometry::Vector& point, std::uint32_t edge) {
        if (edge != edge_) {
            enter(edge);
        }
        const std::uint32_t i = count_++;
        index_[i] = index;
        edge_of_[i] = edge;
        after_[i] = after_edge_;
        x_[i] = point.x();
        y_[i] = point.y();
        for (std::size_t k = 0; k < vertices; ++k) {
            vertex_x_[k][i] = x_of_vertex_[k];
            vertex_y_[k][i] = y_of_vertex_[k];
        }
    }

    /// Finds the nearest points on the edges; of `with_neighbours`, the nearest of their
    /// neighbours' as well.
    void find(bool with_neighbours);
    /// Replaces what find() found.
    void set(std::uint32_t i, const narrowphase::NearestPoint& nearest);

    [[nodiscard]] std::uint32_t index(std::uint32_t i) const { return index_[i]; }
    [[nodiscard]] geometry::Vector point(std::uint32_t i) const { return {x_[i], y_[i]}; }
    // Precondition: find() has been called.
    [[nodiscard]] double distance(std::uint32_t i) const { return distance_[i]; }
    [[nodiscard]] solvers::ResolvedPoint resolved(std::uint32_t i, bool inside, bool unique) const {
        const double parameter = parameter_[i];
        const Feature::Kind kind =
            parameter > 0.0 && parameter < 1.0 ? Feature::Kind::edge : Feature::Kind::vertex;
        return {point(i),     {nearest_x_[i], nearest_y_[i]},
                distance_[i], edge_of_[i],
                parameter,    {kind, parameter >= 1.0 ? after_[i] : edge_of_[i]},
                inside,       unique};
    }

private:
    static constexpr std::size_t vertices = 4;  // of NeighbourArrays
    using Numbers = std::array<double, capacity>;
    static_assert(capacity % simd::max_lanes == 0);

    void enter(std::uint32_t edge);
    void take_neighbours();

    std::optional<geometry::TransformedPolygon> b_;
    // The edge of the point added last, the one after it, and its vertices of NeighbourArrays.
    std::uint32_t edge_ = 0;
    std::uint32_t after_edge_ = 0;
    std::array<double, vertices> x_of_vertex_{};
    std::array<double, vertices> y_of_vertex_{};
    std::uint32_t ring_begin_ = 0;  // of this edge
    std::uint32_t ring_end_ = 0;
    std::uint32_t count_ = 0;
    std::array<std::uint32_t, capacity> index_{};
    std::array<std::uint32_t, capacity> edge_of_{};
    std::array<std::uint32_t, capacity> after_{};  // the edge after that
    Numbers x_{};
    Numbers y_{};
    std::array<Numbers, vertices> vertex_x_{};
    std::array<Numbers, vertices> vertex_y_{};
    // What find() found.
    Numbers nearest_x_{};
    Numbers nearest_y_{};
    Numbers distance_{};
    Numbers parameter_{};
    Numbers neighbour_{};
};

}  // namespace nearfield::batch
