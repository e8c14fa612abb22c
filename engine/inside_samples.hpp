#pragma once

#include <engine/exact/crossings.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/plan/edge_sampler.hpp>
#include <engine/point_list.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// The samples of a polygon's boundary that lie inside another polygon. Where the boundary crosses
/// the other one is found first: of what lies between two crossings one sample tells for all, and
/// what is outside is not sampled. Keeps its memory from pair to pair.
class InsideSamples {
public:
    /// Appends them in order along A's rings, consecutive ones at most `spacing` apart along the
    /// boundary (see plan::sample_chains). Where either polygon is not small both are complete. For
    /// samples on B's boundary either answer may come. `reversed`: the call before was about the
    /// same polygons, the other way round.
    void find(const exact::PlacedEdges& a, const exact::PlacedEdges& b, bool reversed,
              double spacing, PointList& inside);

private:
    /// What is known of the place that the boundary of A was followed to.
    enum class Side : std::uint8_t { unknown, inside, outside };

    [[nodiscard]] std::span<const std::uint32_t> edges_near(const exact::PlacedEdges& a,
                                                            const exact::PlacedEdges& b);
    /// An edge of so many parts, as far as it lies inside.
    void follow(std::uint32_t edge, double parts, std::span<const exact::Crossing> crossings);
    /// Of parts from `part` on and before `end`, which lie on one side.
    void add_stretch(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    /// Of those that do not.
    void add_one_by_one(std::uint32_t edge, double parts, std::uint32_t part, std::uint32_t end);
    [[nodiscard]] Side side_of(const geometry::Vector& point) const;

    const exact::PlacedEdges* a_ = nullptr;
    const exact::PlacedEdges* b_ = nullptr;
    PointList* inside_ = nullptr;
    Side side_ = Side::unknown;
    exact::CrossingFinder crossings_;
    std::vector<std::uint32_t> near_;  // edges of A
};

}  // namespace nearfield
