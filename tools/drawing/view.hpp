#pragma once

#include <nearfield/shape.hpp>

#include <span>
#include <vector>

namespace nearfield::tools {

/// The mapping of a world rectangle to the page: x to the right in both, y up in the world and down
/// on the page (in pixels), with the same scale for both axes.
class View {
public:
    /// Centres `world` in `page`. The view's own world rectangle fills the page rectangle, so it
    /// may be larger than `world` in one direction.
    View(const Rectangle& world, const Rectangle& page);

    [[nodiscard]] Vector2 to_page(Vector2 point) const {
        return {page_.min.x + (point.x - world_.min.x) * scale_,
                page_.max.y - (point.y - world_.min.y) * scale_};
    }
    [[nodiscard]] Vector2 to_world(Vector2 point) const {
        return {world_.min.x + (point.x - page_.min.x) / scale_,
                world_.min.y + (page_.max.y - point.y) / scale_};
    }
    [[nodiscard]] double scale() const noexcept { return scale_; }  ///< pixels per world unit
    [[nodiscard]] const Rectangle& world() const noexcept { return world_; }
    [[nodiscard]] const Rectangle& page() const noexcept { return page_; }

    /// A ring on the page, clipped slightly outside the view: at high zoom, far vertices would
    /// overflow the drawing library's fixed-point coordinates.
    [[nodiscard]] std::vector<Vector2> to_page(const Ring& ring) const;

private:
    Rectangle world_;
    Rectangle page_;
    double scale_ = 1.0;
};

/// The bounding box of rings. Precondition: at least one vertex.
[[nodiscard]] Rectangle bounding_box(std::span<const Ring> rings);
[[nodiscard]] Rectangle united(const Rectangle& a, const Rectangle& b);
/// A rectangle with a margin on every side, as a fraction of its longer side.
[[nodiscard]] Rectangle with_margin(const Rectangle& rectangle, double fraction);

/// The largest step not above `range / count` that is 1, 2 or 5 times a power of ten.
[[nodiscard]] double round_step(double range, double count);

}  // namespace nearfield::tools
