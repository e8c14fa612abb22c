#include <engine/device_input/resident_outputs_builder.hpp>
#include <engine/device_input/search_shapes.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <nearfield/on_device.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

namespace nearfield::device_input {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

template <class Query>
const BufferTarget* target_of(const Query& query) {
    if constexpr (std::is_same_v<Query, PenetrationQuery> || std::is_same_v<Query, ContactQuery>) {
        return query.target;
    }
    return nullptr;
}

/// How far the device's numbers may differ from exact ones (docs/resident_results.md): single
/// precision for lengths up to the extent of both shapes.
double error_of_records(const TransformedPolygon& a, const TransformedPolygon& b) {
    const double extent =
        a.polygon().radius() + b.polygon().radius() + (a.translation() - b.translation()).norm();
    return std::ldexp(extent, -18) + 4.0 * (geometry::placement_rounding(a, a.box()) +
                                            geometry::placement_rounding(b, b.box()));
}

/// Appends the rings of a polygon to the tables; returns where.
std::uint32_t add_rings(const geometry::Polygon& polygon, std::vector<std::uint32_t>& tables) {
    const auto first = static_cast<std::uint32_t>(tables.size());
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        tables.push_back(polygon.ring_begin(ring));
    }
    tables.push_back(polygon.size());
    return first;
}

/// Of points that the search looks at, at most: the threads of a direction, and of each of its
/// blocks of edges, may have room for a few more.
std::uint32_t blocks_of(const PlannedQuery& searched, double max_points) {
    const double parts = 2.0 + static_cast<double>(searched.a->size()) / shaders::search_block;
    const double points = max_points + (shaders::points_per_thread - 1.0) * parts;
    return static_cast<std::uint32_t>(points / shaders::points_per_block) + 1;
}

}  // namespace

void ResidentOutputsBuilder::build(const Plan& plan, std::span<const ComputeBatch> tile_batches,
                                   std::span<const AnyResult> results, std::uint32_t room,
                                   ResidentOutputs& resident) {
    resident.clear();
    searched_ = 0;
    find_field_parts(plan, tile_batches);
    samples_.begin();
    for (const std::uint32_t query : plan.resident) {
        const PlannedQuery& planned = plan.queries[query];
        const auto is_usable = [](const auto& result) { return result.status.ok(); };
        if (!std::visit(is_usable, results[query])) {
            continue;
        }
        if (const auto* const field = std::get_if<DistanceFieldResult>(&results[query])) {
            add_field(planned, query, *field, resident);
        } else if (const auto* const overlap = std::get_if<IntersectionResult>(&results[query])) {
            samples_.add(plan, tile_batches, query, *overlap, resident);
        } else {
            add_records(plan, query, room, resident);
        }
    }
}

void ResidentOutputsBuilder::find_field_parts(const Plan& plan,
                                              std::span<const ComputeBatch> tile_batches) {
    parts_.clear();
    for (std::uint32_t number = 0; number < tile_batches.size(); ++number) {
        const ComputeBatch& batch = tile_batches[number];
        if (!batch.resident) {
            continue;
        }
        for (const FieldTile& field : batch.field_tiles) {
            const PlannedTile& tile = plan.tiles[batch.tile_index[field.tile]];
            if (!plan.queries[tile.query].on_device) {
                continue;
            }
            const std::uint32_t corner = tile.halo * tile.width + tile.halo;
            FieldPartOutput part;
            part.tile_batch = number;
            part.cells.value = field.first_value + corner;
            const bool has_features =
                std::get<DistanceFieldQuery>(*plan.queries[tile.query].query).features_on_device;
            part.cells.feature = has_features ? field.first_feature + corner : shaders::not_asked;
            part.cells.stride = tile.width;
            part.cells.width = tile.width - 2 * tile.halo;
            part.cells.height = tile.height - 2 * tile.halo;
            part.cells.column = static_cast<std::int32_t>(tile.column);
            part.cells.row = static_cast<std::int32_t>(tile.row);
            parts_.emplace_back(tile.query, part);
        }
    }
    std::sort(parts_.begin(), parts_.end(), [](const auto& i, const auto& j) {
        const auto key = [](const auto& part) {
            return std::tuple(part.first, part.second.cells.row, part.second.cells.column);
        };
        return key(i) < key(j);
    });
}

void ResidentOutputsBuilder::add_field(const PlannedQuery& planned, std::uint32_t query,
                                       const DistanceFieldResult& result,
                                       ResidentOutputs& resident) {
    FieldOutputs& field = resident.fields.emplace_back();
    field.query = query;
    field.width = result.width;
    field.height = result.height;
    field.origin = geometry::to_vector(result.origin);
    field.cell = result.cell;
    field.error_bound = planned.budget.bound + queries::far_rounding * planned.field().farthest;
    const auto& asked = std::get<DistanceFieldQuery>(*planned.query);
    if (asked.target != nullptr) {
        field.target = *asked.target;
    }
    field.has_features = asked.features_on_device;
    const std::uint32_t rings = add_rings(*planned.b, resident.tables);
    field.first_part = static_cast<std::uint32_t>(resident.field_parts.size());
    const auto first = std::partition_point(
        parts_.begin(), parts_.end(), [query](const auto& part) { return part.first < query; });
    for (auto part = first; part != parts_.end() && part->first == query; ++part) {
        shaders::ExportFieldPush& cells = resident.field_parts.emplace_back(part->second).cells;
        cells.rings = rings;
        cells.ring_count = planned.b->ring_count();
        cells.cell = static_cast<float>(result.cell);
        cells.origin = rounded(field.origin);
        cells.field_width = field.width;
        cells.field_height = field.height;
    }
    field.part_count = static_cast<std::uint32_t>(resident.field_parts.size()) - field.first_part;
}

void ResidentOutputsBuilder::add_records(const Plan& plan, std::uint32_t query, std::uint32_t room,
                                         ResidentOutputs& resident) {
    const PlannedQuery& planned = plan.queries[query];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    BufferOutput& records = resident.records.emplace_back();
    records.query = query;
    records.cell = planned.budget.cell;
    records.error_bound = error_of_records(a, b);
    records.origin = b.translation();
    records.first_run = static_cast<std::uint32_t>(resident.record_runs.size());
    std::uint32_t most = 0;  // at any poses
    const auto add = [&](std::uint32_t direction, const TransformedPolygon& in) {
        const auto& directions = plan.pairs.directions;
        const auto found = std::find_if(
            directions.begin() + searched_, directions.end(),
            [direction](const shaders::SearchDirectionData& one) { return one.a == direction; });
        searched_ = static_cast<std::uint32_t>(found - directions.begin());
        const double max_points = queries::max_points(plan.queries[direction]);
        RecordRunOutput& run = resident.record_runs.emplace_back();
        run.direction = searched_;
        run.blocks = blocks_of(plan.queries[direction], max_points);
        run.flags = records.run_count == 0 ? 0 : point_flags::on_b;
        run.frame_axis = rounded(unit_length_of(in.polygon()) * in.rotation().col(0));
        run.frame_place = rounded(in.translation() - records.origin);
        most += static_cast<std::uint32_t>(std::ceil(max_points));
        // The directions of a query take turns.
        records.block_bytes = std::max<std::uint64_t>(
            records.block_bytes, std::uint64_t{run.blocks} * sizeof(shaders::RecordBlockData));
        ++records.run_count;
    };
    add(query, b);
    if (const std::uint32_t reverse = planned.points().reverse; reverse != PlannedPoints::none) {
        add(reverse, a);
    }
    const BufferTarget* const target =
        std::visit([](const auto& asked) { return target_of(asked); }, *planned.query);
    if (target != nullptr) {
        records.target = *target;
        const std::uint64_t fits = (target->size - sizeof(SummaryData)) / sizeof(PointData);
        room = static_cast<std::uint32_t>(std::min<std::uint64_t>(fits, UINT32_MAX));
    }
    records.capacity = std::min(room, most);
    records.bytes = sizeof(SummaryData) + std::uint64_t{records.capacity} * sizeof(PointData);
}

}  // namespace nearfield::device_input
