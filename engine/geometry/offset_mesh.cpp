#include <engine/geometry/clip.hpp>
#include <engine/geometry/offset_mesh.hpp>

#include <cstddef>

namespace nearfield::geometry {

namespace {

constexpr double cosine = 0.92387953251128674;  // of 22.5 degrees
constexpr double sine = 0.38268343236508977;

// Corners of the octagon around the unit circle, times cos(22.5 degrees), counter-clockwise from
// the tangent. One side is perpendicular to the tangent; the sides parallel to it on either hand
// become the long sides of the stretched octagon.
constexpr double corners[8][2] = {{cosine, sine},  {sine, cosine},   {-sine, cosine},
                                  {-cosine, sine}, {-cosine, -sine}, {-sine, -cosine},
                                  {sine, -cosine}, {cosine, -sine}};

}  // namespace

std::optional<OffsetPolygon> offset_polygon(const Vector& a, const Vector& b, double offset,
                                            std::uint32_t width, std::uint32_t height,
                                            SubpixelGrid grid) {
    // Snapping pulls the border in by at most the largest move. Half a move more keeps a sample at
    // exactly `offset` inside rather than on the border, where the fill rule might drop it.
    const double circumradius = (offset + 1.5 * grid.largest_move()) * offset_overreach;
    const double margin = circumradius + grid.largest_move();
    Vector from = a;
    Vector to = b;
    if (!clip_to_slab(from, to, 0, -margin, width + margin) ||
        !clip_to_slab(from, to, 1, -margin, height + margin)) {
        return std::nullopt;
    }

    // The tangent of the whole edge: the part may be short, or a point.
    Vector tangent = (b - a).stableNormalized();
    if (tangent.isZero(0.0)) {
        tangent = Vector::UnitX();
    }
    const Vector normal(-tangent.y(), tangent.x());
    OffsetPolygon polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto [along, across] = corners[i];
        const Vector& end = along > 0.0 ? to : from;
        const Vector corner = end + circumradius * (along * tangent + across * normal);
        polygon[i] = Vector(grid.snap(corner.x()), grid.snap(corner.y()));
    }
    return polygon;
}

void append_offset_polygon(const Vector& a, const Vector& b, double offset, std::uint32_t width,
                           std::uint32_t height, SubpixelGrid grid, std::uint32_t id, Mesh& mesh) {
    const std::optional<OffsetPolygon> polygon = offset_polygon(a, b, offset, width, height, grid);
    if (!polygon) {
        return;
    }
    const auto vertex = [id](const Vector& corner) {
        return MeshVertex{
            .x = static_cast<float>(corner.x()), .y = static_cast<float>(corner.y()), .id = id};
    };
    for (std::size_t i = 2; i < polygon->size(); ++i) {
        mesh.insert(mesh.end(),
                    {vertex((*polygon)[0]), vertex((*polygon)[i - 1]), vertex((*polygon)[i])});
    }
}

}  // namespace nearfield::geometry
