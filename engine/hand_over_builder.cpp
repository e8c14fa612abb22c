#include <engine/boundary_normal.hpp>
#include <engine/hand_over_builder.hpp>
#include <engine/hand_over_tables.hpp>
#include <engine/localize/hierarchy.hpp>
#include <nearfield/resident.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {
namespace {

using geometry::Box;
using geometry::PlacedPolygon;
using geometry::Vector;
using plan::HandOver;
using plan::PlannedQuery;
using plan::RecordsHandOver;

std::uint32_t as_snorm(double number) {
    const auto steps =
        static_cast<std::int32_t>(std::lround(std::clamp(number, -1.0, 1.0) * 32767));
    return static_cast<std::uint32_t>(steps) & 0xffffU;
}

/// Around the points of a query, or of one direction of it; grows `box`.
void extend_by_points(const plan::Plan& plan, const PlannedQuery& planned, Box& box) {
    const PlacedPolygon a(*planned.a, planned.pose_a);
    for (std::uint32_t i = 0; i < planned.point_count; ++i) {
        box.extend(position(a, plan.points[planned.first_point + i].point));
    }
}

/// By how much the device's numbers may differ from exact ones (docs/resident_results.md): in
/// single precision, of lengths up to the extent of points and boundary and a tile.
double error_of_records(const PlannedQuery& planned, const Box& points) {
    const PlacedPolygon a(*planned.a, planned.pose_a);
    const PlacedPolygon b(*planned.b, planned.pose_b);
    const double extent = points.merged(a.box()).merged(b.box()).diagonal().norm();
    constexpr double tile = 64.0;
    return std::ldexp(extent + tile * planned.budget.cell, -19) +
           4.0 * (localize::placement_rounding(a, a.box()) +
                  localize::placement_rounding(b, b.box()));
}

}  // namespace

void HandOverBuilder::build(const plan::Plan& plan, std::span<const plan::Round> rounds,
                            std::span<const AnyResult> results, HandOver& hand_over) {
    hand_over.clear();
    find_field_parts(plan, rounds);
    samples_.begin();
    for (const std::uint32_t query : plan.resident) {
        const PlannedQuery& planned = plan.queries[query];
        const auto is_usable = [](const auto& result) { return result.status.ok(); };
        if (!std::visit(is_usable, results[query])) {
            continue;
        }
        if (const auto* const field = std::get_if<DistanceFieldResult>(&results[query])) {
            add_field(planned, query, *field, hand_over);
        } else if (const auto* const overlap = std::get_if<IntersectionResult>(&results[query])) {
            samples_.add(plan, rounds, query, *overlap, hand_over);
        } else {
            add_records(plan, rounds, query, hand_over);
        }
    }
}

void HandOverBuilder::find_field_parts(const plan::Plan& plan,
                                       std::span<const plan::Round> rounds) {
    parts_.clear();
    for (std::uint32_t number = 0; number < rounds.size(); ++number) {
        const plan::Round& round = rounds[number];
        if (!round.resident) {
            continue;
        }
        for (const plan::TileDraw& draw : round.distance_draws) {
            const plan::Tile& tile = plan.tiles[round.tile_index[draw.tile]];
            if (!draw.field || !plan.queries[tile.query].resident) {
                continue;
            }
            const std::uint32_t corner = tile.halo * tile.width + tile.halo;
            plan::FieldPartHandOver part;
            part.round = number;
            part.value = draw.first_value + corner;
            part.feature = draw.first_feature + corner;
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

void HandOverBuilder::add_field(const PlannedQuery& planned, std::uint32_t query,
                                const DistanceFieldResult& result, HandOver& hand_over) {
    plan::FieldHandOver& field = hand_over.fields.emplace_back();
    field.query = query;
    field.width = result.width;
    field.height = result.height;
    field.origin = geometry::to_vector(result.origin);
    field.cell = result.cell;
    field.error_bound = planned.budget.bound + plan::far_rounding * planned.farthest;
    field.rings = add_rings(*planned.b, hand_over);
    field.first_part = static_cast<std::uint32_t>(hand_over.field_parts.size());
    const auto first = std::partition_point(
        parts_.begin(), parts_.end(), [query](const auto& part) { return part.first < query; });
    for (auto part = first; part != parts_.end() && part->first == query; ++part) {
        hand_over.field_parts.push_back(part->second);
    }
    field.part_count = static_cast<std::uint32_t>(hand_over.field_parts.size()) - field.first_part;
}

void HandOverBuilder::add_records(const plan::Plan& plan, std::span<const plan::Round> rounds,
                                  std::uint32_t query, HandOver& hand_over) {
    const PlannedQuery& planned = plan.queries[query];
    const PlannedQuery* const reverse =
        planned.reverse == PlannedQuery::none ? nullptr : &plan.queries[planned.reverse];
    Box box;
    extend_by_points(plan, planned, box);
    if (reverse != nullptr) {
        extend_by_points(plan, *reverse, box);
    }
    RecordsHandOver& records = hand_over.records.emplace_back();
    records.query = query;
    records.cell = planned.budget.cell;
    records.error_bound = error_of_records(planned, box);
    records.first_run = static_cast<std::uint32_t>(hand_over.point_runs.size());
    if (!box.isEmpty()) {
        records.origin = box.center();
    }
    if (const auto* const contacts = std::get_if<ContactQuery>(planned.query)) {
        records.near = static_cast<float>(contacts->contact_distance);
    }
    add_runs(plan, rounds, planned, 0, hand_over);
    if (reverse != nullptr) {
        b_.reset();
        add_runs(plan, rounds, *reverse, resident_flags::on_b, hand_over);
    }
}

void HandOverBuilder::add_runs(const plan::Plan& plan, std::span<const plan::Round> rounds,
                               const PlannedQuery& planned, std::uint32_t flags,
                               HandOver& hand_over) {
    RecordsHandOver& records = hand_over.records.back();
    const std::uint32_t first_place = records.capacity;
    const PlacedPolygon a(*planned.a, planned.pose_a);
    plan::PointRunHandOver run;
    run.rings = add_rings(*planned.b, hand_over);
    run.flags = flags;
    for (run.round = 0; run.round < rounds.size(); ++run.round) {
        const std::vector<std::uint32_t>& index = rounds[run.round].point_index;
        const auto begin = std::lower_bound(index.begin(), index.end(), planned.first_point);
        const auto end =
            std::lower_bound(begin, index.end(), planned.first_point + planned.point_count);
        if (begin == end) {
            continue;
        }
        run.first = static_cast<std::uint32_t>(begin - index.begin());
        run.count = static_cast<std::uint32_t>(end - begin);
        run.first_block = records.block_count;
        run.table = static_cast<std::uint32_t>(hand_over.tables.size());
        for (auto i = begin; i != end; ++i) {
            const plan::BoundaryPoint& point = plan.points[*i].point;
            const Vector place = position(a, point) - records.origin;
            add_position(place, hand_over);
            hand_over.tables.push_back(flags == 0 ? 0U : normal_at(planned, point));
            hand_over.tables.push_back(first_place + *i - planned.first_point);
        }
        records.block_count += run.blocks();
        records.capacity += run.count;
        ++records.run_count;
        hand_over.point_runs.push_back(run);
    }
}

/// Of B's boundary, whose points in the field of A the query asks for.
std::uint32_t HandOverBuilder::normal_at(const PlannedQuery& planned,
                                         const plan::BoundaryPoint& point) {
    if (!b_) {
        boundary_.set(b_.emplace(*planned.a, planned.pose_a));
    }
    const Vector normal = outward_normal_at(boundary_, point);
    return as_snorm(normal.x()) | as_snorm(normal.y()) << 16U;
}

}  // namespace nearfield
