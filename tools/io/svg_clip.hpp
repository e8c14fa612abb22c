#pragma once

#include <tools/io/svg_document.hpp>
#include <tools/io/svg_walk.hpp>

#include <string_view>

namespace nearfield::tools {

/// True if a clip-path, as an element in this state has it, keeps the whole canvas: it refers to a
/// clipPath of one straight-edged convex outline of up to four edges that the canvas lies in, to
/// within a ten-thousandth of its diagonal. What it would cut off is not on the canvas.
[[nodiscard]] bool keeps_canvas(const SvgDocument& document, std::string_view clip_path,
                                const SvgState& state);

}  // namespace nearfield::tools
