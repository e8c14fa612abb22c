#include <engine/plan/tile_triangles.hpp>

#include <algorithm>

namespace nearfield::plan {

std::array<geometry::MeshVertex, 6> rectangle_of(const Tile& tile, std::uint32_t id) {
    const auto left = static_cast<float>(tile.place.x);
    const auto low = static_cast<float>(tile.place.y);
    const auto right = static_cast<float>(tile.place.x + tile.width);
    const auto top = static_cast<float>(tile.place.y + tile.height);
    return {{{left, low, 1.0F, id},
             {right, low, 1.0F, id},
             {right, top, 1.0F, id},
             {left, low, 1.0F, id},
             {right, top, 1.0F, id},
             {left, top, 1.0F, id}}};
}

void add_rectangle(const Tile& tile, geometry::Mesh& mesh) {
    const auto rectangle = rectangle_of(tile, 0);
    mesh.insert(mesh.end(), rectangle.begin(), rectangle.end());
}

void move_to_atlas(const Tile& tile, std::size_t first, geometry::Mesh& mesh) {
    const auto x = static_cast<float>(tile.place.x);
    const auto y = static_cast<float>(tile.place.y);
    for (std::size_t i = first; i < mesh.size(); ++i) {
        mesh[i].x += x;
        mesh[i].y += y;
    }
}

void add_groups(const Tile& tile, std::uint32_t width, std::uint32_t height, CellGroup first,
                std::vector<CellGroup>& groups) {
    for (std::uint32_t row = 0; row < tile.height; row += height) {
        for (std::uint32_t column = 0; column < tile.width; column += width) {
            first.cell = column | row << 16U;
            groups.push_back(first);
        }
    }
}

}  // namespace nearfield::plan
