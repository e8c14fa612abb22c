#include <engine/base/interruption.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/base/unknown_shape.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/compute_work.hpp>
#include <engine/plan/empty_result.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/planner.hpp>
#include <engine/plan/query_timer.hpp>
#include <engine/plan/region.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/jobs.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;

// Signs, features, distances, hits and two stencils (8 bytes each where the stencil comes with
// depth); signs in white, signed features with their distances, gradients.
constexpr double bytes_per_pixel = 4.0 * 4.0 + 2.0 * 8.0 + 1.0 + 2.0 * 4.0 + 8.0;

// Memory per sample while all samples of a boundary are kept at once and none is planned: its
// position, the nearest feature, the potential contact.
constexpr double bytes_of_kept_sample = 256.0;

/// A size in the largest unit that it fills, so that a small limit is not told as 0 MiB.
std::string memory_text(double bytes, double (*round)(double)) {
    constexpr double kibibyte = 1024.0;
    constexpr double mebibyte = 1024.0 * kibibyte;
    const double unit = bytes >= mebibyte ? mebibyte : bytes >= kibibyte ? kibibyte : 1.0;
    const char* const name = unit == mebibyte ? " MiB" : unit == kibibyte ? " KiB" : " bytes";
    return number(round(bytes / unit)) + name;
}

}  // namespace

Planner::Planner(const PlanLimits& limits)
    : limits_(limits), packer_(0), targets_(limits.offset_alignment) {
    // Images take at most a quarter of the memory; smaller images only mean more tile batches.
    const auto images = [this] {
        return bytes_per_pixel * limits_.largest_atlas * limits_.largest_atlas;
    };
    while (limits_.largest_atlas > smallest_atlas &&
           images() > static_cast<double>(limits_.memory) / 4.0) {
        limits_.largest_atlas /= 2;
    }
    limits_.largest_tile = std::min(limits_.largest_tile, limits_.largest_atlas);
    point_tiles_ = PointTiles(std::min(limits_.points_tile, limits_.largest_tile));
    packer_ = AtlasPacker(limits_.largest_atlas);
    memory_of_images_ = images();
    memory_for_results_ = std::max(0.0, static_cast<double>(limits_.memory) - memory_of_images_);
    max_to_keep_ = memory_for_results_ / 4.0 / bytes_of_kept_sample;
}

void Planner::plan(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                   Plan& plan, std::vector<AnyResult>& results, Submissions submissions) {
    counts_closely_ = false;
    plan_all(queries, shapes, plan, results, submissions);
    if (plan.result_bytes + rough_bytes_ > memory_for_results_) {
        counts_closely_ = true;
        plan_all(queries, shapes, plan, results, submissions);
    }
    plan.result_bytes += rough_bytes_;
    const double with_room = max_to_keep_ / std::max(1.0, max_kept_);
    plan.max_jobs = static_cast<std::uint32_t>(std::clamp(with_room, 1.0, 1.0 * max_jobs));
}

void Planner::plan_nothing(std::span<const AnyQuery> queries, const Status& status, Plan& plan,
                           std::vector<AnyResult>& results) {
    plan.clear();
    plan.queries.assign(queries.size(), {});
    results.resize(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        std::visit(
            [&](const auto& query) {
                using Result = typename std::decay_t<decltype(query)>::Result;
                make_empty<Result>(results[i]).status = status;
            },
            queries[i]);
    }
}

void Planner::plan_all(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                       Plan& plan, std::vector<AnyResult>& results, Submissions submissions) {
    plan.clear();
    plan_ = &plan;
    targets_.clear();
    plan.bounding_volume = limits_.bounding_volume;
    localize_milliseconds_ = rough_bytes_ = max_kept_ = 0.0;
    results.resize(queries.size());
    plan.queries.resize(queries.size());
    for (query_ = 0; query_ < queries.size(); ++query_) {
        checkpoint();
        const QueryTimer timer(plan.times, query_, &QueryTime::plan);
        plan.queries[query_] = {};
        plan.queries[query_].query = &queries[query_];
        query_bytes_ = 0.0;
        std::visit(
            [&](const auto& query) {
                using Result = typename std::decay_t<decltype(query)>::Result;
                plan_query(query, shapes[query_], submissions, make_empty<Result>(results[query_]));
            },
            queries[query_]);
    }
    pack();
    plan_ = nullptr;
}

template <class Query>
void Planner::plan_query(const Query& query, const QueryShapes& shapes, Submissions submissions,
                         typename Query::Result& result) {
    PlannedQuery& planned = plan_->queries[query_];
    if constexpr (requires { query.tolerance; }) {
        result.tolerance = query.tolerance;
    }
    result.technique = query.technique;
    planned.on_cpu = result.technique == Technique::cpu;
    planned.by_compute = result.technique == Technique::compute;
    if constexpr (requires { query.resident; }) {
        planned.resident = query.resident;
        if (query.resident) {
            plan_->resident.push_back(query_);
        }
    }
    // Success is not copied: thousands of queries have it in common.
    if (Status status = check_query(query, limits_.techniques); !status.ok()) {
        result.status = std::move(status);
    }
    if (submissions == Submissions::one && result.status.ok() && takes_a_second_submission(query)) {
        result.status = not_recordable(query.technique);
    }
    planned.a = shapes.a;
    planned.b = shapes.b;
    planned.pose_a = query.a.pose;
    planned.pose_b = query.b.pose;
    // Only the box of a distance field's A is used.
    constexpr bool of_b_alone = std::is_same_v<Query, DistanceFieldQuery>;
    const bool a_left_out = of_b_alone && query.a.shape == ShapeHandle{};
    if (result.status.ok() && planned.a == nullptr && !a_left_out) {
        result.status = unknown_shape("shape A", query.a.shape, limits_.context);
    }
    if (result.status.ok() && planned.b == nullptr) {
        result.status = unknown_shape("shape B", query.b.shape, limits_.context);
    }
    if (result.status.ok()) {
        if (Status status = check_target(query); !status.ok()) {
            result.status = std::move(status);
        }
    }
    if (result.status.ok()) {
        planned.deviations = {of_b_alone ? 0.0 : planned.a->deviation(), planned.b->deviation()};
        add(query, result);
    }
    if (!result.status.ok()) {
        targets_.drop(query_);
    }
}

/// Checks the host's images or buffer that a query writes to, if there are any.
template <class Query>
Status Planner::check_target(const Query& query) {
    if constexpr (requires { query.target; }) {
        if (query.resident && query.target != nullptr) {
            return targets_.add(*query.target, query_);
        }
    }
    return {};
}

void Planner::require_memory(double bytes, double tolerance, double growth) {
    plan_->result_bytes += bytes;
    query_bytes_ += bytes;
    const double limit = memory_for_results_;
    if (plan_->result_bytes <= limit) {
        return;
    }
    // Memory grows with (1/d)^growth, which yields the tolerance at which this query alone fits.
    const double smallest = tolerance * std::pow(query_bytes_ / limit, 1.0 / growth);
    std::string hint = limit == 0.0 ? "; images take all of it"
                       : query_bytes_ > limit
                           ? "; the smallest tolerance that fits is about " +
                                 number(static_cast<float>(smallest * 1.05))
                           : "; together with the queries before it the batch is too large";
    const auto up = [](double value) { return std::ceil(value); };
    const auto down = [](double value) { return std::floor(value); };
    throw StatusException(
        {StatusCode::too_large, "query " + std::to_string(query_) + " with tolerance " +
                                    number(tolerance) + " needs up to " +
                                    memory_text(memory_of_images_ + plan_->result_bytes, up) +
                                    ", more than the limit of " +
                                    memory_text(static_cast<double>(limits_.memory), down) + hint});
}

localize::OverlapOptions Planner::overlap_options(double grow) const {
    return {limits_.hierarchy_height, grow, limits_.bounding_volume};
}

void Planner::count(const localize::Effort& effort, ResultSummary& result) const {
    result.localization.nodes_evaluated += effort.nodes_evaluated;
    result.localization.pairs_rejected += effort.pairs_rejected;
    for (const localize::Chain& chain : chains_) {
        result.localization.edges_kept += chain.count;
    }
}

void Planner::join_chain_boxes(const Box& within, double grow) {
    boxes_.clear();
    for (const localize::Chain& chain : chains_) {
        const Box box = geometry::grown(chain.box, grow).intersection(within);
        if (!box.isEmpty()) {
            boxes_.push_back(box);
        }
    }
    localize::join_boxes(boxes_);
    std::sort(boxes_.begin(), boxes_.end(), [](const Box& i, const Box& j) {
        return i.min().y() != j.min().y() ? i.min().y() < j.min().y() : i.min().x() < j.min().x();
    });
}

void Planner::add_regions(double cell, ResultSummary& result) {
    grids_.clear();
    for (const Box& box : boxes_) {
        result.regions.push_back(region_of(grids_.emplace_back(Grid::covering(box, cell))));
    }
}

/// Throws if a side exceeds what a Region can state.
void Planner::require_sides(double tolerance) const {
    for (const Grid& grid : grids_) {
        if (std::max(grid.width, grid.height) > UINT32_MAX) {
            throw StatusException({StatusCode::too_large,
                                   "query " + std::to_string(query_) + " with tolerance " +
                                       number(tolerance) + " has a region of " +
                                       std::to_string(grid.width) + " x " +
                                       std::to_string(grid.height) + " cells; a side has at most " +
                                       std::to_string(UINT32_MAX)});
        }
    }
}

/// Memory for bit masks of the query's grids by the compute technique, one bit per cell: the masks
/// themselves on the device, and their rows on both host and device.
double Planner::bytes_of_masks(int masks) const {
    constexpr double bytes_per_row = 4.0 * (sizeof(MaskRowData) + sizeof(OverlapRowData));
    double bytes = 0.0;
    for (const Grid& grid : grids_) {
        const double across = std::ceil(static_cast<double>(grid.width) / limits_.largest_tile);
        const double rows = across * static_cast<double>(grid.height);
        bytes += masks * (grid.cells() / 8.0 + sizeof(std::uint32_t) * rows) + bytes_per_row * rows;
    }
    return bytes;
}

void Planner::cut_into_tiles(std::uint32_t region, TileKind kind, std::uint32_t side,
                             std::uint32_t halo) {
    const Grid& grid = grids_[region];
    std::vector<Tile>& tiles = plan_->queries[query_].on_cpu ? plan_->cpu_tiles : plan_->tiles;
    for (std::uint64_t row = 0; row < grid.height; row += side) {
        checkpoint();
        for (std::uint64_t column = 0; column < grid.width; column += side) {
            Tile& tile = tiles.emplace_back();
            tile.query = query_;
            tile.kind = kind;
            tile.region = region;
            tile.grid = grid;
            tile.column = column;
            tile.row = row;
            tile.halo = halo;
            tile.width =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(side, grid.width - column)) +
                2 * halo;
            tile.height =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(side, grid.height - row)) +
                2 * halo;
            if (kind == TileKind::field) {
                tile.needed = NeededBlocks(tile.width, tile.height);
                tile.needed.add_all();
            }
        }
    }
}

/// A tile batch of the compute technique takes as many cells as an atlas image has, which bounds
/// the memory for masks and lists. Whole words and blocks count.
void Planner::add_compute_tile_batches() {
    const auto whole = [](std::uint32_t cells, std::uint32_t step) {
        const std::uint32_t steps = (cells + step - 1) / step;
        return static_cast<double>(steps) * step;
    };
    const double most = static_cast<double>(limits_.largest_atlas) * limits_.largest_atlas;
    double cells = most;
    for (Tile& tile : plan_->tiles) {
        if (!plan_->queries[tile.query].by_compute) {
            continue;
        }
        const double own = whole(tile.width, 32) * whole(tile.height, block_side);
        cells += own;
        if (cells > most) {
            ++plan_->tile_batches;
            cells = own;
        }
        tile.place = {plan_->tile_batches - 1, 0, 0};
    }
}

/// Distances, and intersections by each strategy, have tile batches of their own, so that the draws
/// of a tile batch stay few whatever queries are mixed.
void Planner::pack_drawn_tiles() {
    for (DrawnTogether& group : drawn_together_) {
        group.tiles.clear();
        group.sizes.clear();
    }
    for (std::uint32_t i = 0; i < plan_->tiles.size(); ++i) {
        const Tile& tile = plan_->tiles[i];
        const PlannedQuery& planned = plan_->queries[tile.query];
        if (!planned.by_compute) {
            const auto* const overlap = std::get_if<IntersectionQuery>(planned.query);
            DrawnTogether& group =
                drawn_together_[overlap == nullptr
                                    ? 0
                                    : 1 + static_cast<std::size_t>(overlap->strategy)];
            group.tiles.push_back(i);
            group.sizes.push_back({tile.width, tile.height});
        }
    }
    packer_.clear();
    for (const DrawnTogether& group : drawn_together_) {
        packer_.pack(group.sizes, places_);
        for (std::size_t i = 0; i < group.tiles.size(); ++i) {
            plan_->tiles[group.tiles[i]].place = places_[i];
        }
    }
}

void Planner::pack() {
    pack_drawn_tiles();
    plan_->extent = packer_.extent();
    plan_->tile_batches = packer_.tile_batches();
    plan_->raster_tile_batches = plan_->tile_batches;
    add_compute_tile_batches();
    const std::vector<Tile>& tiles = plan_->tiles;
    const std::vector<PlannedPoint>& points = plan_->points;
    const std::vector<PlannedFieldPoint>& field_points = plan_->field_points;
    plan_->tiles_by_batch.sort(tiles.size(), plan_->tile_batches,
                               [&](std::size_t i) { return tiles[i].place.tile_batch; });
    // Points that the CPU answers have no tile: they follow all tile batches.
    const std::uint32_t no_tile_batch = plan_->tile_batches;
    plan_->points_by_batch.sort(points.size(), plan_->tile_batches + 1, [&](std::size_t i) {
        const std::uint32_t tile = points[i].tile;
        return tile == PlannedPoint::no_tile ? no_tile_batch : tiles[tile].place.tile_batch;
    });
    plan_->field_points_by_batch.sort(
        field_points.size(), plan_->tile_batches + 1, [&](std::size_t i) {
            const std::uint32_t tile = field_points[i].tile;
            return tile == PlannedFieldPoint::no_tile ? no_tile_batch
                                                      : tiles[tile].place.tile_batch;
        });
}

}  // namespace nearfield::plan
