#include <engine/raster/drawn_batch.hpp>

namespace nearfield::raster {
namespace {

/// The vertices of the meshes first, ..., last.
template <class Meshes>
DrawRange range_in(const Meshes& meshes, std::size_t first, std::size_t last) {
    DrawRange range;
    for (std::size_t i = 0; i <= last; ++i) {
        (i < first ? range.first : range.count) += static_cast<std::uint32_t>(meshes[i].size());
    }
    return range;
}

}  // namespace

void TileMeshes::clear() {
    for (geometry::Mesh& mesh : meshes_) {
        mesh.clear();
    }
    for (std::vector<TileVertex>& mesh : tile_meshes_) {
        mesh.clear();
    }
}

DrawRange TileMeshes::range(MeshId first, MeshId last) const {
    return range_in(meshes_, first.index, last.index);
}

DrawRange TileMeshes::range(TileMeshId id) const {
    const auto index = static_cast<std::size_t>(id);
    return range_in(tile_meshes_, index, index);
}

std::uint32_t DrawnBatch::first_group(std::size_t list) const {
    std::size_t first = tiles.size() * sizeof(shaders::TileData) / sizeof(shaders::CellGroup);
    for (std::size_t i = 0; i < list; ++i) {
        first += groups[i].size();
    }
    return static_cast<std::uint32_t>(first);
}

void DrawnBatch::clear() {
    TileBatch::clear();
    lists.clear();
    meshes.clear();
    extent = {};
    for (std::vector<shaders::CellGroup>& list : groups) {
        list.clear();
    }
    for (std::vector<device_input::OverlapTile>& drawn : overlaps) {
        drawn.clear();
    }
    largest.clear();
    watched.clear();
    field_points.clear();
}

}  // namespace nearfield::raster
