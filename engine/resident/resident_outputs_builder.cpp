#include <engine/localize/hierarchy.hpp>
#include <engine/records/boundary_normal.hpp>
#include <engine/resident/resident_outputs_builder.hpp>
#include <engine/resident/resident_tables.hpp>
#include <nearfield/on_device.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::resident {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;
using geometry::Vector;
using plan::PlannedQuery;
using plan::RecordsOutput;
using plan::ResidentOutputs;

std::uint32_t as_snorm(double number) {
    const auto steps =
        static_cast<std::int32_t>(std::lround(std::clamp(number, -1.0, 1.0) * 32767));
    return static_cast<std::uint32_t>(steps) & 0xffffU;
}

/// Grows `box` to contain the points of a query, or of one direction of it.
void extend_by_points(const plan::Plan& plan, const PlannedQuery& planned, Box& box) {
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const plan::PlannedPoints& points = planned.points();
    for (std::uint32_t i = points.first; i < points.end(); ++i) {
        box.extend(position(a, plan.points[i].point));
    }
}

/// How far the device's numbers may differ from exact ones (docs/resident_results.md): single
/// precision for lengths up to the extent of points, boundary and a tile.
double error_of_records(const PlannedQuery& planned, const Box& points) {
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double extent = points.merged(a.box()).merged(b.box()).diagonal().norm();
    constexpr double tile = 64.0;
    return std::ldexp(extent + tile * planned.budget.cell, -19) +
           4.0 * (localize::placement_rounding(a, a.box()) +
                  localize::placement_rounding(b, b.box()));
}

}  // namespace

void ResidentOutputsBuilder::build(const plan::Plan& plan,
                                   std::span<const plan::TileBatch> tile_batches,
                                   std::span<const AnyResult> results, ResidentOutputs& resident) {
    resident.clear();
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
            add_records(plan, tile_batches, query, resident);
        }
    }
}

void ResidentOutputsBuilder::find_field_parts(const plan::Plan& plan,
                                              std::span<const plan::TileBatch> tile_batches) {
    parts_.clear();
    for (std::uint32_t number = 0; number < tile_batches.size(); ++number) {
        const plan::TileBatch& batch = tile_batches[number];
        if (!batch.resident) {
            continue;
        }
        for (const plan::FieldTile& field : batch.field_tiles) {
            const plan::Tile& tile = plan.tiles[batch.tile_index[field.tile]];
            if (!plan.queries[tile.query].on_device) {
                continue;
            }
            const std::uint32_t corner = tile.halo * tile.width + tile.halo;
            plan::FieldPartOutput part;
            part.tile_batch = number;
            part.value = field.first_value + corner;
            const bool has_features =
                std::get<DistanceFieldQuery>(*plan.queries[tile.query].query).features_on_device;
            part.feature = has_features ? field.first_feature + corner : plan::not_asked;
            part.stride = tile.width;
            part.width = tile.width - 2 * tile.halo;
            part.height = tile.height - 2 * tile.halo;
            part.column = static_cast<std::uint32_t>(tile.column);
            part.row = static_cast<std::uint32_t>(tile.row);
            parts_.emplace_back(tile.query, part);
        }
    }
    std::sort(parts_.begin(), parts_.end(), [](const auto& i, const auto& j) {
        return i.first != j.first             ? i.first < j.first
               : i.second.row != j.second.row ? i.second.row < j.second.row
                                              : i.second.column < j.second.column;
    });
}

void ResidentOutputsBuilder::add_field(const PlannedQuery& planned, std::uint32_t query,
                                       const DistanceFieldResult& result,
                                       ResidentOutputs& resident) {
    plan::FieldOutputs& field = resident.fields.emplace_back();
    field.query = query;
    field.width = result.width;
    field.height = result.height;
    field.origin = geometry::to_vector(result.origin);
    field.cell = result.cell;
    field.error_bound = planned.budget.bound + plan::far_rounding * planned.field().farthest;
    const auto& asked = std::get<DistanceFieldQuery>(*planned.query);
    if (asked.target != nullptr) {
        field.target = *asked.target;
    }
    field.has_features = asked.features_on_device;
    field.rings = add_rings(*planned.b, resident);
    field.first_part = static_cast<std::uint32_t>(resident.field_parts.size());
    const auto first = std::partition_point(
        parts_.begin(), parts_.end(), [query](const auto& part) { return part.first < query; });
    for (auto part = first; part != parts_.end() && part->first == query; ++part) {
        resident.field_parts.push_back(part->second);
    }
    field.part_count = static_cast<std::uint32_t>(resident.field_parts.size()) - field.first_part;
}

void ResidentOutputsBuilder::add_records(const plan::Plan& plan,
                                         std::span<const plan::TileBatch> tile_batches,
                                         std::uint32_t query, ResidentOutputs& resident) {
    const PlannedQuery& planned = plan.queries[query];
    const std::uint32_t other = planned.points().reverse;
    const PlannedQuery* const reverse =
        other == plan::PlannedPoints::none ? nullptr : &plan.queries[other];
    Box box;
    extend_by_points(plan, planned, box);
    if (reverse != nullptr) {
        extend_by_points(plan, *reverse, box);
    }
    RecordsOutput& records = resident.records.emplace_back();
    records.query = query;
    records.cell = planned.budget.cell;
    // Whole, so that rounding of the sum costs no point; and within 64 bits, in bytes.
    records.max_capacity = std::min(
        std::ceil(plan::max_points(planned) + (reverse == nullptr ? 0.0 : max_points(*reverse))),
        std::ldexp(1.0, 53));
    records.error_bound = error_of_records(planned, box);
    records.first_run = static_cast<std::uint32_t>(resident.point_runs.size());
    if (!box.isEmpty()) {
        records.origin = box.center();
    }
    const BufferTarget* target = nullptr;
    if (const auto* const contacts = std::get_if<ContactQuery>(planned.query)) {
        records.near = static_cast<float>(contacts->contact_distance);
        target = contacts->target;
    } else {
        target = std::get<PenetrationQuery>(*planned.query).target;
    }
    if (target != nullptr) {
        records.target = *target;
    }
    add_runs(plan, tile_batches, planned, 0, resident);
    if (reverse != nullptr) {
        b_.reset();
        add_runs(plan, tile_batches, *reverse, point_flags::on_b, resident);
    }
}

void ResidentOutputsBuilder::add_runs(const plan::Plan& plan,
                                      std::span<const plan::TileBatch> tile_batches,
                                      const PlannedQuery& planned, std::uint32_t flags,
                                      ResidentOutputs& resident) {
    RecordsOutput& records = resident.records.back();
    const std::uint32_t first_place = records.capacity;
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const plan::PlannedPoints& points = planned.points();
    plan::PointRunOutput run;
    run.rings = add_rings(*planned.b, resident);
    run.flags = flags;
    for (run.tile_batch = 0; run.tile_batch < tile_batches.size(); ++run.tile_batch) {
        const std::vector<std::uint32_t>& index = tile_batches[run.tile_batch].point_index;
        const auto begin = std::lower_bound(index.begin(), index.end(), points.first);
        const auto end = std::lower_bound(begin, index.end(), points.end());
        if (begin == end) {
            continue;
        }
        run.first = static_cast<std::uint32_t>(begin - index.begin());
        run.count = static_cast<std::uint32_t>(end - begin);
        run.first_block = records.block_count;
        run.table = static_cast<std::uint32_t>(resident.tables.size());
        for (auto i = begin; i != end; ++i) {
            const plan::BoundaryPoint& point = plan.points[*i].point;
            const Vector place = position(a, point) - records.origin;
            add_position(place, resident);
            resident.tables.push_back(flags == 0 ? 0U : normal_at(planned, point));
            resident.tables.push_back(first_place + *i - points.first);
        }
        records.block_count += run.blocks();
        records.capacity += run.count;
        ++records.run_count;
        resident.point_runs.push_back(run);
    }
}

/// The normal at a point of B's boundary, for queries about B's points in the field of A.
std::uint32_t ResidentOutputsBuilder::normal_at(const PlannedQuery& planned,
                                                const plan::BoundaryPoint& point) {
    if (!b_) {
        boundary_.set(b_.emplace(*planned.a, planned.pose_a));
    }
    const Vector normal = records::outward_normal_at(boundary_, point);
    return as_snorm(normal.x()) | as_snorm(normal.y()) << 16U;
}

}  // namespace nearfield::resident
