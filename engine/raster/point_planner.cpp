#include <engine/base/interruption.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/raster/point_planner.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::raster {
namespace {

using device_input::CurrentQuery;
using device_input::PlannedPoints;
using device_input::PlannedQuery;
using geometry::Box;
using geometry::Chain;
using geometry::grown;
using geometry::TransformedPolygon;
using geometry::Vector;

// Host memory per point: planned and resolved, in the result and in the buffers on the way there.
constexpr double bytes_per_point = sizeof(device_input::PlannedPoint) +
                                   std::max(sizeof(PenetratingPoint), sizeof(ContactPoint)) + 64.0;
// For either boundary, in a search that is finished exactly.
constexpr double max_search_samples = 4096.0;

std::uint32_t box_of(const Vector& p, const std::vector<Box>& boxes, std::uint32_t first_guess) {
    std::uint32_t box = first_guess;
    double nearest = boxes[box].squaredExteriorDistance(p);
    for (std::uint32_t i = 0; i < boxes.size() && nearest > 0.0; ++i) {
        const double distance = boxes[i].squaredExteriorDistance(p);
        if (distance < nearest) {
            nearest = distance;
            box = i;
        }
    }
    return box;
}

bool check_numbers(const PlannedQuery& planned, ResultSummary& result) {
    return device_input::check_numbers(planned, geometry::BoxedPolygon(*planned.a, planned.pose_a),
                                       geometry::BoxedPolygon(*planned.b, planned.pose_b), result);
}

/// Finds the chains of A that can penetrate; returns an upper bound on the points asked for.
double find_inside(const PenetrationQuery& query, CurrentQuery& current, std::vector<Chain>& chains,
                   ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    device_input::find_chains(current.plan, result, chains, [&] {
        return geometry::chains_in_volume(a, b, current.overlap_options(0.0), chains);
    });
    return query.points == PenetrationPoints::vertices
               ? queries::max_vertices(chains)
               : queries::max_samples(a, chains, result.cell, b.box());
}

/// Finds the chains of A that can hold contacts; returns an upper bound on their samples.
double find_near(const TransformedPolygon& a, const TransformedPolygon& b, double contact_distance,
                 const CurrentQuery& current, std::vector<Chain>& chains, ResultSummary& result) {
    device_input::find_chains(current.plan, result, chains, [&] {
        return geometry::chains_near_boundary(a, b, current.overlap_options(contact_distance),
                                              chains);
    });
    return queries::max_samples(a, chains, result.cell, grown(b.box(), contact_distance));
}

/// Towards 0, which is below: what would be negative is 0.
std::uint64_t index_along(double coordinate, std::uint64_t count) {
    return static_cast<std::uint64_t>(std::clamp(coordinate, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

void PointTiles::spread(const geometry::TransformedPolygon& a,
                        const std::vector<queries::BoundaryPoint>& samples, const Box& within,
                        const queries::Regions& regions, std::uint32_t query,
                        device_input::CurrentQuery& current) {
    device_input::Plan& plan = current.plan;
    side_ = std::min(current.limits.points_tile, current.limits.largest_tile);
    find_runs(a, samples, within, regions);
    const std::size_t first_tile = plan.tiles.size();
    add_tiles(regions.grids(), query, plan);
    const auto tile_of = [&](const Run& run) {
        const auto found = std::lower_bound(keys_.begin(), keys_.end(), run.key);
        return first_tile + static_cast<std::size_t>(found - keys_.begin());
    };
    for (const Run& run : runs_) {
        include(run, plan.tiles[tile_of(run)]);
    }
    for (std::size_t i = first_tile; i < plan.tiles.size(); ++i) {
        plan.tiles[i].needed =
            device_input::NeededBlocks(plan.tiles[i].width, plan.tiles[i].height);
    }
    for (const Run& run : runs_) {
        const std::size_t index = tile_of(run);
        device_input::PlannedTile& tile = plan.tiles[index];
        for (std::size_t i = run.first; i < run.end; ++i) {
            plan.points.push_back({kept_[i], static_cast<std::uint32_t>(index)});
            tile.needed.add(static_cast<std::uint32_t>(cells_[i].column - tile.column),
                            static_cast<std::uint32_t>(cells_[i].row - tile.row));
        }
    }
}

void PointTiles::find_runs(const geometry::TransformedPolygon& a,
                           const std::vector<queries::BoundaryPoint>& samples, const Box& within,
                           const queries::Regions& regions) {
    const std::vector<queries::Grid>& grids = regions.grids();  // by box
    kept_.clear();
    cells_.clear();
    runs_.clear();
    queries::BoundaryPositions position(a);
    std::uint32_t grid = 0;
    SparseCheckpoint<64> checkpoint;
    for (const queries::BoundaryPoint& sample : samples) {
        checkpoint.step();
        const Vector p = position(sample);
        if (!within.contains(p)) {
            continue;
        }
        // Samples come in order along the boundary: the last one's region is tried first.
        grid = box_of(p, regions.boxes(), grid);
        const Vector local = (p - grids[grid].origin) / grids[grid].cell;
        add_to_run(grid, {index_along(local.x(), grids[grid].width),
                          index_along(local.y(), grids[grid].height)});
        kept_.push_back(sample);
    }
}

void PointTiles::add_to_run(std::uint32_t grid, const PointCell& cell) {
    const std::size_t point = cells_.size();
    cells_.push_back(cell);
    if (!runs_.empty()) {
        Run& run = runs_.back();
        // Nothing divided: most points are in the tile of the one before.
        if (run.key.grid == grid && cell.row - run.key.row * side_ < side_ &&
            cell.column - run.key.column * side_ < side_) {
            run.end = point + 1;
            run.low = {std::min(run.low.column, cell.column), std::min(run.low.row, cell.row)};
            run.high = {std::max(run.high.column, cell.column), std::max(run.high.row, cell.row)};
            return;
        }
    }
    runs_.push_back({{grid, cell.row / side_, cell.column / side_}, point, point + 1, cell, cell});
}

void PointTiles::add_tiles(const std::vector<queries::Grid>& grids, std::uint32_t query,
                           device_input::Plan& plan) {
    keys_.clear();
    for (const Run& run : runs_) {
        keys_.push_back(run.key);
    }
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    for (const TileKey& key : keys_) {
        device_input::PlannedTile& tile = plan.tiles.emplace_back();
        tile.query = query;
        tile.kind = device_input::TileKind::points;
        tile.region = key.grid;
        tile.grid = grids[key.grid];
    }
}

void PointTiles::include(const Run& run, device_input::PlannedTile& tile) {
    if (tile.width == 0) {
        tile.column = run.low.column;
        tile.row = run.low.row;
    }
    const std::uint64_t right = std::max(tile.column + tile.width, run.high.column + 1);
    const std::uint64_t top = std::max(tile.row + tile.height, run.high.row + 1);
    tile.column = std::min(tile.column, run.low.column);
    tile.row = std::min(tile.row, run.low.row);
    tile.width = static_cast<std::uint32_t>(right - tile.column);
    tile.height = static_cast<std::uint32_t>(top - tile.row);
}

void PointPlanner::plan(CurrentQuery& current, AnyResult& any) {
    std::visit(
        [&]<class Query>(const Query& query) {
            if constexpr (requires(typename Query::Result & result) {
                              plan(query, current, result);
                          }) {
                plan(query, current, std::get<typename Query::Result>(any));
            }
        },
        *current.planned().query);
}

void PointPlanner::add_samples(std::uint32_t direction, const Box& within, CurrentQuery& current) {
    device_input::Plan& plan = current.plan;
    PlannedQuery& planned = plan.queries[direction];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    PlannedPoints& points = planned.points();
    points.first = static_cast<std::uint32_t>(plan.points.size());
    tiles_.spread(a, samples_, within, regions_, direction, current);
    points.count = static_cast<std::uint32_t>(plan.points.size()) - points.first;
}

void PointPlanner::plan(const PenetrationQuery& query, CurrentQuery& current,
                        PenetrationResult& result) {
    PlannedQuery& planned = current.planned();
    planned.work.emplace<PlannedPoints>();
    if (!check_numbers(planned, result)) {
        return;
    }
    const double samples = find_inside(query, current, chains_[0], result);
    if (!chains_[0].empty()) {
        add_deepest(query, samples, current, result);
    }
}

void PointPlanner::add_deepest(const PenetrationQuery& query, double samples, CurrentQuery& current,
                               PenetrationResult& result) {
    const PlannedQuery& planned = current.planned();
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const Box box_b = TransformedPolygon(*planned.b, planned.pose_b).box();
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    if (query.points == PenetrationPoints::vertices) {
        queries::vertices_of_chains(a, chains_[0], samples_);
    } else {
        queries::sample_chains(a, chains_[0], result.cell, box_b, samples_);
    }
    regions_.cover(chains_[0], 0.0, box_b, result);
    add_samples(current.index, box_b, current);
}

void PointPlanner::plan(const ContactQuery& query, CurrentQuery& current, ContactResult& result) {
    PlannedQuery& planned = current.planned();
    planned.work.emplace<PlannedPoints>().outside = true;
    if (!check_numbers(planned, result)) {
        return;
    }
    const double near = query.contact_distance;
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double of_a = find_near(a, b, near, current, chains_[0], result);
    const double of_b = find_near(b, a, near, current, chains_[1], result);
    const std::uint32_t reverse = device_input::add_reverse(current);
    add_near(current.index, near, chains_[0], of_a, current, result);
    add_near(reverse, near, chains_[1], of_b, current, result);
}

void PointPlanner::add_near(std::uint32_t direction, double contact_distance,
                            const std::vector<Chain>& chains, double samples, CurrentQuery& current,
                            ResultSummary& result) {
    if (chains.empty()) {
        return;
    }
    const PlannedQuery& planned = current.plan.queries[direction];
    const Box within =
        grown(TransformedPolygon(*planned.b, planned.pose_b).box(), contact_distance);
    regions_.cover(chains, 0.0, within, result);
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    queries::sample_chains(TransformedPolygon(*planned.a, planned.pose_a), chains, result.cell,
                           within, samples_);
    add_samples(direction, within, current);
}

void PointPlanner::plan(const ClosestPointQuery& /*query*/, CurrentQuery& current,
                        ClosestPointResult& result) {
    plan_closest(false, current, result);
}

void PointPlanner::plan(const SeparationQuery& /*query*/, CurrentQuery& current,
                        SeparationResult& result) {
    plan_closest(true, current, result);
}

void PointPlanner::plan_closest(bool both_ways, CurrentQuery& current, ResultSummary& result) {
    PlannedQuery& planned = current.planned();
    planned.work.emplace<PlannedPoints>().outside = true;
    result.cell = planned.budget.cell;
    if (!check_numbers(planned, result)) {
        return;
    }
    tested_.clear();
    result.intersects = queries::intersect(planned, tested_, overlap_test_);
    if (result.intersects) {
        return;  // at distance 0: nothing to render
    }
    const std::uint32_t reverse =
        both_ways ? device_input::add_reverse(current) : PlannedPoints::none;
    double samples = find_closest(current.index, current, chains_[0], result);
    if (both_ways) {
        samples = std::max(samples, find_closest(reverse, current, chains_[1], result));
    }
    // The exact search continues wherever the samples end, so more samples gain nothing.
    result.cell *= std::max(1.0, samples / max_search_samples);
    if (both_ways) {
        add_closest(reverse, chains_[1], current, result);
    }
    add_closest(current.index, chains_[0], current, result);
}

double PointPlanner::find_closest(std::uint32_t direction, const CurrentQuery& current,
                                  std::vector<Chain>& chains, ResultSummary& result) {
    const PlannedQuery& planned = current.plan.queries[direction];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    device_input::find_chains(current.plan, result, chains, [&] {
        return closest_.find(a, b, current.overlap_options(0.0), chains);
    });
    return queries::max_samples(a, chains, result.cell, grown(a.box(), result.cell));
}

void PointPlanner::add_closest(std::uint32_t direction, const std::vector<Chain>& chains,
                               CurrentQuery& current, ResultSummary& result) {
    PlannedQuery& planned = current.plan.queries[direction];
    planned.budget = queries::search_budget(result.cell / std::numbers::sqrt2);
    const TransformedPolygon a(*planned.a, planned.pose_a);
    // A box slightly larger than A, so that rounding drops no point.
    const Box everything = grown(a.box(), result.cell);
    regions_.cover(chains, 0.0, everything, result);
    const double samples = queries::max_samples(a, chains, result.cell, everything);
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    queries::sample_chains(a, chains, result.cell, everything, samples_);
    // A short chain may lie between two samples.
    for (const Chain& chain : chains) {
        samples_.push_back({chain.first, 0.0});
    }
    add_samples(direction, everything, current);
}

}  // namespace nearfield::raster
