#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <cstdint>
#include <limits>

namespace nearfield::queries {

/// Number of samples on each edge of a polygon, as sample_chains() places them: an edge is divided
/// into that many equal parts and sampled at the start of each. Edges may be queried in any order;
/// consecutive edges are cheapest.
class EdgeSampler {
public:
    /// Keeps a reference: the polygon must outlive the sampler.
    EdgeSampler(const geometry::Polygon& polygon, double spacing)
        : polygon_(polygon), spacing_(spacing) {}

    /// Number of parts of an edge: a whole number, possibly huge; 0 for an edge without samples.
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

/// Number of parts of an edge of this length, if it is sampled at all.
[[nodiscard]] double parts_of_length(double length, double spacing);

/// The parts first, ..., end - 1 of an edge: those that can start in a box, and perhaps a few
/// others. Whole numbers.
struct PartRange {
    double first = 0.0;
    double end = 0.0;
};
[[nodiscard]] PartRange parts_within(const geometry::TransformedPolygon& placed, std::uint32_t edge,
                                     double parts, const geometry::Box& within);

/// The same, for callers that filter out most of the outside by themselves: all parts, unless there
/// are very many.
[[nodiscard]] inline PartRange parts_roughly_within(const geometry::TransformedPolygon& placed,
                                                    std::uint32_t edge, double parts,
                                                    const geometry::Box& within) {
    constexpr double very_many = 1024.0;
    return parts < very_many ? PartRange{0.0, parts} : parts_within(placed, edge, parts, within);
}

}  // namespace nearfield::queries
