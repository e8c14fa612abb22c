#include <engine/geometry/clip.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/whole.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::geometry {

namespace {

// Borders lie one cell outside the tile: on the sub-pixel grid for any number of steps, and more
// than one snap away from every sample.
constexpr double margin = 1.0;

MeshVertex at(double x, double y) {
    return {.x = static_cast<float>(x), .y = static_cast<float>(y)};
}

}  // namespace

FillMesh::FillMesh(std::uint32_t width, std::uint32_t height, SubpixelGrid grid)
    : width_(width), height_(height), grid_(grid) {}

void FillMesh::append(const Vector& a, const Vector& b, Mesh& mesh) const {
    for (const auto& [x0, y0, x1, y1] : pieces(a, b)) {
        if (x1 > -margin) {
            mesh.insert(mesh.end(), {at(x0, y0), at(x1, y1), at(-margin, y1)});
        }
        if (x0 > -margin) {
            mesh.insert(mesh.end(), {at(x0, y0), at(-margin, y1), at(-margin, y0)});
        }
    }
}

FillMesh::Pieces FillMesh::pieces(const Vector& a, const Vector& b) const {
    Pieces result;
    // Ordered by height, so that an edge and its reverse are cut at the same points.
    Vector low = a;
    Vector high = b;
    if (low.y() > high.y()) {
        std::swap(low, high);
    }
    const bool within = low.y() >= -margin && high.y() <= height_ + margin;
    if (!within && !clip_to_slab(low, high, 1, -margin, height_ + margin)) {
        return result;
    }
    // Consecutive pieces of an edge leave no gap in y: their common cut point is snapped once, so
    // exactly one piece crosses each row centre of the edge.
    double borders[] = {-margin, width_ + margin};
    if (low.x() > high.x()) {
        std::swap(borders[0], borders[1]);
    }
    Vector from = low;
    for (const double border : borders) {
        if ((low.x() < border) != (high.x() < border)) {
            const Vector cut = point_on_line(low, high, 0, border);
            add_piece(from, cut, result);
            from = cut;
        }
    }
    add_piece(from, high, result);
    return result;
}

void FillMesh::add_piece(const Vector& from, const Vector& to, Pieces& pieces) const {
    const double left = -margin;
    const double right = width_ + margin;
    const double x0 = grid_.snap(std::clamp(from.x(), left, right));
    const double x1 = grid_.snap(std::clamp(to.x(), left, right));
    const double y0 = grid_.snap(from.y());
    const double y1 = grid_.snap(to.y());

    // A row whose centre an end just touches counts as crossed: the fill rule decides whether it is
    // covered, consistently with the neighbour that ends there.
    const double first_row = std::max(whole_above(std::min(y0, y1) - 0.5), 0.0);
    const double last_row = std::min(whole_below(std::max(y0, y1) - 0.5), height_ - 1.0);
    const bool left_of_all_samples = std::max(x0, x1) < 0.5;
    if (y0 != y1 && first_row <= last_row && !left_of_all_samples) {
        pieces.pieces[pieces.count++] = {x0, y0, x1, y1};
    }
}

}  // namespace nearfield::geometry
