#pragma once

#include <engine/narrowphase/crossings.hpp>
#include <engine/plan/edge_sampler.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::cpu {

/// Finds the samples of a polygon's boundary that lie inside another polygon. Finds the crossings
/// of the boundaries first: parity propagates between two crossings, so one sample decides for all
/// of them, and parts outside are not sampled. Reuses its memory between pairs.
class InsideSamples {
public:
    /// Appends the samples in order along A's rings, consecutive ones at most `spacing` apart along
    /// the boundary (see plan::sample_chains). Precondition: unless both polygons are small, both
    /// are complete. Unspecified for samples on B's boundary. `reversed`: the previous call had the
    /// same polygons in the opposite order.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b, bool reversed,
              double spacing, simd::PointList& inside);

private:
    /// The side of B at the current position on A's boundary.
    enum class Side : std::uint8_t { unknown, inside, outside };

    [[nodiscard]] std::span<const std::uint32_t> edges_near(const simd::TransformedEdges& a,
                                                            const simd::TransformedEdges& b);
    /// Appends the inside samples of an edge that is divided into `parts`.
    void follow(std::uint32_t edge, double parts, std::span<const narrowphase::Crossing> crossings);
    /// Appends the samples of parts `part`, ..., end - 1, which lie on one side.
    void add_interval(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    /// The same for parts that do not lie on one side.
    void add_one_by_one(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    [[nodiscard]] Side side_of(const geometry::Vector& point) const;

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    simd::PointList* inside_ = nullptr;
    Side side_ = Side::unknown;
    narrowphase::CrossingFinder crossings_;
    std::vector<std::uint32_t> near_;  // edges of A
};

}  // namespace nearfield::cpu
