#pragma once

#include <engine/narrowphase/crossings.hpp>
#include <engine/narrowphase/ray_parities.hpp>
#include <engine/plan/edge_sampler.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <optional>
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
    using Ticket = narrowphase::RayParities::Ticket;
    static constexpr Ticket is_outside = narrowphase::RayParities::even;
    static constexpr Ticket is_inside = narrowphase::RayParities::odd;

    /// Samples that were added before it is known whether they are inside.
    struct Doubtful {
        std::uint32_t first;
        std::uint32_t end;
        Ticket side;
    };

    [[nodiscard]] std::span<const std::uint32_t> edges_near(const simd::TransformedEdges& a,
                                                            const simd::TransformedEdges& b);
    /// Appends the inside samples of an edge that is divided into `parts`.
    void follow(std::uint32_t edge, double parts, std::span<const narrowphase::Crossing> crossings);
    /// Appends the samples of parts `part`, ..., end - 1, which lie on one side.
    void add_interval(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    /// The same for parts that do not lie on one side.
    void add_one_by_one(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    [[nodiscard]] Ticket side_of(const geometry::Vector& point);
    /// Adds a sample, unless it is known to be outside. Precondition: space is reserved.
    void add(const geometry::Vector& point, Ticket side);
    /// Removes the samples that turned out to be outside.
    void remove_outside();

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    simd::PointList* inside_ = nullptr;
    std::optional<Ticket> side_;  // of B, at the current position on A's boundary; or unknown
    narrowphase::RayParities sides_;
    std::vector<Doubtful> doubtful_;
    narrowphase::CrossingFinder crossings_;
    std::vector<std::uint32_t> near_;  // edges of A
};

}  // namespace nearfield::cpu
