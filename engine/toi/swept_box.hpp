#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/toi/motion.hpp>

namespace nearfield::toi {

/// A box that contains the polygon at all times of a motion, however its vertices are rounded.
[[nodiscard]] geometry::Box swept_box(const Motion& motion);

}  // namespace nearfield::toi
