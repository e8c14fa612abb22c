#pragma once

#include <nearfield/curve.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace nearfield::tools {

/// Straight lines and arcs of circles one after the other, as CAD programs have them.
struct ArcChain {
    /// A point, and the bulge of what follows it: the tangent of a quarter of the arc's angle,
    /// positive counter-clockwise, 0 for a straight line. That of the last one is of the segment
    /// back to the first one, if the chain is closed.
    struct Point {
        Vector2 at;
        double bulge = 0.0;
    };
    std::vector<Point> points;
    bool closed = false;
    std::size_t offset = 0;  ///< where it stands in its file
};

/// An end of a chain that no other end meets.
struct LooseEnd {
    Vector2 at;
    std::size_t offset = 0;  ///< of the chain
};

/// Joins open chains, in either direction, into closed ones where ends are no farther apart than
/// `gap` along both axes. Where more than two ends meet any two are joined, which makes no
/// difference to the odd-even rule. Returns the first loose end, if there is one.
[[nodiscard]] std::optional<LooseEnd> close_chains(std::vector<ArcChain>& chains, double gap);

/// The larger side of the box around all points.
[[nodiscard]] double extent_of(const std::vector<ArcChain>& chains);

/// Removes all but one of the open chains of one segment that join the same points alike, in either
/// direction; returns how many.
std::size_t remove_repeated(std::vector<ArcChain>& chains);

/// Adds a closed chain to a path as a contour. Precondition: it has a point.
void append_chain(const ArcChain& chain, CurvePath& path);

}  // namespace nearfield::tools
