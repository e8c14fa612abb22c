#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/clip.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/queries/overlap_boundary.hpp>
#include <engine/raster/drawn_batch_builder.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace nearfield::raster {
namespace {

/// In place of a tile's index: the CPU decides its points.
constexpr std::uint32_t left_to_cpu = UINT32_MAX;

using geometry::Mesh;
using geometry::MeshVertex;
using geometry::TransformedPolygon;
using geometry::Vector;

/// The part of an edge within `border` cells of a tile; far ends would only degrade the raster's
/// precision.
queries::TileEdge part_near(const queries::TileEdge& edge, const shaders::TileData& tile,
                            double border) {
    queries::TileEdge part = edge;
    if (geometry::clip_to_slab(part.a, part.b, 0, -border, tile.width + border) &&
        geometry::clip_to_slab(part.a, part.b, 1, -border, tile.height + border)) {
        return part;
    }
    return edge;
}

TileVertex in_tile(const shaders::TileData& tile, const MeshVertex& vertex) {
    return {vertex, static_cast<std::uint16_t>(tile.atlas_x),
            static_cast<std::uint16_t>(tile.atlas_y), static_cast<std::uint16_t>(tile.width),
            static_cast<std::uint16_t>(tile.height)};
}

/// The tile at depth 1, as two triangles in the atlas.
std::array<MeshVertex, 6> rectangle_of(const shaders::TileData& tile, std::uint32_t id) {
    const auto left = static_cast<float>(tile.atlas_x);
    const auto low = static_cast<float>(tile.atlas_y);
    const auto right = static_cast<float>(tile.atlas_x + tile.width);
    const auto top = static_cast<float>(tile.atlas_y + tile.height);
    return {{{left, low, 1.0F, id},
             {right, low, 1.0F, id},
             {right, top, 1.0F, id},
             {left, low, 1.0F, id},
             {right, top, 1.0F, id},
             {left, top, 1.0F, id}}};
}

void add_rectangle(const shaders::TileData& tile, Mesh& mesh) {
    const auto rectangle = rectangle_of(tile, 0);
    mesh.insert(mesh.end(), rectangle.begin(), rectangle.end());
}

/// Moves vertices, from `first` on, from cells of a tile to its place in the atlas.
void move_to_atlas(const shaders::TileData& tile, std::size_t first, Mesh& mesh) {
    const auto x = static_cast<float>(tile.atlas_x);
    const auto y = static_cast<float>(tile.atlas_y);
    for (std::size_t i = first; i < mesh.size(); ++i) {
        mesh[i].x += x;
        mesh[i].y += y;
    }
}

/// Appends groups of width x height cells that cover a tile; `first` describes the low one.
void add_groups(const shaders::TileData& tile, std::uint32_t width, std::uint32_t height,
                shaders::CellGroup first, std::vector<shaders::CellGroup>& groups) {
    for (std::uint32_t row = 0; row < tile.height; row += height) {
        for (std::uint32_t column = 0; column < tile.width; column += width) {
            first.cell = column | row << 16U;
            groups.push_back(first);
        }
    }
}

/// Whether the CPU decides the points of a tile, since so many edges may matter to each of them
/// that the device would take too long. `edges`: in the tile's lists.
bool is_left_to_cpu(const device_input::PlannedQuery& query, std::size_t edges) {
    // A thread looks at the boxes of all clusters of the lists, for each point.
    constexpr std::size_t few = 1024;
    const bool can_be = std::holds_alternative<PenetrationQuery>(*query.query) ||
                        std::holds_alternative<ContactQuery>(*query.query);
    return can_be && edges > few;
}

// Minimum cells of a tile for an occlusion query, which costs about as much as searching this many
// samples (docs/performance.md) and gains nothing if some pass.
constexpr std::uint32_t smallest_watched = 128U * 128U;

/// With stencil or depth, only samples of the intersection pass while A is drawn. Where colour
/// decides, all of A passes, so the occlusion query says too little.
bool worth_watching(IntersectionStrategy strategy, const device_input::PlannedTile& tile) {
    return (strategy == IntersectionStrategy::stencil || strategy == IntersectionStrategy::depth) &&
           tile.width * tile.height >= smallest_watched;
}

}  // namespace

std::uint32_t DrawnBatchBuilder::build(const device_input::Plan& plan,
                                       std::vector<DrawnBatch>& batches) {
    shapes_.clear();  // which may have changed
    place_tiles(plan);
    batches.resize(std::max<std::size_t>(batches.size(), atlas_.tile_batches()));
    for (std::uint32_t number = 0; number < atlas_.tile_batches(); ++number) {
        batches[number].clear();
    }
    select_watched(plan, batches);
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const device_input::PlannedTile& tile = plan.tiles[i];
        const device_input::PlannedQuery& query = plan.queries[tile.query];
        if (query.technique != Technique::raster) {
            continue;
        }
        checkpoint();
        DrawnBatch& batch = batches[places_[i].tile_batch];
        tile_of_plan_[i] = static_cast<std::uint32_t>(batch.tiles.size());
        batch.add_tile(tile, i);
        shaders::TileData& data = batch.tiles.back();
        data.atlas_x = places_[i].x;
        data.atlas_y = places_[i].y;
        batch.extent.width = std::max(batch.extent.width, data.atlas_x + tile.width);
        batch.extent.height = std::max(batch.extent.height, data.atlas_y + tile.height);
        if (tile.kind == device_input::TileKind::overlap) {
            add_overlap_tile(query, tile, batch);
        } else if (!add_distance_tile(query, tile, batch)) {
            tile_of_plan_[i] = left_to_cpu;
        }
    }
    add_points(plan, batches);
    add_field_points(plan, batches);
    return atlas_.tile_batches();
}

/// Distances, and intersections by each strategy, have tile batches of their own, so that the draws
/// of a tile batch stay few whatever queries are mixed.
void DrawnBatchBuilder::place_tiles(const device_input::Plan& plan) {
    for (std::vector<std::uint32_t>& tiles : drawn_together_) {
        tiles.clear();
    }
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const device_input::PlannedQuery& planned = plan.queries[plan.tiles[i].query];
        if (planned.technique == Technique::raster) {
            const auto* const overlap = std::get_if<IntersectionQuery>(planned.query);
            drawn_together_[overlap == nullptr ? 0
                                               : 1 + static_cast<std::size_t>(overlap->strategy)]
                .push_back(i);
        }
    }
    places_.resize(plan.tiles.size());
    tile_of_plan_.resize(plan.tiles.size());
    atlas_.begin(plan.largest_atlas);
    for (std::vector<std::uint32_t>& tiles : drawn_together_) {
        atlas_.pack(tiles, plan.tiles, places_);
    }
}

void DrawnBatchBuilder::add_points(const device_input::Plan& plan,
                                   std::vector<DrawnBatch>& batches) const {
    const device_input::PlannedQuery* query = nullptr;
    std::optional<queries::BoundaryPositions> position;
    std::uint32_t index = device_input::PlannedPoint::no_tile;  // of the tile below
    Vector origin = Vector::Zero();
    for (std::uint32_t i = 0; i < plan.points.size(); ++i) {
        const device_input::PlannedPoint& point = plan.points[i];
        if (tile_of_plan_[point.tile] == left_to_cpu) {
            continue;
        }
        const device_input::PlannedTile& tile = plan.tiles[point.tile];
        if (index != point.tile) {
            index = point.tile;
            origin = tile.origin();
        }
        if (query != &plan.queries[tile.query]) {
            query = &plan.queries[tile.query];
            position.emplace(TransformedPolygon(*query->a, query->pose_a));
        }
        const Vector local = ((*position)(point.point) - origin) / tile.grid.cell;
        DrawnBatch& batch = batches[places_[index].tile_batch];
        batch.points.push_back({{static_cast<float>(local.x()), static_cast<float>(local.y())},
                                tile_of_plan_[index],
                                0});
        batch.point_index.push_back(i);
    }
}

void DrawnBatchBuilder::add_field_points(const device_input::Plan& plan,
                                         std::vector<DrawnBatch>& batches) const {
    for (std::uint32_t i = 0; i < plan.field_points.size(); ++i) {
        const queries::PlacedFieldPoint& point = plan.field_points[i];
        const device_input::PlannedTile& tile = plan.tiles[point.tile];
        if (plan.queries[tile.query].technique == Technique::raster) {
            DrawnBatch& batch = batches[places_[point.tile].tile_batch];
            const Vector local = (point.position - tile.origin()) / tile.grid.cell;
            batch.field_points.push_back(
                {{static_cast<float>(local.x()), static_cast<float>(local.y())},
                 tile_of_plan_[point.tile],
                 point.column | point.row << 16U});
            batch.add_field_point(plan, i);
        }
    }
}

void DrawnBatchBuilder::add_fill(const std::vector<queries::TileEdge>& edges,
                                 const shaders::TileData& tile, Mesh& mesh) const {
    const std::size_t first = mesh.size();
    const geometry::FillMesh fill(tile.width, tile.height, grid_);
    SparseCheckpoint<256> checkpoint;
    for (const queries::TileEdge& edge : edges) {
        checkpoint.step();
        fill.append(edge.a, edge.b, mesh);
    }
    move_to_atlas(tile, first, mesh);
}

const NearestEdge* DrawnBatchBuilder::find_nearest(std::uint32_t simplified,
                                                   std::uint32_t hint) const {
    if (hint > 0 && nearest_[hint - 1].edge.simplified == simplified) {
        return &nearest_[hint - 1];
    }
    const auto found = std::lower_bound(
        nearest_.begin(), nearest_.end(), simplified,
        [](const NearestEdge& edge, std::uint32_t index) { return edge.edge.simplified < index; });
    return found != nearest_.end() && found->edge.simplified == simplified ? &*found : nullptr;
}

void DrawnBatchBuilder::add_distance_mesh(const queries::TileBoundary& boundary,
                                          const shaders::TileData& tile, double error,
                                          std::vector<TileVertex>& mesh) {
    distance_mesh_.begin({error, grid_, {Vector::Zero(), Vector(tile.width, tile.height)}});
    tangents_.clear();
    for (const NearestEdge& nearest : nearest_) {
        tangents_.push_back(tangent(nearest.edge.a, nearest.edge.b));
    }
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t i = 0; i < nearest_.size(); ++i) {
        checkpoint.step();
        const NearestEdge& nearest = nearest_[i];
        const queries::TileEdge& edge = nearest.edge;
        const queries::TileEdge part = part_near(edge, tile, nearest.reach() + 1.0);
        const bool is_whole = part.a == edge.a && part.b == edge.b;
        distance_mesh_.add_tent(part.a, part.b, is_whole ? tangents_[i] : tangent(part.a, part.b),
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
    const auto x = static_cast<float>(tile.atlas_x);
    const auto y = static_cast<float>(tile.atlas_y);
    const std::size_t before = mesh.size();
    mesh.resize(before + 3 * distance_mesh_.max_triangles());
    TileVertex* next = mesh.data() + before;
    distance_mesh_.for_each_triangle([&](const std::array<MeshVertex, 3>& triangle) {
        for (const MeshVertex& vertex : triangle) {
            *next++ = in_tile(
                tile, {vertex.x + x, vertex.y + y, vertex.distance * depth_scale, vertex.id});
        }
    });
    mesh.resize(static_cast<std::size_t>(next - mesh.data()));
}

void DrawnBatchBuilder::add_field(const device_input::PlannedQuery& query,
                                  const device_input::PlannedTile& tile, DrawnBatch& batch) const {
    const device_input::FieldTile& field = batch.add_field_tile(query, tile);
    if (field.sign == SignEncoding::feature_bit &&
        nearest_.size() >= shaders::max_signed_features) {
        throw StatusException(
            {StatusCode::too_large,
             std::to_string(nearest_.size()) +
                 " edges can be nearest in one tile of a distance field; an id that "
                 "carries the sign in its top bit has room for " +
                 std::to_string(shaders::max_signed_features)});
    }
    const shaders::TileData& data = batch.tiles.back();
    if (query.field().parts.blended) {
        for (const MeshVertex& vertex : rectangle_of(data, field.first_value)) {
            batch.meshes[TileMeshId::gradients].push_back(in_tile(data, vertex));
        }
    }
    if (field.first_value != shaders::not_asked || field.first_feature != shaders::not_asked) {
        add_groups(data, shaders::field_group_side, shaders::field_group_side,
                   {field.tile, 0, field.first_value, field.first_feature},
                   batch.groups[group_list(field.sign)]);
    }
}

bool DrawnBatchBuilder::add_distance_tile(const device_input::PlannedQuery& query,
                                          const device_input::PlannedTile& tile,
                                          DrawnBatch& batch) {
    const double cell = tile.grid.cell;
    const queries::ErrorBudget& budget = query.budget;
    const queries::TileBoundary boundary(
        shapes_.get(*query.b, budget.simplification, queries::longest_tile_run * cell),
        queries::ToCells(TransformedPolygon(*query.b, query.pose_b), tile.origin(), cell));
    const double simplification = budget.simplification / cell;
    double mesh_error = budget.mesh / cell;
    if (tile.kind == device_input::TileKind::points) {
        // The resolve pass searches from the drawn feature for the nearest one; far from the
        // boundary a mesh as fine as near to it would have far too many triangles.
        mesh_error = std::max(mesh_error, boundary.distance(tile.centre()) / 16.0);
    }

    crossing_.clear();
    queries::crossing_edges(boundary, tile.width, tile.height, simplification, crossing_);
    finder_.find(boundary, tile.needed, simplification + mesh_error, nearest_);
    if (tile.kind == device_input::TileKind::points &&
        is_left_to_cpu(query, crossing_.size() + nearest_.size())) {
        return false;
    }
    nearest_list_.clear();
    double largest_reach = 0.0;
    for (const NearestEdge& nearest : nearest_) {
        nearest_list_.push_back(nearest.edge);
        largest_reach = std::max(largest_reach, nearest.reach());
    }
    SignEncoding sign = SignEncoding::stencil;
    if (tile.kind == device_input::TileKind::field) {
        add_field(query, tile, batch);
        sign = batch.field_tiles.back().sign;
    }
    TileMeshes& meshes = batch.meshes;
    shaders::TileData& data = batch.tiles.back();
    add_rectangle(data, meshes[rectangles_of(sign)]);
    add_fill(crossing_, data, meshes[fills_of(sign)]);
    add_distance_mesh(boundary, data, mesh_error,
                      meshes[sign == SignEncoding::feature_bit ? TileMeshId::signed_distances
                                                               : TileMeshId::distances]);

    batch.lists.begin_tile(boundary);
    const double side = std::max(tile.width, tile.height);
    data.nearest = batch.lists.write(nearest_list_, side + 2.0 * largest_reach + 4.0);
    data.crossing = batch.lists.write(crossing_, side + 4.0);
    // The cell's centre is up to half a diagonal away; simplification, the mesh and snapping change
    // its distance and the fill; the rest is for rounding.
    data.settled = static_cast<float>(std::numbers::sqrt2 / 2.0 + simplification + mesh_error +
                                      2.0 * grid_.largest_move() + 0.01);
    data.margin = static_cast<float>(queries::margin_in_cells);
    data.outside = tile.kind == device_input::TileKind::points && query.points().outside ? 1 : 0;
    return true;
}

void DrawnBatchBuilder::select_watched(const device_input::Plan& plan,
                                       std::vector<DrawnBatch>& batches) const {
    const auto is_larger = [&](std::uint32_t i, std::uint32_t j) {
        return plan.tiles[i].width * plan.tiles[i].height >
               plan.tiles[j].width * plan.tiles[j].height;
    };
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const device_input::PlannedTile& tile = plan.tiles[i];
        const device_input::PlannedQuery& planned = plan.queries[tile.query];
        const auto* const query = std::get_if<IntersectionQuery>(planned.query);
        if (planned.technique == Technique::raster && query != nullptr &&
            worth_watching(query->strategy, tile)) {
            std::vector<std::uint32_t>& largest = batches[places_[i].tile_batch].largest;
            largest.insert(std::upper_bound(largest.begin(), largest.end(), i, is_larger), i);
            largest.resize(std::min<std::size_t>(largest.size(), max_watched));
        }
    }
}

void DrawnBatchBuilder::add_boundary(const queries::TileBoundary& boundary,
                                     const shaders::TileData& tile, double offset,
                                     std::vector<queries::EdgeRun>* runs, Mesh& mesh) const {
    const std::size_t first = mesh.size();
    SparseCheckpoint<64> checkpoint;
    boundary.for_offset_edges(tile.width, tile.height, offset, [&](std::uint32_t i) {
        checkpoint.step();
        const std::size_t before = mesh.size();
        const auto run = runs != nullptr ? static_cast<std::uint32_t>(runs->size()) : 0U;
        if (run == shaders::max_runs) {
            throw StatusException(
                {StatusCode::too_large, "the boundaries of one tile batch have more than " +
                                            std::to_string(shaders::max_runs) +
                                            " edges; use a larger tolerance"});
        }
        geometry::append_offset_polygon(boundary.start(i), boundary.end(i), offset, tile.width,
                                        tile.height, grid_, run << shaders::run_shift, mesh);
        if (runs != nullptr && mesh.size() > before) {
            runs->push_back({boundary.edge(i).first, boundary.edge(i).count});
        }
    });
    move_to_atlas(tile, first, mesh);
}

void DrawnBatchBuilder::add_overlap_tile(const device_input::PlannedQuery& query,
                                         const device_input::PlannedTile& tile, DrawnBatch& batch) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    const device_input::OverlapTile drawn = batch.add_overlap_tile(asked, tile);
    const shaders::TileData& data = batch.tiles.back();
    add_groups(data, shaders::overlap_group_width, shaders::overlap_group_height,
               {drawn.tile, 0, drawn.lists ? 1U : 0U, 0}, batch.groups[group_list(asked.strategy)]);
    add_rectangle(data, batch.meshes[overlaps_of(asked.strategy, OverlapStep::clear)]);
    add_overlap_b(query, tile, drawn, batch);
    add_overlap_a(query, tile, drawn, batch);
    batch.overlaps[static_cast<std::size_t>(asked.strategy)].push_back(drawn);
}

void DrawnBatchBuilder::add_volume(const queries::TileBoundary& boundary,
                                   const shaders::TileData& tile, double slack, Mesh& parity,
                                   Mesh& rectangles) {
    crossing_.clear();
    queries::crossing_edges(boundary, tile.width, tile.height, slack, crossing_);
    add_fill(crossing_, tile, parity);
    add_rectangle(tile, rectangles);
}

void DrawnBatchBuilder::add_overlap_b(const device_input::PlannedQuery& query,
                                      const device_input::PlannedTile& tile,
                                      const device_input::OverlapTile& overlap, DrawnBatch& batch) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return batch.meshes[overlaps_of(strategy, step)];
    };
    const double cell = tile.grid.cell;
    const shaders::TileData& data = batch.tiles.back();
    const queries::TileBoundary boundary =
        queries::overlap_boundary(*query.b, query.pose_b, query.budget, tile, shapes_);
    if (overlap.part_b == device_input::Part::boundary) {
        add_boundary(boundary, data, query.budget.offset / cell, nullptr,
                     mesh(OverlapStep::boundary_b));
    } else {
        add_volume(boundary, data, query.budget.simplification / cell, mesh(OverlapStep::parity_b),
                   mesh(OverlapStep::volume_b));
    }
}

void DrawnBatchBuilder::add_overlap_a(const device_input::PlannedQuery& query,
                                      const device_input::PlannedTile& tile,
                                      const device_input::OverlapTile& overlap, DrawnBatch& batch) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return batch.meshes[overlaps_of(strategy, step)];
    };
    const bool is_watched = std::find(batch.largest.begin(), batch.largest.end(),
                                      batch.tile_index[overlap.tile]) != batch.largest.end();
    Mesh& drawn = is_watched                                       ? mesh(OverlapStep::watched_a)
                  : overlap.part_a == device_input::Part::boundary ? mesh(OverlapStep::boundary_a)
                                                                   : mesh(OverlapStep::volume_a);
    const auto first = static_cast<std::uint32_t>(drawn.size());
    const double cell = tile.grid.cell;
    const shaders::TileData& data = batch.tiles.back();
    const queries::TileBoundary boundary =
        queries::overlap_boundary(*query.a, query.pose_a, query.budget, tile, shapes_);
    if (overlap.part_a == device_input::Part::boundary) {
        add_boundary(boundary, data, query.budget.offset / cell, &batch.runs, drawn);
    } else {
        add_volume(boundary, data, query.budget.simplification / cell, mesh(OverlapStep::parity_a),
                   drawn);
    }
    if (is_watched) {
        const auto count = static_cast<std::uint32_t>(drawn.size()) - first;
        batch.watched.push_back({overlap.tile, strategy, overlap.part_a, {first, count}});
    }
}

}  // namespace nearfield::raster
