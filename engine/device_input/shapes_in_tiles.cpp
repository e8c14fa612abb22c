#include <engine/device_input/shapes_in_tiles.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <cmath>

namespace nearfield::device_input {
namespace {

using geometry::Vector;

/// Two floats whose sum is a number to about 48 bits.
void split(const Vector& numbers, shaders::vec2& high, shaders::vec2& low) {
    high = {static_cast<float>(numbers.x()), static_cast<float>(numbers.y())};
    low = {static_cast<float>(numbers.x() - static_cast<double>(high.x)),
           static_cast<float>(numbers.y() - static_cast<double>(high.y))};
}

}  // namespace

shaders::ShapeInTileData ShapesInTiles::see(const geometry::Polygon& polygon, const Pose& pose,
                                            const PlannedTile& tile, double deviation,
                                            std::uint32_t mask) {
    if (!is_begun_) {
        shapes_.begin_batch();
        is_begun_ = true;
    }
    const geometry::TransformedPolygon placed(polygon, pose);
    const double cell = tile.grid.cell;
    const Vector offset = (placed.translation() - tile.origin()) / cell;
    shaders::ShapeInTileData data;
    split(unit_length_of(polygon) / cell * placed.rotation().col(0), data.axis, data.axis_low);
    split(offset, data.offset, data.offset_low);
    data.shape = shapes_.place_for_field(polygon, deviation);
    data.size = tile.width | tile.height << 16U;
    data.mask = mask;
    // Where single precision selects edges it errs by at most 2^-20 of the coordinates.
    const double extent = 2.0 * polygon.radius() / cell + offset.norm() + tile.width + tile.height;
    data.slack = rounded_up(2.0 * (std::ldexp(extent, -20) + queries::margin_in_cells + 0.01));
    return data;
}

}  // namespace nearfield::device_input
