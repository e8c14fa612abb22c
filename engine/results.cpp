#include <engine/geometry/segment.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/results.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace nearfield {
namespace {

using geometry::PlacedPolygon;
using geometry::Vector;
using plan::PlannedPoint;
using plan::PlannedQuery;
using plan::Tile;

/// Deeper than this many cells, single precision cannot tell apart what differs by a thousandth of
/// d: which edge is nearest is decided once more, in double precision.
constexpr double deepest_in_single_precision = 1024.0;

/// The record of a point whose nearest edge of B is known, in double precision.
PenetrationRecord make_record(const PlacedPolygon& b, const Vector& point, std::uint32_t edge,
                              bool unique) {
    const auto nearest = nearest_on_edge(b, edge, point);
    PenetrationRecord record;
    record.point = geometry::to_public(point);
    record.depth = std::sqrt(nearest.squared_distance);
    record.nearest = geometry::to_public(nearest.point);
    record.direction = geometry::to_public((nearest.point - point) / record.depth);
    record.unique = unique;
    record.feature = feature_at(b, edge, nearest.parameter);
    return record;
}

/// The record of a point very deep inside B, from all of B's edges.
PenetrationRecord make_deep_record(const PlacedPolygon& b, const Vector& point, double margin) {
    std::uint32_t nearest = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t edge = 0; edge < b.polygon().size(); ++edge) {
        const double squared = nearest_on_edge(b, edge, point).squared_distance;
        if (squared < best) {
            best = squared;
            nearest = edge;
        }
    }
    PenetrationRecord record = make_record(b, point, nearest, true);
    // As in resolve_points.comp: a rival is as near and farther away than the same wall explains.
    const double limit = record.depth + margin;
    const double along_wall = limit * limit - best;
    for (std::uint32_t edge = 0; edge < b.polygon().size(); ++edge) {
        const auto other = nearest_on_edge(b, edge, point);
        const Vector apart = other.point - geometry::to_vector(record.nearest);
        if (other.squared_distance <= limit * limit && apart.squaredNorm() > 4.0 * along_wall) {
            record.unique = false;
        }
    }
    return record;
}

/// The edge of A nearest to a point, among a run of edges.
std::uint32_t nearest_edge(const PlannedQuery& query, plan::EdgeRun run, const Vector& point) {
    if (run.count == 1) {
        return run.first;
    }
    const PlacedPolygon a(*query.a, query.pose_a);
    std::uint32_t nearest = run.first;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t edge = run.first; edge < run.first + run.count; ++edge) {
        const double squared =
            geometry::nearest_on_segment(point, a.vertex(edge), a.vertex(a.polygon().next(edge)))
                .squared_distance;
        if (squared < best) {
            best = squared;
            nearest = edge;
        }
    }
    return nearest;
}

bool shapes_intersect(const PlannedQuery& query) {
    return localize::intersects(PlacedPolygon(*query.a, query.pose_a),
                                PlacedPolygon(*query.b, query.pose_b));
}

}  // namespace

void ResultDecoder::begin_batch(const plan::Plan& plan) {
    words_.resize(plan.points.size());
    samples_.clear();
    fields_.begin_batch(plan);
}

void ResultDecoder::add_points(const plan::Round& round, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        words_[round.point_index[i]] = words[i];
    }
}

void ResultDecoder::add_samples(const plan::Plan& plan, const plan::Round& round,
                                std::span<const plan::SampleData> samples) {
    for (const plan::SampleData& sample : samples) {
        const std::uint32_t index = round.tile_index[sample.tile];
        const Tile& tile = plan.tiles[index];
        samples_.push_back({tile.query, tile.region, tile.row + (sample.cell >> 16U),
                            tile.column + (sample.cell & 0xffffU), index,
                            round.runs.empty() ? plan::EdgeRun{} : round.runs[sample.run]});
    }
}

void ResultDecoder::finish_penetration(const plan::Plan& plan, const PlannedQuery& planned,
                                       PenetrationResult& result) const {
    const bool keep = std::get<PenetrationQuery>(*planned.query).records;
    const PlacedPolygon a(*planned.a, planned.pose_a);
    const PlacedPolygon b(*planned.b, planned.pose_b);
    for (std::uint32_t i = planned.first_point; i < planned.first_point + planned.point_count;
         ++i) {
        const std::uint32_t word = words_[i];
        if ((word & plan::point_inside) == 0) {
            continue;
        }
        const PlannedPoint& point = plan.points[i];
        const Vector p = position(a, point.point);
        PenetrationRecord record =
            make_record(b, p, word & plan::point_edge_mask, (word & plan::point_unique) != 0);
        if (record.depth > deepest_in_single_precision * planned.budget.cell) {
            record = make_deep_record(b, p, result.tolerance * plan::uniqueness_margin);
        }
        if (record.depth <= touching_distance(plan.tiles[point.tile])) {
            continue;
        }
        if (result.count == 0 || record.depth > result.deepest.depth) {
            result.deepest = record;
        }
        ++result.count;
        if (keep) {
            result.records.push_back(record);
        }
    }
    result.intersects = result.count > 0 || shapes_intersect(planned);
}

void ResultDecoder::finish_intersections(const plan::Plan& plan, std::vector<AnyResult>& results) {
    // The device found them in no particular order; the result has one.
    std::sort(samples_.begin(), samples_.end(), [](const FoundSample& i, const FoundSample& j) {
        return std::tie(i.query, i.region, i.row, i.column) <
               std::tie(j.query, j.region, j.row, j.column);
    });
    for (const FoundSample& sample : samples_) {
        const auto& query = std::get<IntersectionQuery>(*plan.queries[sample.query].query);
        auto& result = std::get<IntersectionResult>(results[sample.query]);
        ++result.count;
        if (query.records) {
            const plan::Grid& grid = plan.tiles[sample.tile].grid;
            const Vector centre(static_cast<double>(sample.column) + 0.5,
                                static_cast<double>(sample.row) + 0.5);
            const Vector point = grid.origin + grid.cell * centre;
            const bool by_edge = query.kind != IntersectionKind::volume_volume;
            result.samples.push_back(
                {geometry::to_public(point),
                 by_edge ? nearest_edge(plan.queries[sample.query], sample.run, point)
                         : IntersectionSample::no_edge});
        }
    }
}

void ResultDecoder::finish(const plan::Plan& plan, std::vector<AnyResult>& results) {
    finish_intersections(plan, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
        const PlannedQuery& planned = plan.queries[i];
        if (auto* penetration = std::get_if<PenetrationResult>(&results[i])) {
            if (penetration->status.ok()) {
                finish_penetration(plan, planned, *penetration);
            }
        } else if (auto* intersection = std::get_if<IntersectionResult>(&results[i])) {
            if (intersection->status.ok()) {
                intersection->area = static_cast<double>(intersection->count) * intersection->cell *
                                     intersection->cell;
                intersection->intersects = shapes_intersect(planned);
            }
        } else if (auto* field = std::get_if<DistanceFieldResult>(&results[i])) {
            if (field->status.ok()) {
                field->intersects = planned.a != nullptr && shapes_intersect(planned);
                fields_.finish(planned, static_cast<std::uint32_t>(i), *field);
            }
        }
    }
}

}  // namespace nearfield
