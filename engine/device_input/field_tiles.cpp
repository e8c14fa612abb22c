#include <engine/device_input/field_tiles.hpp>

namespace nearfield::device_input {
namespace {

std::uint32_t count_along(std::uint32_t cells, std::uint32_t side) {
    return (cells + side - 1) / side;
}

std::uint32_t count_in(const PlannedTile& tile, std::uint32_t side) {
    return count_along(tile.width, side) * count_along(tile.height, side);
}

/// Room for segments, for each block; edges that are not simplified are several times as many.
constexpr std::uint32_t segments_per_block = 64;
constexpr std::uint32_t own_edges_per_block = 128;

}  // namespace

void FieldWork::clear() {
    tiles.clear();
    points.clear();
    regions = quarters = blocks = rows = 0;
    values = features = false;
}

FieldLists::FieldLists(const FieldWork& work, std::uint64_t first_word) {
    const auto place = [&first_word](std::uint64_t words) {
        const std::uint64_t first = (first_word + 3) / 4 * 4;
        first_word = first + words;
        return static_cast<std::uint32_t>(first);
    };
    regions = place(std::uint64_t{shaders::words_of_region} * work.regions);
    quarters = place(std::uint64_t{shaders::words_of_quarter} * work.quarters);
    blocks = place(std::uint64_t{2} * work.blocks);
    room = (work.features ? own_edges_per_block : segments_per_block) * work.blocks;
    segments = place(std::uint64_t{4} * room) / 4;
    numbers = place(work.features ? room : 0);
    crowd = place(std::uint64_t{1} + work.blocks) + 1;
    end = first_word;
}

double bytes_of_field_lists(double cells) {
    constexpr double words_of_block = 5.0 * own_edges_per_block + 3.0 +
                                      shaders::words_of_quarter / 4.0 +
                                      shaders::words_of_region / 16.0;
    return sizeof(std::uint32_t) * words_of_block * cells /
           (shaders::block_side * shaders::block_side);
}

shaders::ShapeInTileData add_field_tile(const PlannedQuery& query, const PlannedTile& tile,
                                        std::uint32_t mask, std::uint32_t first_value,
                                        std::uint32_t first_feature, ShapesInTiles& shapes,
                                        FieldWork& work) {
    shaders::FieldTileData& data = work.tiles.emplace_back();
    // Features are those of the shape's own edges, and so are those of points.
    const bool own_edges = first_feature != shaders::not_asked || query.field().point_count > 0;
    data.b = shapes.see(*query.b, query.pose_b, tile, own_edges ? 0.0 : query.budget.simplification,
                        mask);
    data.margin = static_cast<float>(queries::margin_in_cells);
    data.first_region = work.regions;
    data.first_quarter = work.quarters;
    data.first_block = work.blocks;
    data.first_row = work.rows;
    data.first_value = first_value;
    data.first_feature = first_feature;
    if (first_value != shaders::not_asked || first_feature != shaders::not_asked) {
        work.regions += count_in(tile, shaders::region_side);
        work.quarters += count_in(tile, shaders::quarter_side);
        work.blocks += count_in(tile, shaders::block_side);
        work.rows += tile.height;
        work.values = work.values || first_value != shaders::not_asked;
        work.features = work.features || first_feature != shaders::not_asked;
    }
    return data.b;
}

void add_field_point(const PlannedTile& tile, std::uint32_t index,
                     const queries::PlacedFieldPoint& point, FieldWork& work) {
    const geometry::Vector local = (point.position - tile.origin()) / tile.grid.cell;
    work.points.push_back({{static_cast<float>(local.x()), static_cast<float>(local.y())},
                           index,
                           point.column | point.row << 16U});
}

}  // namespace nearfield::device_input
