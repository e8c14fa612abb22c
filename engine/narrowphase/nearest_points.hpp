#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/simd/nearest_kernels.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::narrowphase {

/// For each of some points, the nearest point of a transformed polygon's boundary, and whether it
/// is unique. Reuses its memory.
class NearestPoints {
public:
    /// `margin`: for uniqueness, see Boundary::is_unique(). Points, whose arrays need the padding
    /// that kernels read, and edges, which are small or complete, must outlive the queries.
    void find(const simd::PointArrays& points, const simd::TransformedEdges& edges, double margin);

    /// Indexed by point.
    [[nodiscard]] const simd::NearestArrays& arrays() const { return arrays_; }
    /// Boundary::is_unique() for point i.
    [[nodiscard]] bool is_unique(std::size_t i) {
        const double limit = arrays_.distance[i] + margin_;
        return arrays_.second_squared[i] > simd::beyond_rounding(limit) || has_no_rival(i, limit);
    }

private:
    void make_room(std::size_t points, std::size_t edges);
    [[nodiscard]] bool has_no_rival(std::size_t i, double limit);

    simd::PointArrays points_;
    const simd::TransformedEdges* edges_ = nullptr;
    double margin_ = 0.0;
    simd::NearestArrays arrays_;
    std::vector<double> numbers_;         // storage of arrays_
    std::vector<std::uint32_t> indices_;  // the same
    std::vector<std::uint32_t> near_;     // scratch: edges
    simd::DivisionMemory division_;
    Boundary boundary_;  // of edges that are not small
};

}  // namespace nearfield::narrowphase
