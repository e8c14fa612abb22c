#pragma once

#include <tools/io/svg.hpp>
#include <tools/io/svg_document.hpp>
#include <tools/io/svg_values.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// What an element of an SVG file is.
enum class SvgRole {
    nothing,  ///< a definition, metadata, of another namespace: draws nothing where it stands
    group,    ///< g, a, switch, svg
    use,
    shape,    ///< has an outline
    skipped,  ///< draws, but has no outline: text, images, lines
};

/// What an element inherits from those around it.
struct SvgState {
    AffineMap map;  ///< from the coordinates around the element to those of the drawing
    FillRule rule = FillRule::nonzero;
    bool is_visible = true;
    std::optional<SvgViewport> viewport = {};
    /// The corners of the canvas in the coordinates of the drawing, if they are known.
    std::optional<std::array<Vector2, 4>> canvas = {};
    int depth = 0;
};

/// Walks the elements of an SVG file that are drawn.
class SvgWalk {
public:
    /// Both must outlive this.
    SvgWalk(const SvgDocument& document, SkippedParts& skipped)
        : document_(document), skipped_(skipped) {}

    /// The state in which the children of the outermost element stand; nothing if it is not
    /// displayed. The map is that to a unit, with y up.
    [[nodiscard]] std::optional<SvgState> enter_root(LengthUnit unit) const;

    /// The role of an element. Throws InputError for an unknown one.
    [[nodiscard]] SvgRole role_of(const pugi::xml_node& node) const;
    /// The children of a group that may be drawn: of a switch one.
    [[nodiscard]] static std::vector<pugi::xml_node> children_of(const pugi::xml_node& group);

    /// The state of an element: with its transform and properties; nothing if it is not displayed.
    [[nodiscard]] std::optional<SvgState> enter(const pugi::xml_node& node,
                                                const SvgState& outer) const;

    /// Adds what an element draws.
    void draw(const pugi::xml_node& node, const SvgState& outer, SvgDrawing& drawing);
    /// Likewise, of an element whose own transform and properties are in the state.
    void draw_inside(const pugi::xml_node& node, const SvgState& state, SvgDrawing& drawing);

    /// What a use refers to; a null node if that draws nothing. Throws InputError.
    [[nodiscard]] pugi::xml_node target_of(const pugi::xml_node& use) const;
    /// The state at the x and y of a use, which draws there what it refers to, or of an svg or
    /// symbol element.
    [[nodiscard]] SvgState placed(const pugi::xml_node& node, const SvgState& state) const;
    /// Adds what a use refers to; the state is that of placed().
    void draw_target(const pugi::xml_node& use, const pugi::xml_node& target, const SvgState& state,
                     SvgDrawing& drawing);

    /// The state inside an svg or symbol element, whose size a use may decide (or a null node).
    [[nodiscard]] SvgState inside_viewport(const pugi::xml_node& node, const pugi::xml_node& use,
                                           const SvgState& state) const;

private:
    [[nodiscard]] std::optional<SvgViewport> window_of(const pugi::xml_node& root,
                                                       const std::optional<SvgViewBox>& box) const;
    void require_read(const pugi::xml_node& node) const;
    void count_work(const pugi::xml_node& node, std::size_t segments);

    const SvgDocument& document_;
    SkippedParts& skipped_;
    std::vector<pugi::xml_node> in_use_;  ///< the targets around what is being drawn
    std::size_t work_ = 0;
};

}  // namespace nearfield::tools
