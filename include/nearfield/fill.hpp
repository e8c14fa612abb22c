#pragma once

#include <nearfield/export.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// \file
/// Conversion of rings with other fill rules than odd-even, and of rings that enclose nothing, into
/// the rings of a shape.
///
///     const Expected<ResolvedFill> fill = resolve_fill(rings, FillRule::nonzero);
///     const Expected<ShapeHandle> shape = context.add_shape(fill->rings, fill->deviation);

namespace nearfield {

/// Which points rings enclose. The winding number of a point counts the turns of all rings around
/// it: counter-clockwise ones are positive.
enum class FillRule : std::uint8_t {
    odd_even,        ///< an odd winding number: the rule of shapes
    nonzero,         ///< a winding number other than 0: SVG's default, fonts
    positive,        ///< a winding number above 0
    union_of_parts,  ///< inside at least one part, each filled by the odd-even rule
};

/// How resolve_fill() works.
struct FillSettings {
    /// Largest deviation of the result, in the units of the rings, > 0; the result states the
    /// actual one. 0: the finest grid. Gaps and slivers narrower than this may close or vanish, so
    /// a deviation above the rounding of the rings' coordinates closes seams that rounding opened.
    double deviation = 0.0;
    /// union_of_parts: the number of rings of each part, in order; together all rings. Empty: every
    /// ring is a part. Borrowed during the call. Other rules ignore it.
    std::span<const std::uint32_t> part_sizes = {};
    /// Maximum number of vertices of the subdivision, crossings included.
    std::uint32_t most = max_vertices;
};

/// A region as rings of the odd-even rule.
struct ResolvedFill {
    /// Rings that do not cross each other or themselves; they may touch at vertices. The region
    /// lies to the left of every edge: outer boundaries run counter-clockwise, holes clockwise.
    /// Empty if the region is.
    std::vector<Ring> rings;
    /// Every point farther than this from the boundary of the wanted region is on the right side,
    /// and no point of the rings is farther than this from that boundary. Queries therefore answer
    /// for a region between the wanted one shrunk by this and grown by it. Pass it to
    /// Context::add_shape.
    double deviation = 0.0;
};

/// Finds the region that rings enclose by a rule. Edges inside the region are gone: they never
/// answer as boundary. Rings may cross, overlap, coincide, repeat vertices and enclose nothing.
///
/// Vertices and crossings move to the centres of the cells of a grid, by at most 0.71 cells. A
/// cell's side is a power of two: 2^-42 of the longer side of the rings' bounding box, or 2^-48 of
/// the largest coordinate, whichever is larger, or as coarse as `settings.deviation` allows. So
/// parts of the region, and gaps in it, that are narrower than twice the deviation may vanish,
/// whatever their length. Edges bend at the cells they pass; vertices on straight edges result.
///
/// If the rings deviate from curves themselves, add the two deviations.
///
/// Fails with invalid_shape for a coordinate that is not finite or exceeds `largest_coordinate`
/// (the message names ring and vertex), rings that together span less than `smallest_extent`, part
/// sizes that do not add up, or a deviation below the finest grid's; with too_large for more than
/// `settings.most` vertices; with out_of_memory. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<ResolvedFill> resolve_fill(
    std::span<const Ring> rings, FillRule rule, const FillSettings& settings = {});

/// Grows the region that rings enclose by a rule, with round corners, or shrinks it: by `distance`,
/// in the units of the rings, negative to shrink. Useful for clearance: B grown by a distance meets
/// all that is no farther than that from B.
///
/// `deviation` (> 0) bounds that of the result, which states the actual one; arcs get as few edges
/// as half of it allows. The law is one of distances to the region as resolve_fill() finds it: with
/// the deviation D of the result, a point closer to it than `distance` - D is inside, and one
/// farther than `distance` + D outside. For a negative distance the same holds of depths below the
/// boundary. Where a gap or a neck is within D of closing, it may be open or closed.
///
/// `settings` are those of resolve_fill(), which works twice. The rings of the result are as
/// ResolvedFill says; none if nothing is left. Fails as resolve_fill(), and with invalid_shape for
/// a distance that is not finite or exceeds `largest_coordinate`, or a deviation that is not above
/// 0 or below that of the grids; with too_large if more than `settings.most` vertices would be
/// needed. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<ResolvedFill> offset_fill(
    std::span<const Ring> rings, FillRule rule, double distance, double deviation,
    const FillSettings& settings = {});

/// What clean() drops.
struct Cleaning {
    /// Parts no wider than this vanish; in the units of the rings, >= 0. The least width is 2^-47
    /// of a ring's largest coordinate, and 0 means that: rounding of coordinates makes smaller
    /// widths meaningless, and Context::add_shape refuses rings that are thinner than half of that.
    double width = 0.0;
    /// Drops vertices as well: repeated ones, those on a straight line between their neighbours,
    /// and spikes. Otherwise only whole rings, and indices within the others stay the caller's.
    bool vertices = true;
};

/// A ring that clean() dropped.
struct DroppedRing {
    std::size_t ring = 0;  ///< its index in the input
    Vector2 at = {};       ///< its first vertex; (0, 0) if it has none
    /// Width of a strip that holds it, along its longest diagonal; 0 for fewer than three different
    /// vertices. Above Cleaning::width only for a bent sliver, which lost one vertex after another.
    double width = 0.0;
};

/// The rings that remain.
struct CleanedRings {
    std::vector<Ring> rings;  ///< those that remain, in order
    /// Every point farther than this from all rings has its winding number unchanged, and no point
    /// of the rings that remain is farther than this from where they were. At most 1.5 times the
    /// width, and 0 where what was dropped encloses nothing. Pass it to Context::add_shape.
    double deviation = 0.0;
    std::vector<DroppedRing> dropped;  ///< in order
    std::size_t repeated = 0;          ///< vertices dropped from `rings`: equal to the next one
    std::size_t collinear = 0;         ///< ... between their neighbours, on a straight line
    std::size_t spikes = 0;            ///< ... tips of spikes
};

/// Drops rings that enclose nothing, or nothing wider than a width, and vertices that do not matter
/// at that width. Works on each ring by itself, so it may be used before resolve_fill(), then
/// add the deviations, and after it: overlapping parts leave slivers.
///
/// Fails with invalid_shape for a coordinate that is not finite or exceeds `largest_coordinate`, or
/// a width that is negative or not finite; with out_of_memory. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<CleanedRings> clean(std::span<const Ring> rings,
                                                            const Cleaning& cleaning = {});

}  // namespace nearfield
