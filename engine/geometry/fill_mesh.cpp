#include <engine/geometry/clip.hpp>
#include <engine/geometry/fill_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearfield::geometry {

namespace {

// Borders lie one cell outside the tile: on the sub-pixel grid whatever its steps, and more than
// one snap away from any sample.
constexpr double margin = 1.0;

MeshVertex at(double x, double y) {
    return {.x = static_cast<float>(x), .y = static_cast<float>(y)};
}

}  // namespace

FillMesh::FillMesh(std::uint32_t width, std::uint32_t height, SubpixelGrid grid)
    : width_(width), height_(height), grid_(grid) {}

FillMesh::Pieces FillMesh::pieces(const Vector& a, const Vector& b) const {
    Pieces pieces;
    // Ordered by height, so that an edge and its reverse are cut at the same points.
    Vector low = a;
    Vector high = b;
    if (low.y() > high.y()) {
        std::swap(low, high);
    }
    if (!clip_to_slab(low, high, 1, -margin, height_ + margin)) {
        return pieces;
    }
    // Pieces of the edge follow each other without a gap in y: the cut point of two pieces is
    // snapped once for both, so every row centre of the edge is crossed by exactly one of them.
    double borders[] = {-margin, width_ + margin};
    if (low.x() > high.x()) {
        std::swap(borders[0], borders[1]);
    }
    Vector from = low;
    for (const double border : borders) {
        if ((low.x() < border) != (high.x() < border)) {
            const Vector cut = point_on_line(low, high, 0, border);
            add_piece(from, cut, pieces);
            from = cut;
        }
    }
    add_piece(from, high, pieces);
    return pieces;
}

void FillMesh::add_piece(const Vector& from, const Vector& to, Pieces& pieces) const {
    const double left = -margin;
    const double right = width_ + margin;
    const double x0 = grid_.snap(std::clamp(from.x(), left, right));
    const double x1 = grid_.snap(std::clamp(to.x(), left, right));
    const double y0 = grid_.snap(from.y());
    const double y1 = grid_.snap(to.y());

    // A row whose centre an end just touches counts as crossed: whether it is covered is for the
    // fill rule to say, and it says the same to the neighbour that ends there.
    const double first_row = std::max(std::ceil(std::min(y0, y1) - 0.5), 0.0);
    const double last_row = std::min(std::floor(std::max(y0, y1) - 0.5), height_ - 1.0);
    const bool left_of_all_samples = std::max(x0, x1) < 0.5;
    if (y0 != y1 && first_row <= last_row && !left_of_all_samples) {
        pieces.list[pieces.count++] = {Vector(x0, y0), Vector(x1, y1)};
    }
}

void FillMesh::append(const Vector& a, const Vector& b, Mesh& mesh) const {
    const Pieces all = pieces(a, b);
    for (std::uint32_t i = 0; i < all.count; ++i) {
        const auto& [from, to] = all.list[i];
        const double left = -margin;
        if (to.x() > left) {
            mesh.insert(mesh.end(), {at(from.x(), from.y()), at(to.x(), to.y()), at(left, to.y())});
        }
        if (from.x() > left) {
            mesh.insert(mesh.end(), {at(from.x(), from.y()), at(left, to.y()), at(left, from.y())});
        }
    }
}

}  // namespace nearfield::geometry
