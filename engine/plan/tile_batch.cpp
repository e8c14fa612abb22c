#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/clip.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/plan/asked_points.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/plan/tile_triangles.hpp>

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

}  // namespace

std::uint32_t TileBatch::first_group(std::size_t list) const {
    std::size_t first = tiles.size() * sizeof(TileData) / sizeof(CellGroup);
    for (std::size_t i = 0; i < list; ++i) {
        first += raster.groups[i].size();
    }
    return static_cast<std::uint32_t>(first);
}

void RasterWork::clear() {
    meshes.clear();
    extent = {};
    for (std::vector<CellGroup>& list : groups) {
        list.clear();
    }
    for (std::vector<OverlapTile>& drawn : overlaps) {
        drawn.clear();
    }
    watched.clear();
    field_points.clear();
}

void TileBatch::clear() {
    tiles.clear();
    tile_index.clear();
    lists.clear();
    points.clear();
    point_index.clear();
    runs.clear();
    listed_cells = 0;
    keeps_hits = false;
    field_tiles.clear();
    field_point_index.clear();
    field_point_runs.clear();
    field_words = 0;
    field_read_back.clear();
    resident = false;
    by_compute = false;
    raster.clear();
    compute.clear();
}

void TileBatchBuilder::build(const Plan& plan, std::uint32_t number, TileBatch& batch) {
    batch.clear();
    batch.by_compute = number >= plan.raster_tile_batches;
    select_watched(plan, number);
    tile_of_plan_.resize(plan.tiles.size());
    field_tile_of_plan_.resize(plan.tiles.size());
    left_to_cpu_.clear();
    for (const std::uint32_t i : plan.tiles_by_batch.of(number)) {
        checkpoint();
        const Tile& tile = plan.tiles[i];
        const PlannedQuery& query = plan.queries[tile.query];
        tile_of_plan_[i] = static_cast<std::uint32_t>(batch.tiles.size());
        field_tile_of_plan_[i] = static_cast<std::uint32_t>(batch.compute.fields.tiles.size());
        batch.tile_index.push_back(i);
        left_to_cpu_.push_back(false);
        batch.resident = batch.resident || (tile.kind == TileKind::field && query.on_device);
        TileData& data = batch.tiles.emplace_back();
        data.atlas_x = tile.place.x;
        data.atlas_y = tile.place.y;
        data.width = tile.width;
        data.height = tile.height;
        if (batch.by_compute) {
            add_compute_tile(query, tile, batch);
        } else {
            add_drawn_tile(query, tile, batch);
        }
    }
    add_points(plan, number, batch);
    add_field_points(plan, number, batch);
}

void TileBatchBuilder::add_drawn_tile(const PlannedQuery& query, const Tile& tile,
                                      TileBatch& batch) {
    TileSize& extent = batch.raster.extent;
    extent.width = std::max(extent.width, tile.place.x + tile.width);
    extent.height = std::max(extent.height, tile.place.y + tile.height);
    if (tile.kind == TileKind::overlap) {
        add_overlap_tile(query, tile, batch);
    } else {
        add_distance_tile(query, tile, batch);
    }
}

void TileBatchBuilder::add_compute_tile(const PlannedQuery& query, const Tile& tile,
                                        TileBatch& batch) {
    if (tile.kind == TileKind::field) {
        compute_.add_field_tile(query, tile, add_field_tile(query, tile, batch), batch.compute);
    } else {
        compute_.add_overlap_tile(
            query, tile, describe_overlap(std::get<IntersectionQuery>(*query.query), tile, batch),
            batch.compute);
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
                                         double error, std::vector<TileVertex>& mesh) {
    distance_mesh_.begin({error, grid_, {Vector::Zero(), Vector(tile.width, tile.height)}});
    tangents_.clear();
    for (const NearestEdge& nearest : nearest_) {
        tangents_.push_back(geometry::tangent(nearest.edge.a, nearest.edge.b));
    }
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t i = 0; i < nearest_.size(); ++i) {
        checkpoint.step();
        const NearestEdge& nearest = nearest_[i];
        const TileEdge& edge = nearest.edge;
        const TileEdge part = part_near(edge, tile, nearest.reach() + 1.0);
        const bool is_whole = part.a == edge.a && part.b == edge.b;
        distance_mesh_.add_tent(part.a, part.b,
                                is_whole ? tangents_[i] : geometry::tangent(part.a, part.b),
                                {nearest.reach_left, nearest.reach_right}, i);
        // Where a vertex is nearest, both its edges are equally near: it needs a cone only if both
        // are in the list, and only as far out as both can be nearest.
        if (const NearestEdge* const before =
                find_nearest(boundary.simplified().previous(edge.simplified), i)) {
            distance_mesh_.add_cone_sector(
                tangents_[static_cast<std::size_t>(before - &nearest_[0])], edge.a, tangents_[i],
                std::min(nearest.reach(), before->reach()), i);
        }
    }
    const float depth_scale = 1.0F / (std::max(1.0F, distance_mesh_.place()) * 1.0001F);
    const auto x = static_cast<float>(tile.place.x);
    const auto y = static_cast<float>(tile.place.y);
    const std::size_t before = mesh.size();
    mesh.resize(before + 3 * distance_mesh_.max_triangles());
    TileVertex* next = mesh.data() + before;
    distance_mesh_.for_each_triangle([&](const std::array<geometry::MeshVertex, 3>& triangle) {
        for (const geometry::MeshVertex& vertex : triangle) {
            *next++ = in_tile(
                tile, {vertex.x + x, vertex.y + y, vertex.distance * depth_scale, vertex.id});
        }
    });
    mesh.resize(static_cast<std::size_t>(next - mesh.data()));
}

const FieldTile& TileBatchBuilder::add_field_tile(const PlannedQuery& query, const Tile& tile,
                                                  TileBatch& batch) {
    const FieldParts& parts = query.field().parts;
    const std::uint64_t cells = std::uint64_t{tile.width} * tile.height;
    FieldTile& field = batch.field_tiles.emplace_back();
    field.tile = static_cast<std::uint32_t>(batch.tiles.size() - 1);
    field.sign = std::get<DistanceFieldQuery>(*query.query).sign;
    if (parts.values) {
        field.first_value = add_field_words(cells, parts.host_values, batch);
    }
    if (parts.features) {
        field.first_feature = add_field_words(cells, parts.host_features, batch);
    }
    if (parts.gradients) {
        field.first_gradient = add_field_words(2 * cells, true, batch);
    }
    return field;
}

void TileBatchBuilder::add_drawn_field(const PlannedQuery& query, const Tile& tile,
                                       TileBatch& batch) const {
    const FieldTile& field = add_field_tile(query, tile, batch);
    if (field.sign == SignEncoding::feature_bit && nearest_.size() >= max_signed_features) {
        throw StatusException(
            {StatusCode::too_large,
             std::to_string(nearest_.size()) +
                 " edges can be nearest in one tile of a distance field; an id that "
                 "carries the sign in its top bit has room for " +
                 std::to_string(max_signed_features)});
    }
    RasterWork& work = batch.raster;
    if (query.field().parts.blended) {
        for (const geometry::MeshVertex& vertex : rectangle_of(tile, field.first_value)) {
            work.meshes[TileMeshId::gradients].push_back(in_tile(tile, vertex));
        }
    }
    if (field.first_value != not_asked || field.first_feature != not_asked) {
        add_groups(tile, field_group_side, field_group_side,
                   {field.tile, 0, field.first_value, field.first_feature},
                   work.groups[group_list(field.sign)]);
    }
}

std::uint32_t TileBatchBuilder::add_field_words(std::uint64_t count, bool for_host,
                                                TileBatch& batch) {
    const WordRange added{static_cast<std::uint32_t>(batch.field_words),
                          static_cast<std::uint32_t>(count)};
    batch.field_words += count;
    if (for_host) {
        std::vector<WordRange>& ranges = batch.field_read_back;
        if (!ranges.empty() && ranges.back().first + ranges.back().count == added.first) {
            ranges.back().count += added.count;
        } else {
            ranges.push_back(added);
        }
    }
    return added.first;
}

void TileBatchBuilder::add_distance_tile(const PlannedQuery& query, const Tile& tile,
                                         TileBatch& batch) {
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
    if (tile.kind == TileKind::points &&
        is_left_to_cpu(query, crossing_.size() + nearest_.size())) {
        left_to_cpu_.back() = true;
        return;
    }
    nearest_list_.clear();
    double largest_reach = 0.0;
    for (const NearestEdge& nearest : nearest_) {
        nearest_list_.push_back(nearest.edge);
        largest_reach = std::max(largest_reach, nearest.reach());
    }
    SignEncoding sign = SignEncoding::stencil;
    if (tile.kind == TileKind::field) {
        add_drawn_field(query, tile, batch);
        sign = batch.field_tiles.back().sign;
    }
    TileMeshes& meshes = batch.raster.meshes;
    add_rectangle(tile, meshes[rectangles_of(sign)]);
    add_fill(crossing_, tile, meshes[fills_of(sign)]);
    add_distance_mesh(boundary, tile, mesh_error,
                      meshes[sign == SignEncoding::feature_bit ? TileMeshId::signed_distances
                                                               : TileMeshId::distances]);

    TileData& data = batch.tiles.back();
    batch.lists.begin_tile(boundary);
    const double side = std::max(tile.width, tile.height);
    data.nearest = batch.lists.write(nearest_list_, side + 2.0 * largest_reach + 4.0);
    data.crossing = batch.lists.write(crossing_, side + 4.0);
    // The cell's centre is up to half a diagonal away; simplification, the mesh and snapping change
    // its distance and the fill; the rest is for rounding.
    data.settled = static_cast<float>(std::numbers::sqrt2 / 2.0 + simplification + mesh_error +
                                      2.0 * grid_.largest_move() + 0.01);
    data.margin = static_cast<float>(margin_in_cells);
    data.outside = tile.kind == TileKind::points && query.points().outside ? 1 : 0;
}

void TileBatchBuilder::add_points(const Plan& plan, std::uint32_t number, TileBatch& batch) {
    const PlannedQuery* query = nullptr;
    std::optional<BoundaryPositions> position;
    std::uint32_t index = PlannedPoint::no_tile;  // of the tile below
    Vector origin = Vector::Zero();
    for (const std::uint32_t i : plan.points_by_batch.of(number)) {
        const PlannedPoint& point = plan.points[i];
        if (left_to_cpu_[tile_of_plan_[point.tile]]) {
            continue;
        }
        const Tile& tile = plan.tiles[point.tile];
        if (index != point.tile) {
            index = point.tile;
            origin = tile.origin();
        }
        if (query != &plan.queries[tile.query]) {
            query = &plan.queries[tile.query];
            position.emplace(TransformedPolygon(*query->a, query->pose_a));
        }
        const Vector local = ((*position)(point.point) - origin) / tile.grid.cell;
        batch.points.push_back({{static_cast<float>(local.x()), static_cast<float>(local.y())},
                                tile_of_plan_[index],
                                0});
        batch.point_index.push_back(i);
    }
}

void TileBatchBuilder::add_field_points(const Plan& plan, std::uint32_t number, TileBatch& batch) {
    for (const std::uint32_t i : plan.field_points_by_batch.of(number)) {
        const PlannedFieldPoint& point = plan.field_points[i];
        const Tile& tile = plan.tiles[point.tile];
        if (batch.field_point_runs.empty() || batch.field_point_runs.back().query != tile.query) {
            const PlannedQuery& query = plan.queries[tile.query];
            FieldPointRun& run = batch.field_point_runs.emplace_back();
            run.first = static_cast<std::uint32_t>(batch.field_point_index.size());
            run.query = tile.query;
            run.first_word = static_cast<std::uint32_t>(batch.field_words);
            run.sign = std::get<DistanceFieldQuery>(*query.query).sign;
            run.parts = query.field().parts;
        }
        if (batch.by_compute) {
            plan::add_field_point(tile, field_tile_of_plan_[point.tile], point,
                                  batch.compute.fields);
        } else {
            const Vector local = (point.position - tile.origin()) / tile.grid.cell;
            batch.raster.field_points.push_back(
                {{static_cast<float>(local.x()), static_cast<float>(local.y())},
                 tile_of_plan_[point.tile],
                 point.column | point.row << 16U});
        }
        batch.field_point_index.push_back(i);
        FieldPointRun& run = batch.field_point_runs.back();
        ++run.count;
        static_cast<void>(add_field_words(run.parts.words_per_point, true, batch));
    }
}

}  // namespace nearfield::plan
