#include <engine/base/interruption.hpp>
#include <engine/batch/result_writer.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/queries/query_timer.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace nearfield::batch {
namespace {

using device_input::PlannedQuery;
using geometry::TransformedPolygon;

/// The least distance at the rendered points of one direction.
double sampled_distance(const device_input::Plan& plan, const PlannedQuery& query,
                        const DeviceAnswers& answers) {
    const TransformedPolygon a(*query.a, query.pose_a);
    const TransformedPolygon b(*query.b, query.pose_b);
    double squared = std::numeric_limits<double>::infinity();
    SparseCheckpoint<256> checkpoint;
    const device_input::PlannedPoints& points = query.points();
    const std::span<const std::uint32_t> words = answers.words_of(points);
    for (std::uint32_t i = 0; i < points.count; ++i) {
        checkpoint.step();
        if ((words[i] & shaders::point_resolved) != 0) {
            const std::uint32_t edge = words[i] & shaders::point_edge_mask;
            const auto nearest =
                geometry::nearest_on_segment(position(a, plan.points[points.first + i].point),
                                             b.vertex(edge), b.vertex(b.polygon().next(edge)));
            squared = std::min(squared, nearest.squared_distance);
        }
    }
    return std::sqrt(squared);
}

/// Counts the memory of points that a result lists: how many there are is known once the search has
/// found them.
void require_room(const PlannedQuery& query, std::size_t points, std::size_t bytes_of_point,
                  double tolerance, queries::MemoryBudget& memory) {
    queries::QueryMemory(memory, query.index, tolerance)
        .require(static_cast<double>(points * bytes_of_point), 1.0);
}

void take_summary(const PenetrationSummary& summary, PenetrationResult& result) {
    result.count = summary.count;
    result.deepest = summary.deepest;
}

}  // namespace

bool ResultWriter::shapes_intersect(const Input& input) {
    return queries::intersect(input.planned, workspace_.instances, overlap_test_);
}

void ResultWriter::write(const Input& input, PenetrationResult& result) {
    const PlannedQuery& planned = input.planned;
    if (planned.has_points_of(device_input::PointSource::device)) {
        write_searched(input, result);
        return;
    }
    const queries::PlacedPair pair = queries::place_pair(planned, workspace_.instances);
    resolver_.begin(planned, workspace_.instances[pair.a].placed,
                    workspace_.instances[pair.b].placed,
                    input.answers.points_of(input.plan, planned.index));
    if (!std::get<PenetrationQuery>(*planned.query).summary_only) {
        list_penetrations(result);
    } else {
        take_summary(resolver_.summarize_penetration(result.tolerance), result);
    }
    result.intersects = result.count > 0 || shapes_intersect(input);
}

/// Of the resolver's points.
void ResultWriter::list_penetrations(PenetrationResult& result) {
    const std::size_t deepest = resolver_.list_penetrations(result.tolerance, result.points);
    result.count = static_cast<std::uint32_t>(result.points.size());
    if (result.count > 0) {
        result.deepest = result.points[deepest];
    }
}

/// From what the device's search has found.
void ResultWriter::write_searched(const Input& input, PenetrationResult& result) {
    const PlannedQuery& planned = input.planned;
    const FoundPairs& pairs = input.answers.pairs();
    const shaders::PairRowData* const row = pairs.row(planned.index);
    const queries::PlacedPair pair = queries::place_pair(planned, workspace_.instances);
    const TransformedPolygon& a = workspace_.instances[pair.a].placed;
    const TransformedPolygon& b = workspace_.instances[pair.b].placed;
    if (row != nullptr && FoundPairs::is_summary(*row)) {
        take_summary(resolver_.summarize_penetration(planned, a, b, *row, result.tolerance),
                     result);
    } else if (row != nullptr) {
        resolver_.begin(planned, a, b, pairs.points(planned.index));
        if (planned.points().summarized) {
            take_summary(resolver_.summarize_penetration(result.tolerance), result);
        } else {
            require_room(planned, row->point_count, sizeof(PenetratingPoint), result.tolerance,
                         input.memory);
            list_penetrations(result);
        }
    }
    const auto [low, high] = std::minmax(pair.a, pair.b);
    KnownPair& known = known_[(low * std::size_t{0x9e3779b1} + high) % known_.size()];
    if (known.low != low || known.high != high) {
        known = {low, high,
                 result.count > 0 || queries::intersect(pair, workspace_.instances, overlap_test_)};
    }
    result.intersects = result.count > 0 || known.intersects;
}

void ResultWriter::write(const Input& input, IntersectionResult& result) {
    result.area = static_cast<double>(result.count) * result.cell * result.cell;
    result.intersects = shapes_intersect(input);
}

void ResultWriter::write(const Input& input, DistanceFieldResult& result) {
    result.intersects = input.planned.a != nullptr && shapes_intersect(input);
    input.answers.fields().finish(input.planned, result);
}

void ResultWriter::write(const Input& input, ContactResult& result) {
    const PlannedQuery& planned = input.planned;
    const auto& query = std::get<ContactQuery>(*planned.query);
    const std::uint32_t reverse = planned.points().reverse;
    const QueryPoints of_a = input.answers.points_of(input.plan, planned.index);
    const QueryPoints of_b = input.answers.points_of(input.plan, reverse);
    if (!query.summary_only) {
        require_room(planned, of_a.found.size() + of_b.found.size(), sizeof(ContactPoint),
                     result.tolerance, input.memory);
    }
    contact_decoder_.find({planned, of_a}, {input.plan.queries[reverse], of_b}, result.cell,
                          found_contacts_);
    if (query.normals == ContactNormals::gradient) {
        result.status = normals_.set(planned, result.cell, workspace_, found_contacts_);
    }
    if (result.status.ok()) {
        found_contacts_.write(*planned.a, *planned.b, query, result);
    }
    result.intersects = shapes_intersect(input);
}

void ResultWriter::write(const Input& input, SeparationResult& result) {
    const PlannedQuery& planned = input.planned;
    const queries::PlacedPair pair = queries::place_pair(planned, workspace_.instances);
    queries::prepare(pair, workspace_.instances);
    double sampled = std::numeric_limits<double>::infinity();
    if (!result.intersects) {
        sampled = sampled_distance(input.plan, planned, input.answers);
        const std::uint32_t reverse = planned.points().reverse;
        if (reverse != device_input::PlannedPoints::none) {
            sampled = std::min(
                sampled, sampled_distance(input.plan, input.plan.queries[reverse], input.answers));
        }
    }
    closest_.answer(planned, workspace_.instances[pair.a], workspace_.instances[pair.b],
                    {result.intersects, sampled}, result);
}

void ResultWriter::write(const Input& input, ClosestPointResult& result) {
    SeparationResult separation;
    static_cast<ResultSummary&>(separation) = std::move(static_cast<ResultSummary&>(result));
    write(input, separation);
    solvers::take_closest_point(std::move(separation), result);
}

void ResultWriter::write(const device_input::Plan& plan, std::span<const std::uint32_t> queries,
                         DeviceAnswers& answers, queries::MemoryBudget& memory,
                         std::vector<AnyResult>& results) {
    answers.write_drawn_samples(results);
    // Other batches may have been answered in between.
    workspace_.instances.begin_batch();
    workspace_.simplified.clear();
    constexpr std::size_t most = 1024;
    known_.assign(std::bit_ceil(std::min(queries.size(), most)), {});
    for (const std::uint32_t index : queries) {
        const PlannedQuery& planned = plan.queries[index];
        if (answers.pairs().are_left_to_cpu() &&
            planned.has_points_of(device_input::PointSource::device)) {
            continue;
        }
        AnyResult& any = results[index];
        const queries::QueryTimer timer(plan.times, index, &QueryTime::answer);
        try {
            std::visit(
                [&](auto& result) {
                    if (result.status.ok()) {
                        checkpoint();
                        write({plan, planned, answers, memory}, result);
                        finish_answers(1);
                    }
                },
                any);
        } catch (const Interrupted& interrupted) {
            queries::cut_short(interrupted.status(), any);
        }
    }
}

}  // namespace nearfield::batch
