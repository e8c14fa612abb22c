#include <tools/io/svg_walk.hpp>

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

}  // namespace nearfield::tools
