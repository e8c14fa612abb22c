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

void add_vertex(const Tile& tile, const geometry::MeshVertex& vertex,
                std::vector<TileVertex>& mesh) {
    mesh.push_back(
        {vertex, static_cast<std::uint16_t>(tile.place.x), static_cast<std::uint16_t>(tile.place.y),
         static_cast<std::uint16_t>(tile.width), static_cast<std::uint16_t>(tile.height)});
}

void add_groups(const TileDraw& draw, std::uint32_t width, std::uint32_t height, CellGroup first,
                std::vector<CellGroup>& groups) {
    for (std::uint32_t row = 0; row < draw.height; row += height) {
        for (std::uint32_t column = 0; column < draw.width; column += width) {
            first.cell = column | row << 16U;
            groups.push_back(first);
        }
    }
}

bool is_outside(const Tile& tile, std::span<const geometry::MeshVertex, 3> triangle) {
    const auto [left, right] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return right <= 0.0F || high <= 0.0F || left >= static_cast<float>(tile.width) ||
           low >= static_cast<float>(tile.height);
}

}  // namespace nearfield::plan
