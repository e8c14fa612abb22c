#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/clip.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/overlap_boundary.hpp>
#include <engine/plan/tile_batch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace nearfield::plan {
namespace {

using geometry::Mesh;
using geometry::TransformedPolygon;
using geometry::Vector;

// Minimum cells of a tile for an occlusion query, which costs about as much as searching this many
// samples (docs/performance.md) and gains nothing if some pass.
constexpr std::uint32_t smallest_watched = 128U * 128U;

/// With stencil or depth, only samples of the intersection pass while A is drawn. Where colour
/// decides, all of A passes, so the occlusion query says too little.
bool worth_watching(IntersectionStrategy strategy, const Tile& tile) {
    return (strategy == IntersectionStrategy::stencil || strategy == IntersectionStrategy::depth) &&
           tile.width * tile.height >= smallest_watched;
}

/// The tile at depth 1, as two triangles in the atlas.
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

void add_rectangle(const Tile& tile, Mesh& mesh) {
    const auto rectangle = rectangle_of(tile, 0);
    mesh.insert(mesh.end(), rectangle.begin(), rectangle.end());
}

/// Moves vertices, from `first` on, from cells of a tile to its place in the atlas.
void move_to_atlas(const Tile& tile, std::size_t first, Mesh& mesh) {
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

/// Appends groups of width x height cells that cover a tile; `first` describes the low one.
void add_groups(const TileDraw& draw, std::uint32_t width, std::uint32_t height, CellGroup first,
                std::vector<CellGroup>& groups) {
    for (std::uint32_t row = 0; row < draw.height; row += height) {
        for (std::uint32_t column = 0; column < draw.width; column += width) {
            first.cell = column | row << 16U;
            groups.push_back(first);
        }
    }
}

/// Whether a triangle, in cells of a tile, lies on one side of it.
bool is_outside(const Tile& tile, std::span<const geometry::MeshVertex, 3> triangle) {
    const auto [left, right] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return right <= 0.0F || high <= 0.0F || left >= static_cast<float>(tile.width) ||
           low >= static_cast<float>(tile.height);
}

/// The part of an edge within `border` cells of a tile; far ends would only degrade the raster's
/// precision.
TileEdge part_near(const TileEdge& edge, const Tile& tile, double border) {
    TileEdge part = edge;
    if (geometry::clip_to_slab(part.a, part.b, 0, -border, tile.width + border) &&
        geometry::clip_to_slab(part.a, part.b, 1, -border, tile.height + border)) {
        return part;
    }
    return edge;
}

/// Sets which part of each shape takes part, and whether samples are listed.
void describe_overlap(const IntersectionQuery& query, const Tile& tile, TileDraw& draw,
                      TileBatch& round) {
    const bool volumes = query.kind == IntersectionKind::volume_volume;
    draw.part_a = volumes ? Part::volume : Part::boundary;
    draw.part_b = query.kind == IntersectionKind::boundary_boundary ? Part::boundary : Part::volume;
    draw.list = query.records;
    round.listed_cells += draw.list ? std::uint64_t{tile.width} * tile.height : 0;
    if (query.resident && query.resident_samples) {
        round.keeps_hits = true;
        draw.first_hit = round.hit_words;
        // The compute technique keeps hits in its masks.
        round.hit_words += round.by_compute ? 0 : tile.width * tile.height;
    }
}

}  // namespace

std::uint32_t TileBatch::first_group(std::size_t list) const {
    std::size_t first = tiles.size() * sizeof(TileData) / sizeof(CellGroup);
    for (std::size_t i = 0; i < list; ++i) {
        first += groups[i].size();
    }
    return static_cast<std::uint32_t>(first);
}

void TileBatch::clear() {
    meshes.clear();
    extent = {};
    tiles.clear();
    for (std::vector<CellGroup>& list : groups) {
        list.clear();
    }
    lists.clear();
    points.clear();
    point_index.clear();
    distance_draws.clear();
    for (std::vector<TileDraw>& draws : overlap_draws) {
        draws.clear();
    }
    tile_index.clear();
    runs.clear();
    field_points.clear();
    field_point_index.clear();
    field_point_runs.clear();
    field_words = 0;
    field_read_back.clear();
    resident = false;
    by_compute = false;
    compute.clear();
    watched.clear();
    listed_cells = 0;
    hit_words = 0;
    keeps_hits = false;
}

void TileBatchBuilder::build(const Plan& plan, std::uint32_t number, TileBatch& round) {
    round.clear();
    round.by_compute = number >= plan.raster_tile_batches;
    select_watched(plan, number);
    tile_of_plan_.resize(plan.tiles.size());
    first_block_.resize(plan.tiles.size());
    for (const std::uint32_t i : plan.tiles_by_batch.of(number)) {
        checkpoint();
        const Tile& tile = plan.tiles[i];
        TileDraw draw;
        draw.tile = static_cast<std::uint32_t>(round.tiles.size());
        draw.x = tile.place.x;
        draw.y = tile.place.y;
        draw.width = tile.width;
        draw.height = tile.height;
        tile_of_plan_[i] = draw.tile;
        first_block_[i] = static_cast<std::uint32_t>(round.compute.feature_blocks.size());
        round.tile_index.push_back(i);
        round.resident =
            round.resident || (tile.kind != TileKind::overlap && plan.queries[tile.query].resident);
        TileData& data = round.tiles.emplace_back();
        data.atlas_x = tile.place.x;
        data.atlas_y = tile.place.y;
        data.width = tile.width;
        data.height = tile.height;
        round.extent.width = std::max(round.extent.width, tile.place.x + tile.width);
        round.extent.height = std::max(round.extent.height, tile.place.y + tile.height);
        if (round.by_compute) {
            add_compute_tile(plan.queries[tile.query], tile, draw, round);
        } else {
            add_drawn_tile(plan.queries[tile.query], tile, draw, round);
        }
    }
    add_points(plan, number, round);
    add_field_points(plan, number, round);
}

/// Selects the largest tiles that are worth an occlusion query.
void TileBatchBuilder::select_watched(const Plan& plan, std::uint32_t number) {
    watched_.clear();
    if (number >= plan.raster_tile_batches) {
        return;
    }
    const auto is_larger = [&](std::uint32_t i, std::uint32_t j) {
        return plan.tiles[i].width * plan.tiles[i].height >
               plan.tiles[j].width * plan.tiles[j].height;
    };
    for (const std::uint32_t i : plan.tiles_by_batch.of(number)) {
        const Tile& tile = plan.tiles[i];
        if (tile.kind != TileKind::overlap) {
            continue;
        }
        const auto& query = std::get<IntersectionQuery>(*plan.queries[tile.query].query);
        if (worth_watching(query.strategy, tile)) {
            watched_.insert(std::upper_bound(watched_.begin(), watched_.end(), i, is_larger), i);
            watched_.resize(std::min<std::size_t>(watched_.size(), max_watched));
        }
    }
}

void TileBatchBuilder::add_drawn_tile(const PlannedQuery& query, const Tile& tile, TileDraw& draw,
                                      TileBatch& round) {
    if (tile.kind == TileKind::overlap) {
        add_overlap_tile(query, tile, draw, round);
    } else {
        add_distance_tile(query, tile, draw, round);
    }
}

void TileBatchBuilder::add_compute_tile(const PlannedQuery& query, const Tile& tile, TileDraw& draw,
                                        TileBatch& round) {
    switch (tile.kind) {
        case TileKind::points:
            compute_.add_points_tile(query, tile, shapes_, round.tiles[draw.tile], round);
            break;
        case TileKind::field:
            nearest_.clear();
            add_field_output(query, tile, draw, round);
            compute_.add_field_tile(query, tile, draw, shapes_, round);
            round.distance_draws.push_back(draw);
            break;
        case TileKind::overlap:
            describe_overlap(std::get<IntersectionQuery>(*query.query), tile, draw, round);
            compute_.add_overlap_tile(query, tile, draw, shapes_, round);
            break;
    }
}

void TileBatchBuilder::add_fill(const std::vector<TileEdge>& edges, const Tile& tile,
                                Mesh& mesh) const {
    const std::size_t first = mesh.size();
    const geometry::FillMesh fill(tile.width, tile.height, grid_);
    SparseCheckpoint<256> checkpoint;
    for (const TileEdge& edge : edges) {
        checkpoint.step();
        fill.append(edge.a, edge.b, mesh);
    }
    move_to_atlas(tile, first, mesh);
}

const NearestEdge* TileBatchBuilder::find_nearest(std::uint32_t simplified,
                                                  std::uint32_t hint) const {
    if (hint > 0 && nearest_[hint - 1].edge.simplified == simplified) {
        return &nearest_[hint - 1];
    }
    const auto found = std::lower_bound(
        nearest_.begin(), nearest_.end(), simplified,
        [](const NearestEdge& edge, std::uint32_t index) { return edge.edge.simplified < index; });
    return found != nearest_.end() && found->edge.simplified == simplified ? &*found : nullptr;
}

void TileBatchBuilder::add_distance_mesh(const TileBoundary& boundary, const Tile& tile,
                                         const geometry::DistanceMeshOptions& options,
                                         std::vector<TileVertex>& mesh) {
    distance_mesh_.clear();
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t i = 0; i < nearest_.size(); ++i) {
        checkpoint.step();
        const NearestEdge& nearest = nearest_[i];
        const TileEdge& edge = nearest.edge;
        const TileEdge part = part_near(edge, tile, nearest.reach() + 1.0);
        geometry::append_tent(part.a, part.b, {nearest.reach_left, nearest.reach_right}, i, options,
                              distance_mesh_);
        // Where a vertex is nearest, both its edges are equally near: it needs a cone only if both
        // are in the list, and only as far out as both can be nearest.
        if (const NearestEdge* const before =
                find_nearest(boundary.simplified().previous(edge.simplified), i)) {
            const double reach = std::min(nearest.reach(), before->reach());
            geometry::append_cone_sector(before->edge.a, edge.a, edge.b, reach, i, options,
                                         distance_mesh_);
        }
    }
    float farthest = 1.0F;
    for (const geometry::MeshVertex& vertex : distance_mesh_) {
        farthest = std::max(farthest, vertex.distance);
    }
    const float depth_scale = 1.0F / (farthest * 1.0001F);
    const auto x = static_cast<float>(tile.place.x);
    const auto y = static_cast<float>(tile.place.y);
    for (std::size_t i = 0; i < distance_mesh_.size(); i += 3) {
        const std::span<const geometry::MeshVertex, 3> triangle(&distance_mesh_[i], 3);
        if (!is_outside(tile, triangle)) {
            for (const geometry::MeshVertex& vertex : triangle) {
                add_vertex(tile,
                           {vertex.x + x, vertex.y + y, vertex.distance * depth_scale, vertex.id},
                           mesh);
            }
        }
    }
}

void TileBatchBuilder::add_field_output(const PlannedQuery& query, const Tile& tile, TileDraw& draw,
                                        TileBatch& round) const {
    draw.field = true;
    draw.sign = std::get<DistanceFieldQuery>(*query.query).sign;
    if (draw.sign == SignEncoding::feature_bit && nearest_.size() >= max_signed_features) {
        throw StatusException(
            {StatusCode::too_large,
             std::to_string(nearest_.size()) +
                 " edges can be nearest in one tile of a distance field; an id that "
                 "carries the sign in its top bit has room for " +
                 std::to_string(max_signed_features)});
    }
    const std::uint64_t cells = std::uint64_t{tile.width} * tile.height;
    if (query.field.values) {
        draw.first_value = add_field_words(cells, query.field.host_values, round);
    }
    if (query.field.blended) {
        for (const geometry::MeshVertex& vertex : rectangle_of(tile, draw.first_value)) {
            add_vertex(tile, vertex, round.meshes[TileMeshId::gradients]);
        }
    }
    if (query.field.features) {
        draw.first_feature = add_field_words(cells, query.field.host_features, round);
    }
    if (query.field.gradients) {
        draw.first_gradient = add_field_words(2 * cells, true, round);
    }
}

std::uint32_t TileBatchBuilder::add_field_words(std::uint64_t count, bool for_host,
                                                TileBatch& round) {
    const WordRange added{static_cast<std::uint32_t>(round.field_words),
                          static_cast<std::uint32_t>(count)};
    round.field_words += count;
    if (for_host) {
        std::vector<WordRange>& ranges = round.field_read_back;
        if (!ranges.empty() && ranges.back().first + ranges.back().count == added.first) {
            ranges.back().count += added.count;
        } else {
            ranges.push_back(added);
        }
    }
    return added.first;
}

void TileBatchBuilder::add_distance_tile(const PlannedQuery& query, const Tile& tile, TileDraw draw,
                                         TileBatch& round) {
    const double cell = tile.grid.cell;
    const ErrorBudget& budget = query.budget;
    const TileBoundary boundary(
        shapes_.get(*query.b, budget.simplification, longest_tile_run * cell),
        ToCells(TransformedPolygon(*query.b, query.pose_b), tile.origin(), cell));
    const double simplification = budget.simplification / cell;
    double mesh_error = budget.mesh / cell;
    if (tile.kind == TileKind::points) {
        // The resolve pass searches from the drawn feature for the nearest one; far from the
        // boundary a mesh as fine as near to it would have far too many triangles.
        mesh_error = std::max(mesh_error, boundary.distance(tile.centre()) / 16.0);
    }

    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, simplification, crossing_);
    finder_.find(boundary, tile.needed, simplification + mesh_error, nearest_);
    nearest_list_.clear();
    double largest_reach = 0.0;
    for (const NearestEdge& nearest : nearest_) {
        nearest_list_.push_back(nearest.edge);
        largest_reach = std::max(largest_reach, nearest.reach());
    }
    if (tile.kind == TileKind::field) {
        add_field_output(query, tile, draw, round);
        if (draw.first_value != not_asked || draw.first_feature != not_asked) {
            add_groups(draw, field_group_side, field_group_side,
                       {draw.tile, 0, draw.first_value, draw.first_feature},
                       round.groups[group_list(draw.sign)]);
        }
    }
    add_rectangle(tile, round.meshes[rectangles_of(draw.sign)]);
    add_fill(crossing_, tile, round.meshes[fills_of(draw.sign)]);
    add_distance_mesh(
        boundary, tile, {mesh_error, grid_, {Vector::Zero(), Vector(tile.width, tile.height)}},
        round.meshes[draw.sign == SignEncoding::feature_bit ? TileMeshId::signed_distances
                                                            : TileMeshId::distances]);

    TileData& data = round.tiles[draw.tile];
    round.lists.begin_tile(boundary);
    const double side = std::max(tile.width, tile.height);
    data.nearest = round.lists.write(nearest_list_, side + 2.0 * largest_reach + 4.0);
    data.crossing = round.lists.write(crossing_, side + 4.0);
    // The cell's centre is up to half a diagonal away; simplification, the mesh and snapping change
    // its distance and the fill; the rest is for rounding.
    data.settled = static_cast<float>(std::numbers::sqrt2 / 2.0 + simplification + mesh_error +
                                      2.0 * grid_.largest_move() + 0.01);
    data.margin = static_cast<float>(uniqueness_margin / std::numbers::sqrt2);
    data.outside = query.outside ? 1 : 0;
    round.distance_draws.push_back(draw);
}

void TileBatchBuilder::add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                                    std::vector<EdgeRun>* runs, Mesh& mesh) const {
    const std::size_t first = mesh.size();
    SparseCheckpoint<64> checkpoint;
    boundary.for_offset_edges(tile.width, tile.height, offset, [&](std::uint32_t i) {
        checkpoint.step();
        const std::size_t before = mesh.size();
        const auto run = runs != nullptr ? static_cast<std::uint32_t>(runs->size()) : 0U;
        if (run == max_runs) {
            throw StatusException(
                {StatusCode::too_large, "the boundaries of one round have more than " +
                                            std::to_string(max_runs) +
                                            " edges; use a larger tolerance"});
        }
        geometry::append_offset_polygon(boundary.start(i), boundary.end(i), offset, tile.width,
                                        tile.height, grid_, run << run_shift, mesh);
        if (runs != nullptr && mesh.size() > before) {
            runs->push_back({boundary.edge(i).first, boundary.edge(i).count});
        }
    });
    move_to_atlas(tile, first, mesh);
}

void TileBatchBuilder::add_overlap_tile(const PlannedQuery& query, const Tile& tile, TileDraw draw,
                                        TileBatch& round) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    describe_overlap(asked, tile, draw, round);
    add_groups(draw, overlap_group_width, overlap_group_height,
               {draw.tile, 0, draw.list ? 1U : 0U, draw.first_hit},
               round.groups[group_list(asked.strategy)]);
    add_rectangle(tile, round.meshes[overlaps_of(asked.strategy, OverlapStep::clear)]);
    add_overlap_b(query, tile, draw, round);
    add_overlap_a(query, tile, draw, round);
    round.overlap_draws[static_cast<std::size_t>(asked.strategy)].push_back(draw);
}

void TileBatchBuilder::add_volume(const TileBoundary& boundary, const Tile& tile, double slack,
                                  Mesh& parity, Mesh& rectangles) {
    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, slack, crossing_);
    add_fill(crossing_, tile, parity);
    add_rectangle(tile, rectangles);
}

void TileBatchBuilder::add_overlap_b(const PlannedQuery& query, const Tile& tile,
                                     const TileDraw& draw, TileBatch& round) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return round.meshes[overlaps_of(strategy, step)];
    };
    const double cell = tile.grid.cell;
    const TileBoundary boundary =
        overlap_boundary(*query.b, query.pose_b, query.budget, tile, shapes_);
    if (draw.part_b == Part::boundary) {
        add_boundary(boundary, tile, query.budget.offset / cell, nullptr,
                     mesh(OverlapStep::boundary_b));
    } else {
        add_volume(boundary, tile, query.budget.simplification / cell, mesh(OverlapStep::parity_b),
                   mesh(OverlapStep::volume_b));
    }
}

void TileBatchBuilder::add_overlap_a(const PlannedQuery& query, const Tile& tile,
                                     const TileDraw& draw, TileBatch& round) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return round.meshes[overlaps_of(strategy, step)];
    };
    const bool is_watched =
        std::find(watched_.begin(), watched_.end(), round.tile_index[draw.tile]) != watched_.end();
    Mesh& drawn = is_watched                      ? mesh(OverlapStep::watched_a)
                  : draw.part_a == Part::boundary ? mesh(OverlapStep::boundary_a)
                                                  : mesh(OverlapStep::volume_a);
    const auto first = static_cast<std::uint32_t>(drawn.size());
    const double cell = tile.grid.cell;
    const TileBoundary boundary =
        overlap_boundary(*query.a, query.pose_a, query.budget, tile, shapes_);
    if (draw.part_a == Part::boundary) {
        add_boundary(boundary, tile, query.budget.offset / cell, &round.runs, drawn);
    } else {
        add_volume(boundary, tile, query.budget.simplification / cell, mesh(OverlapStep::parity_a),
                   drawn);
    }
    if (is_watched) {
        const auto count = static_cast<std::uint32_t>(drawn.size()) - first;
        round.watched.push_back({draw.tile, strategy, draw.part_a, {first, count}});
    }
}

void TileBatchBuilder::add_points(const Plan& plan, std::uint32_t number, TileBatch& round) {
    const PlannedQuery* query = nullptr;
    std::optional<TransformedPolygon> a;
    for (const std::uint32_t i : plan.points_by_batch.of(number)) {
        const PlannedPoint& point = plan.points[i];
        const Tile& tile = plan.tiles[point.tile];
        if (query != &plan.queries[tile.query]) {
            query = &plan.queries[tile.query];
            a.emplace(*query->a, query->pose_a);
        }
        const Vector local = (position(*a, point.point) - tile.origin()) / tile.grid.cell;
        round.points.push_back({static_cast<float>(local.x()), static_cast<float>(local.y()),
                                tile_of_plan_[point.tile], 0});
        round.point_index.push_back(i);
    }
}

void TileBatchBuilder::add_field_points(const Plan& plan, std::uint32_t number, TileBatch& round) {
    for (const std::uint32_t i : plan.field_points_by_batch.of(number)) {
        const PlannedFieldPoint& point = plan.field_points[i];
        const Tile& tile = plan.tiles[point.tile];
        if (round.field_point_runs.empty() || round.field_point_runs.back().query != tile.query) {
            const PlannedQuery& query = plan.queries[tile.query];
            FieldPointRun& run = round.field_point_runs.emplace_back();
            run.first = static_cast<std::uint32_t>(round.field_point_index.size());
            run.query = tile.query;
            run.first_word = static_cast<std::uint32_t>(round.field_words);
            run.sign = std::get<DistanceFieldQuery>(*query.query).sign;
            run.parts = query.field;
        }
        if (round.by_compute) {
            ComputeBuilder::add_field_point(tile, first_block_[point.tile], point, round.compute);
        } else {
            const Vector local = (point.position - tile.origin()) / tile.grid.cell;
            round.field_points.push_back({static_cast<float>(local.x()),
                                          static_cast<float>(local.y()), tile_of_plan_[point.tile],
                                          point.column | point.row << 16U});
        }
        round.field_point_index.push_back(i);
        FieldPointRun& run = round.field_point_runs.back();
        ++run.count;
        static_cast<void>(add_field_words(run.parts.words_per_point, true, round));
    }
}

}  // namespace nearfield::plan
