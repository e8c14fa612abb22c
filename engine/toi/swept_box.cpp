#include <engine/geometry/transformed_polygon.hpp>
#include <engine/toi/swept_box.hpp>

#include <limits>

namespace nearfield::toi {

using geometry::Box;
using geometry::to_vector;
using geometry::TransformedPolygon;

Box swept_box(const Motion& motion) {
    // Rounding grows with the arcs and paths that are moved along.
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * motion.magnitude();
    const Pose start = motion.at(0.0);
    const Pose end = motion.at(1.0);
    Box box = TransformedPolygon(motion.polygon(), start).box();
    box.extend(TransformedPolygon(motion.polygon(), end).box());
    if (motion.spin() == 0.0) {
        return geometry::grown(box, rounding);
    }
    // It turns about its own origin, which moves straight.
    Box path(to_vector(start.translation));
    path.extend(to_vector(end.translation));
    return geometry::grown(box.merged(geometry::grown(path, motion.reach())), rounding);
}

}  // namespace nearfield::toi
