#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/asked_points.hpp>
#include <engine/plan/compute_batch_builder.hpp>
#include <engine/plan/overlap_boundary.hpp>
#include <engine/plan/tile_batch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

namespace nearfield::plan {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

// Reach of a point's reconstruction outside its block, in cells: a sample two cells away.
constexpr double points_reach = 2.5 * std::numbers::sqrt2;

constexpr double margin_in_cells = uniqueness_margin / std::numbers::sqrt2;

std::uint32_t words_for(std::uint32_t cells) {
    return (cells + 31) / 32;
}

/// A snapped coordinate in steps: a whole number, since steps are a power of two.
std::int32_t steps(double coordinate, const geometry::SubpixelGrid& grid) {
    return static_cast<std::int32_t>(coordinate * grid.steps);
}

void require_few(std::uint32_t segments) {
    if (segments > max_block_segments) {
        throw StatusException(
            {StatusCode::too_large,
             std::to_string(segments) +
                 " edges can be nearest in one block of cells of a distance field; technique "
                 "compute has room for " +
                 std::to_string(max_block_segments)});
    }
}

TileBoundary boundary_of(const PlannedQuery& query, const Tile& tile, SimplifiedShapes& shapes) {
    const double cell = tile.grid.cell;
    return {shapes.get(*query.b, query.budget.simplification, longest_tile_run * cell),
            ToCells(TransformedPolygon(*query.b, query.pose_b), tile.origin(), cell)};
}

EdgeListWriter::Entry words(std::uint32_t first, std::uint32_t second) {
    return {std::bit_cast<float>(first), std::bit_cast<float>(second)};
}

std::uint32_t add_mask(const Tile& tile, ComputeWork& work) {
    const MaskData mask{static_cast<std::uint32_t>(work.mask_words), words_for(tile.width),
                        tile.width, tile.height};
    work.mask_words += std::uint64_t{mask.words_per_row} * mask.height;
    work.masks.push_back(mask);
    return static_cast<std::uint32_t>(work.masks.size() - 1);
}

/// A block of a tile, in cells.
struct BlockPlace {
    std::uint32_t column = 0;
    std::uint32_t row = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Visits the blocks row by row, as BlockEdges numbers them.
template <class Visit>
void for_blocks(const Tile& tile, Visit&& visit) {
    for (std::uint32_t row = 0; row < tile.height; row += block_side) {
        for (std::uint32_t column = 0; column < tile.width; column += block_side) {
            visit(BlockPlace{column, row, std::min(block_side, tile.width - column),
                             std::min(block_side, tile.height - row)});
        }
    }
}

}  // namespace

EdgeListData ComputeBuilder::add_crossing(const TileBoundary& boundary, const Tile& tile,
                                          double slack, TileBatch& batch) {
    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, slack, crossing_);
    return batch.lists.write(crossing_, std::max(tile.width, tile.height) + 4.0);
}

bool ComputeBuilder::add_points_tile(const PlannedQuery& query, const Tile& tile,
                                     SimplifiedShapes& shapes, TileData& data, TileBatch& batch) {
    const TileBoundary boundary = boundary_of(query, tile, shapes);
    const double simplification = query.budget.simplification / tile.grid.cell;
    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, simplification, crossing_);
    finder_.find(boundary, tile.needed, simplification + margin_in_cells, nearest_);
    if (is_left_to_cpu(query, crossing_.size() + nearest_.size())) {
        return false;
    }
    batch.lists.begin_tile(boundary);
    nearest_list_.clear();
    double largest_reach = 0.0;
    for (const NearestEdge& nearest : nearest_) {
        nearest_list_.push_back(nearest.edge);
        largest_reach = std::max(largest_reach, nearest.reach());
    }
    data.nearest = batch.lists.write(nearest_list_,
                                     std::max(tile.width, tile.height) + 2.0 * largest_reach + 4.0);
    data.crossing = batch.lists.write(crossing_, std::max(tile.width, tile.height) + 4.0);
    data.margin = static_cast<float>(margin_in_cells);
    data.outside = query.points().outside ? 1 : 0;
    return true;
}

void ComputeBuilder::add_fill(const Tile& tile, std::uint32_t mask, ComputeWork& work) const {
    const geometry::FillMesh fill(tile.width, tile.height, grid_);
    SparseCheckpoint<256> checkpoint;
    for (const TileEdge& edge : crossing_) {
        checkpoint.step();
        for (const auto& [x0, y0, x1, y1] : fill.pieces(edge.a, edge.b)) {
            work.edges.push_back(
                {steps(x0, grid_), steps(y0, grid_), steps(x1, grid_), steps(y1, grid_), mask});
        }
    }
    const MaskData& data = work.masks[mask];
    for (std::uint32_t row = 0; row < data.height; ++row) {
        work.rows.push_back({data.first_word + row * data.words_per_row, data.words_per_row});
    }
}

void ComputeBuilder::add_field_tile(const PlannedQuery& query, const Tile& tile,
                                    const FieldTile& field, SimplifiedShapes& shapes,
                                    TileBatch& batch) {
    ComputeWork& work = batch.compute;
    const TileBoundary boundary = boundary_of(query, tile, shapes);
    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, query.budget.simplification / tile.grid.cell,
                   crossing_);
    const std::uint32_t mask = add_mask(tile, work);
    add_fill(tile, mask, work);
    if (query.field().parts.values) {
        add_blocks(boundary, tile, work.masks[mask], field.first_value, work);
    }
    if (query.field().parts.features || query.field().point_count > 0) {
        add_feature_blocks(query, boundary, tile, work.masks[mask], field.first_feature, batch);
    }
}

void ComputeBuilder::add_blocks(const TileBoundary& boundary, const Tile& tile,
                                const MaskData& mask, std::uint32_t first_value,
                                ComputeWork& work) {
    block_edges_.find(boundary, tile.width, tile.height, 0.0);
    std::uint32_t index = 0;
    for_blocks(tile, [&](const BlockPlace& place) {
        BlockData block;
        block.first_segment = static_cast<std::uint32_t>(work.segments.size());
        block_edges_.append(index++, work.segments);
        block.segments = static_cast<std::uint32_t>(work.segments.size()) - block.first_segment;
        require_few(block.segments);
        block.size = place.width | place.height << 16U;
        block.tile_width = tile.width;
        block.value = first_value + place.row * tile.width + place.column;
        block.sign = mask.first_word + place.row * mask.words_per_row + place.column / 32;
        block.first_sign = place.column % 32;
        block.words_per_row = mask.words_per_row;
        work.blocks.push_back(block);
    });
}

void ComputeBuilder::add_feature_blocks(const PlannedQuery& query, const TileBoundary& boundary,
                                        const Tile& tile, const MaskData& mask,
                                        std::uint32_t first_feature, TileBatch& batch) {
    ComputeWork& work = batch.compute;
    const double simplification = query.budget.simplification / tile.grid.cell;
    block_edges_.find(
        boundary, tile.width, tile.height,
        simplification + margin_in_cells + (query.field().point_count > 0 ? points_reach : 0.0));
    work.features = work.features || first_feature != not_asked;
    batch.lists.begin_tile(boundary);
    TileData data;
    data.crossing = batch.lists.write(crossing_, std::max(tile.width, tile.height) + 4.0);
    data.tile_width = tile.width;
    data.mask = mask.first_word;
    data.first_feature = first_feature;
    data.settled = static_cast<float>(std::numbers::sqrt2 / 2.0 + simplification +
                                      2.0 * grid_.largest_move() + 0.01);
    data.margin = static_cast<float>(margin_in_cells);
    const double extent = block_edges_.window() + tile.width + tile.height;
    std::uint32_t index = 0;
    for_blocks(tile, [&](const BlockPlace& place) {
        data.atlas_x = place.column;
        data.atlas_y = place.row;
        data.width = place.width;
        data.height = place.height;
        nearest_list_.clear();
        block_edges_.append(index++, nearest_list_);
        data.nearest = batch.lists.write(nearest_list_, extent);
        work.feature_blocks.push_back(data);
    });
}

void ComputeBuilder::add_field_point(const Tile& tile, std::uint32_t first_block,
                                     const PlannedFieldPoint& point, ComputeWork& work) {
    const Vector local = (point.position - tile.origin()) / tile.grid.cell;
    const auto place = [](double coordinate, std::uint32_t cells) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(coordinate), 0.0, cells - 1.0)) /
               block_side;
    };
    const std::uint32_t column = place(local.x(), tile.width);
    const std::uint32_t row = place(local.y(), tile.height);
    work.points.push_back({static_cast<float>(local.x()), static_cast<float>(local.y())});
    work.points.push_back(words(first_block + row * BlockEdges::along(tile.width) + column,
                                point.column | point.row << 16U));
}

void ComputeBuilder::add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                                  std::uint32_t overlap, bool of_a, TileBatch& batch) const {
    ComputeWork& work = batch.compute;
    // Offset polygons reach a little farther than the offset.
    const double reach = tile.centre().norm() + 2.0 * offset + 2.0;
    SparseCheckpoint<64> checkpoint;
    boundary.for_edges_near(tile.centre(), reach, [&](std::uint32_t i) {
        checkpoint.step();
        const auto polygon = geometry::offset_polygon(boundary.start(i), boundary.end(i), offset,
                                                      tile.width, tile.height, grid_);
        if (!polygon) {
            return;
        }
        MaskPolygonData data;
        for (std::size_t corner = 0; corner < polygon->size(); ++corner) {
            data.corners[2 * corner] = steps((*polygon)[corner].x(), grid_);
            data.corners[2 * corner + 1] = steps((*polygon)[corner].y(), grid_);
        }
        data.overlap = overlap;
        if (of_a) {
            data.run = static_cast<std::uint32_t>(batch.runs.size());
            batch.runs.push_back({boundary.edge(i).first, boundary.edge(i).count});
        }
        (of_a ? work.polygons_a : work.polygons_b).push_back(data);
    });
}

void ComputeBuilder::add_overlap_tile(const PlannedQuery& query, const Tile& tile,
                                      const OverlapTile& asked, SimplifiedShapes& shapes,
                                      TileBatch& batch) {
    ComputeWork& work = batch.compute;
    const double cell = tile.grid.cell;
    const double simplification = query.budget.simplification;
    const auto overlap = static_cast<std::uint32_t>(work.overlaps.size());
    OverlapData data;
    data.tile = asked.tile;
    data.list = asked.lists ? 1 : 0;
    const bool with_runs = (asked.lists || asked.keeps_hits) && asked.part_a == Part::boundary;
    data.first_run = with_runs ? static_cast<std::uint32_t>(work.run_words) : no_runs;
    if (with_runs) {
        work.run_words += std::uint64_t{tile.width} * tile.height;
    }
    const auto add = [&](const geometry::Polygon& polygon, const Pose& pose, Part part, bool of_a) {
        const std::uint32_t mask = add_mask(tile, work);
        const TileBoundary boundary = overlap_boundary(polygon, pose, query.budget, tile, shapes);
        if (part == Part::boundary) {
            add_boundary(boundary, tile, query.budget.offset / cell, overlap, of_a, batch);
        } else {
            crossing_.clear();
            crossing_edges(boundary, tile.width, tile.height, simplification / cell, crossing_);
            add_fill(tile, mask, work);
        }
        return mask;
    };
    data.mask_b = add(*query.b, query.pose_b, asked.part_b, false);
    data.mask_a = add(*query.a, query.pose_a, asked.part_a, true);
    work.overlaps.push_back(data);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        work.overlap_rows.push_back({overlap, row});
    }
}

}  // namespace nearfield::plan
