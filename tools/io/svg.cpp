#include <nearfield/portable_math.hpp>

#include <tools/io/svg.hpp>
#include <tools/io/svg_values.hpp>
#include <tools/io/svg_walk.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nearfield::tools {

SvgDrawing parse_svg(const std::string& text, const std::string& file, SkippedParts& skipped,
                     LengthUnit unit) {
    const SvgDocument document(text, file);
    SvgWalk walk(document, skipped);
    SvgDrawing drawing;
    if (const std::optional<SvgState> state = walk.enter_root(unit)) {
        walk.draw_inside(document.root(), *state, drawing);
    }
    if (drawing.parts.empty()) {
        document.fail(document.root(),
                      "has no outline" + (skipped.empty() ? "" : ", only " + skipped.text()));
    }
    return drawing;
}

namespace {

/// What a map does besides turning and moving, and the pose that does the rest.
struct Placement {
    AffineMap rest;  ///< with its x axis along x; the identity if the map is rigid
    Pose pose;
};

/// Precondition: the x axis is not 0.
Placement divide(const AffineMap& map) {
    const double angle = arc_tangent(map.x_axis.y, map.x_axis.x);
    const double length = std::hypot(map.x_axis.x, map.x_axis.y);
    const double cosine = map.x_axis.x / length;
    const double sine = map.x_axis.y / length;
    Placement placement{.rest = {{length, 0.0},
                                 {cosine * map.y_axis.x + sine * map.y_axis.y,
                                  cosine * map.y_axis.y - sine * map.y_axis.x},
                                 {}},
                        .pose = {map.origin, angle}};
    return placement;
}

/// True of maps without translation that are equal but for rounding.
bool are_equal(const AffineMap& a, const AffineMap& b) {
    const double scale =
        std::max({std::abs(a.x_axis.x), std::abs(a.y_axis.x), std::abs(a.y_axis.y)});
    const double bound = 16.0 * std::numeric_limits<double>::epsilon() * scale;
    return std::abs(a.x_axis.x - b.x_axis.x) <= bound &&
           std::abs(a.y_axis.x - b.y_axis.x) <= bound && std::abs(a.y_axis.y - b.y_axis.y) <= bound;
}

class SvgLayoutReader {
    static constexpr std::size_t no_shape = std::numeric_limits<std::size_t>::max();

public:
    SvgLayoutReader(const SvgDocument& document, SkippedParts& skipped)
        : document_(document), walk_(document, skipped) {}

    SvgLayout read(LengthUnit unit) {
        if (const std::optional<SvgState> state = walk_.enter_root(unit)) {
            visit_children(document_.root(), *state);
        }
        return std::move(layout_);
    }

private:
    /// What a shape was made of.
    struct Source {
        pugi::xml_node size_of = {};  ///< the use that decides about the size of its target
        SvgState state = {};
        AffineMap rest = {};
        std::size_t shape = 0;
    };

    void visit_children(const pugi::xml_node& group, const SvgState& state) {
        for (const pugi::xml_node& child : SvgWalk::children_of(group)) {
            visit(child, state);
        }
    }

    void visit(const pugi::xml_node& node, const SvgState& outer) {
        const SvgRole role = walk_.role_of(node);
        if (role == SvgRole::nothing) {
            return;
        }
        const std::optional<SvgState> state = walk_.enter(node, outer);
        if (!state) {
            return;
        }
        if (role == SvgRole::use) {
            add_use(node, *state);
        } else if (role == SvgRole::skipped) {
            SvgDrawing nothing;
            walk_.draw_inside(node, *state, nothing);
        } else if (local_name(node) == "svg") {
            visit_children(node, walk_.inside_viewport(node, {}, *state));
        } else if (role == SvgRole::group && !is_item(node)) {
            visit_children(node, *state);
        } else {
            const Placement placement = place(node, *state);
            const std::size_t shape = add_shape(node, *state, placement.rest,
                                                [&](const SvgState& own, SvgDrawing& drawing) {
                                                    walk_.draw_inside(node, own, drawing);
                                                });
            add_item(name_of(node, node), shape, placement.pose);
        }
    }

    /// True of a group of outlines and nothing else that is drawn.
    [[nodiscard]] bool is_item(const pugi::xml_node& group) const {
        if (std::string_view(group.attribute("inkscape:groupmode").value()) == "layer") {
            return false;
        }
        bool any = false;
        for (const pugi::xml_node& child : SvgWalk::children_of(group)) {
            const SvgRole role = walk_.role_of(child);
            if (role == SvgRole::use || role == SvgRole::group) {
                return false;
            }
            any = any || role == SvgRole::shape;
        }
        return any;
    }

    void add_use(const pugi::xml_node& use, const SvgState& around) {
        const pugi::xml_node target = walk_.target_of(use);
        if (!target) {
            return;
        }
        const SvgState state = walk_.placed(use, around);
        const Placement placement = place(use, state);
        Source source{.state = state, .rest = placement.rest};
        if (is_one_of(local_name(target), {"symbol", "svg"}) &&
            (use.attribute("width") || use.attribute("height"))) {
            source.size_of = use;
        }
        std::vector<Source>& known = sources_[target.hash_value()];
        const auto found = std::find_if(known.begin(), known.end(), [&](const Source& other) {
            return make_same_shape(source, other);
        });
        if (found == known.end()) {
            source.shape = add_shape(target, state, placement.rest,
                                     [&](const SvgState& own, SvgDrawing& drawing) {
                                         walk_.draw_target(use, target, own, drawing);
                                     });
            known.push_back(source);
            add_item(name_of(use, target), source.shape, placement.pose);
        } else {
            add_item(name_of(use, target), found->shape, placement.pose);
        }
    }

    static bool make_same_shape(const Source& a, const Source& b) {
        const auto size_of = [](const Source& source) {
            return source.state.viewport.value_or(SvgViewport());
        };
        return a.size_of == b.size_of && a.state.rule == b.state.rule &&
               a.state.is_visible == b.state.is_visible && size_of(a).width == size_of(b).width &&
               size_of(a).height == size_of(b).height && are_equal(a.rest, b.rest);
    }

    /// Where the content of an element goes, whose map the state has.
    [[nodiscard]] Placement place(const pugi::xml_node& node, const SvgState& state) const {
        // The map goes from SVG's coordinates to the drawing's; a shape's have y up as well.
        const AffineMap map = combine(svg_to_world, state.map);
        if (map.x_axis.x * map.y_axis.y == map.x_axis.y * map.y_axis.x) {
            document_.fail(node, "its transforms leave no area");
        }
        return divide(map);
    }

    /// The index of a new shape, which `draw` draws; no_shape if nothing is drawn.
    template <class Draw>
    std::size_t add_shape(const pugi::xml_node& content, const SvgState& state,
                          const AffineMap& rest, Draw draw) {
        SvgState own = state;
        own.canvas.reset();  // a shape may have several places
        own.map = combine(svg_to_world, are_equal(rest, AffineMap()) ? AffineMap() : rest);
        SvgDrawing drawing;
        draw(own, drawing);
        if (drawing.parts.empty()) {
            return no_shape;
        }
        layout_.shapes.push_back(std::move(drawing));
        layout_.shape_names.push_back(name_of(content, content));
        return layout_.shapes.size() - 1;
    }

    void add_item(std::string name, std::size_t shape, const Pose& pose) {
        if (shape != no_shape) {
            layout_.items.push_back({std::move(name), shape, pose});
        }
    }

    static std::string name_of(const pugi::xml_node& node, const pugi::xml_node& content) {
        for (const pugi::xml_node& named : {node, content}) {
            if (const std::string_view id = named.attribute("id").value(); !id.empty()) {
                return std::string(id);
            }
        }
        return std::string(local_name(node));
    }

    const SvgDocument& document_;
    SvgWalk walk_;
    SvgLayout layout_;
    std::unordered_map<std::size_t, std::vector<Source>> sources_;  ///< by the target of uses
};

}  // namespace

SvgLayout parse_svg_layout(const std::string& text, const std::string& file, SkippedParts& skipped,
                           LengthUnit unit) {
    const SvgDocument document(text, file);
    SvgLayout layout = SvgLayoutReader(document, skipped).read(unit);
    if (layout.items.empty()) {
        document.fail(document.root(),
                      "has no outline" + (skipped.empty() ? "" : ", only " + skipped.text()));
    }
    return layout;
}

}  // namespace nearfield::tools
