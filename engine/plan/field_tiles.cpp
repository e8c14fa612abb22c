#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/field_tiles.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::plan {
namespace {

using geometry::Vector;

std::uint32_t count_along(std::uint32_t cells, std::uint32_t side) {
    return (cells + side - 1) / side;
}

std::uint32_t count_in(const Tile& tile, std::uint32_t side) {
    return count_along(tile.width, side) * count_along(tile.height, side);
}

/// Room for segments, for each block; edges that are not simplified are several times as many.
constexpr std::uint32_t segments_per_block = 64;
constexpr std::uint32_t own_edges_per_block = 128;

/// Two floats whose sum is a number to about 48 bits.
void split(const Vector& numbers, vec2& high, vec2& low) {
    high = {static_cast<float>(numbers.x()), static_cast<float>(numbers.y())};
    low = {static_cast<float>(numbers.x() - static_cast<double>(high.x)),
           static_cast<float>(numbers.y() - static_cast<double>(high.y))};
}

}  // namespace

void FieldWork::clear() {
    tiles.clear();
    points.clear();
    shapes = nullptr;
    chunks = regions = quarters = blocks = 0;
    values = features = false;
}

FieldLists::FieldLists(const FieldWork& work, std::uint64_t first_word) {
    const auto place = [&first_word](std::uint64_t words) {
        const std::uint64_t first = (first_word + 3) / 4 * 4;
        first_word = first + words;
        return static_cast<std::uint32_t>(first);
    };
    regions = place(std::uint64_t{words_of_region} * work.regions);
    quarters = place(std::uint64_t{words_of_quarter} * work.quarters);
    blocks = place(std::uint64_t{2} * work.blocks);
    room = (work.features ? own_edges_per_block : segments_per_block) * work.blocks;
    segments = place(std::uint64_t{4} * room) / 4;
    numbers = place(work.features ? room : 0);
    crowd = place(std::uint64_t{1} + work.blocks) + 1;
    end = first_word;
}

double bytes_of_field_lists(double cells) {
    constexpr double words_of_block =
        5.0 * own_edges_per_block + 3.0 + words_of_quarter / 4.0 + words_of_region / 16.0;
    return sizeof(std::uint32_t) * words_of_block * cells / (block_side * block_side);
}

void FieldTiles::add(const PlannedQuery& query, const Tile& tile, std::uint32_t mask,
                     std::uint32_t first_value, std::uint32_t first_feature, FieldWork& work) {
    if (!is_begun_) {
        shapes_.begin_batch();
        is_begun_ = true;
    }
    const geometry::Polygon& b = *query.b;
    const geometry::TransformedPolygon placed(b, query.pose_b);
    const double cell = tile.grid.cell;
    const Vector axis = unit_length_of(b) / cell * placed.rotation().col(0);
    const Vector offset = (placed.translation() - tile.origin()) / cell;
    FieldTileData& data = work.tiles.emplace_back();
    split(axis, data.axis, data.axis_low);
    split(offset, data.offset, data.offset_low);
    // Features are those of the shape's own edges, and so are those of points.
    const bool own_edges = first_feature != not_asked || query.field().point_count > 0;
    data.shape = shapes_.place_for_field(b, own_edges ? 0.0 : query.budget.simplification);
    data.size = tile.width | tile.height << 16U;
    data.mask = mask;
    // Where single precision selects edges it errs by at most 2^-20 of the coordinates.
    const double extent = 2.0 * b.radius() / cell + offset.norm() + tile.width + tile.height;
    const double margin = uniqueness_margin / std::numbers::sqrt2;
    data.slack = rounded_up(2.0 * (std::ldexp(extent, -20) + margin + 0.01));
    data.margin = static_cast<float>(margin);
    data.first_chunk = work.chunks;
    data.first_region = work.regions;
    data.first_quarter = work.quarters;
    data.first_block = work.blocks;
    data.first_value = first_value;
    data.first_feature = first_feature;
    work.shapes = &shapes_;
    if (first_value == not_asked && first_feature == not_asked) {
        return;
    }
    work.chunks += shapes_.units()[data.shape][0];
    work.regions += count_in(tile, region_side);
    work.quarters += count_in(tile, quarter_side);
    work.blocks += count_in(tile, block_side);
    work.values = work.values || first_value != not_asked;
    work.features = work.features || first_feature != not_asked;
}

void FieldTiles::add_point(const Tile& tile, std::uint32_t index, const PlannedFieldPoint& point,
                           FieldWork& work) {
    const Vector local = (point.position - tile.origin()) / tile.grid.cell;
    work.points.push_back({{static_cast<float>(local.x()), static_cast<float>(local.y())},
                           index,
                           point.column | point.row << 16U});
}

}  // namespace nearfield::plan
