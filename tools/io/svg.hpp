#pragma once

#include <nearfield/curve.hpp>
#include <nearfield/fill.hpp>

#include <tools/io/simple_features.hpp>
#include <tools/io/values.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// Contours of a path that an element draws together.
struct FilledPart {
    std::uint32_t contours = 0;  ///< those with segments
    FillRule rule = FillRule::nonzero;
};

/// What elements of an SVG file draw: one path, divided into the parts of the elements.
struct SvgDrawing {
    CurvePath path;
    std::vector<FilledPart> parts;
};

/// Parses what an SVG file draws: path, polygon, polyline, rect, circle and ellipse, in nested
/// groups, symbols and svg elements with transforms, once for each `use`. Properties that decide
/// about geometry are read as attributes, in a style and in style sheets with simple selectors:
/// fill-rule, display, visibility, transform, and the lengths of elements. Text, images and lines
/// are counted in `skipped`; definitions, metadata and elements of other namespaces are passed
/// over. Refused by name: unknown elements, clipping, masks, references to other files, units that
/// depend on a font.
///
/// Coordinates are the user units of the outermost svg element; with another unit its viewBox,
/// width and height apply, and coordinates are in that unit. SVG's y axis points down; y becomes -y
/// here, so that an outline looks as displayed. Paint does not matter: everything that an element
/// encloses by its fill-rule is drawn. Symbols and nested svg elements are not clipped.
///
/// Throws InputError with file, line and column.
[[nodiscard]] SvgDrawing parse_svg(const std::string& text, const std::string& file,
                                   SkippedParts& skipped, LengthUnit unit = LengthUnit::user);

/// An item of a layout: one of its shapes at a pose.
struct SvgItem {
    std::string name;       ///< the id of the element, or of what it uses, or what it is
    std::size_t shape = 0;  ///< index into SvgLayout::shapes
    Pose pose;
};

/// What an SVG file draws, item by item.
struct SvgLayout {
    std::vector<SvgDrawing> shapes;  ///< in their own coordinates
    std::vector<std::string> shape_names;
    std::vector<SvgItem> items;  ///< in the order in which they are drawn
};

/// Parses an SVG file as a layout of items, as nesting tools write them. An item is
/// - a `use`;
/// - a group that holds outlines and nothing else that is drawn, unless it is a layer of an editor;
/// - any other outline.
///
/// Items that use the same element share a shape; a pose turns and moves it. What else a transform
/// does (scale, mirror, skew) makes a shape of its own. Otherwise as parse_svg().
[[nodiscard]] SvgLayout parse_svg_layout(const std::string& text, const std::string& file,
                                         SkippedParts& skipped, LengthUnit unit = LengthUnit::user);

}  // namespace nearfield::tools
