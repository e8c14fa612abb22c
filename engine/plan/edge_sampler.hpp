#pragma once

#include <engine/geometry/placed_polygon.hpp>

#include <cstdint>
#include <limits>

namespace nearfield::plan {

/// How many samples the edges of a polygon have, as sample_chains() has it: an edge is divided into
/// so many even parts, and sampled where each begins. Edges may be asked about in any order; the
/// least is done for those that follow each other.
class EdgeSampler {
public:
    /// What is referred to has to stay.
    EdgeSampler(const geometry::Polygon& polygon, double spacing)
        : polygon_(polygon), spacing_(spacing) {}

    /// A whole number, which may be huge; 0 for an edge that is left out.
    [[nodiscard]] double parts_of(std::uint32_t edge);

private:
    [[nodiscard]] double length(std::uint32_t edge) const;
    [[nodiscard]] bool starts_anew(std::uint32_t edge) const;
    void catch_up(std::uint32_t edge);
    [[nodiscard]] double advance(std::uint32_t edge, double edge_length);

    const geometry::Polygon& polygon_;
    double spacing_;
    std::uint32_t next_ = std::numeric_limits<std::uint32_t>::max();  // edge, if none is left out
    double since_last_ = 0.0;  // sample, along the boundary to the next edge
};

/// Into how many parts an edge of such a length is divided where it is not left out.
[[nodiscard]] double parts_of_length(double length, double spacing);

/// Of the parts of an edge those that can begin in a box, and perhaps some beside it: first, ...,
/// end - 1. Whole numbers.
struct PartRange {
    double first = 0.0;
    double end = 0.0;
};
[[nodiscard]] PartRange parts_within(const geometry::PlacedPolygon& placed, std::uint32_t edge,
                                     double parts, const geometry::Box& within);

/// The same for who leaves out what is outside in other ways, mostly: all parts unless they are
/// very many.
[[nodiscard]] inline PartRange parts_roughly_within(const geometry::PlacedPolygon& placed,
                                                    std::uint32_t edge, double parts,
                                                    const geometry::Box& within) {
    constexpr double very_many = 1024.0;
    return parts < very_many ? PartRange{0.0, parts} : parts_within(placed, edge, parts, within);
}

}  // namespace nearfield::plan
