#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/simple_features.hpp>
#include <tools/io/values.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// Straight lines, arcs and Bézier curves one after the other, as CAD programs have them.
struct ArcChain {
    /// A point, and the segment that follows it; that of the last one leads back to the first one,
    /// if the chain is closed.
    struct Point {
        Vector2 at;
        /// Of an arc of a circle: the tangent of a quarter of its angle, positive
        /// counter-clockwise; 0 for a straight line.
        double bulge = 0.0;
        /// Or the inner control points of a cubic Bézier curve,
        std::optional<std::array<Vector2, 2>> controls = std::nullopt;
        /// or an arc of an ellipse.
        std::optional<EllipticArc> ellipse = std::nullopt;

        [[nodiscard]] bool has_curve() const { return controls || ellipse; }
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

/// The outlines of a drawing in DXF (text form): LWPOLYLINE and POLYLINE with bulges, LINE, ARC,
/// CIRCLE and whole ELLIPSEs, of model space and of the blocks that INSERTs place. Lines, arcs and
/// open polylines of a block are joined where their ends are no farther apart than 10^-6 of the
/// longer side of what the block holds. Layers, colours and widths do not matter.
///
/// Texts, dimensions, hatches and points are counted in `skipped`; other entities are refused by
/// name, since they may be outlines. With a unit, the header states that of the coordinates; they
/// are read in `unit`. `file` is for the messages of InputError, which give line and column.
[[nodiscard]] CurvePath parse_dxf(const std::string& text, const std::string& file,
                                  SkippedParts& skipped, LengthUnit unit = LengthUnit::user);

}  // namespace nearfield::tools
