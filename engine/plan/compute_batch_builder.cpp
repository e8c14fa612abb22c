#include <engine/base/interruption.hpp>
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

namespace nearfield::plan {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

constexpr double margin_in_cells = uniqueness_margin / std::numbers::sqrt2;

std::uint32_t words_for(std::uint32_t cells) {
    return (cells + 31) / 32;
}

/// A snapped coordinate in steps: a whole number, since steps are a power of two.
std::int32_t steps(double coordinate, const geometry::SubpixelGrid& grid) {
    return static_cast<std::int32_t>(coordinate * grid.steps);
}

TileBoundary boundary_of(const PlannedQuery& query, const Tile& tile, SimplifiedShapes& shapes) {
    const double cell = tile.grid.cell;
    return {shapes.get(*query.b, query.budget.simplification, longest_tile_run * cell),
            ToCells(TransformedPolygon(*query.b, query.pose_b), tile.origin(), cell)};
}

std::uint32_t add_mask(const Tile& tile, ComputeWork& work) {
    const MaskData mask{static_cast<std::uint32_t>(work.mask_words), words_for(tile.width),
                        tile.width, tile.height};
    work.mask_words += std::uint64_t{mask.words_per_row} * mask.height;
    work.masks.push_back(mask);
    return static_cast<std::uint32_t>(work.masks.size() - 1);
}

void add_rows(const MaskData& mask, ComputeWork& work) {
    for (std::uint32_t row = 0; row < mask.height; ++row) {
        work.rows.push_back({mask.first_word + row * mask.words_per_row, mask.words_per_row});
    }
}

}  // namespace

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
    add_rows(work.masks[mask], work);
}

void ComputeBuilder::add_field_tile(const PlannedQuery& query, const Tile& tile,
                                    const FieldTile& field, ComputeWork& work) {
    std::uint32_t first_word = 0;
    if (field.first_value != not_asked || field.first_feature != not_asked) {
        const MaskData& mask = work.masks[add_mask(tile, work)];
        add_rows(mask, work);
        first_word = mask.first_word;
    }
    field_tiles_.add(query, tile, first_word, field.first_value, field.first_feature, work.fields);
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
