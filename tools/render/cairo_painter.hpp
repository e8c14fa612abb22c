#pragma once

#include <tools/picture/view.hpp>
#include <tools/render/drawing.hpp>
#include <tools/render/frame_image.hpp>

namespace nearfield::tools {

/// Draws with Cairo.
[[nodiscard]] FrameImage paint(const Drawing& drawing, const View& view);

}  // namespace nearfield::tools
