#include <engine/intersection_samples.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/results.hpp>

#include <algorithm>
#include <tuple>

namespace nearfield {
namespace {

using geometry::PlacedPolygon;
using plan::PlannedQuery;
using plan::Tile;

}  // namespace

/// Counts what it takes among the result's statistics, where hierarchies take it.
bool ResultDecoder::shapes_intersect(const plan::Plan& plan, const PlannedQuery& query,
                                     ResultSummary& result) {
    if (query.on_cpu) {
        return intersection_test_.intersect(query, instances_);
    }
    localize::Effort effort;
    const bool answer =
        localize::intersects(PlacedPolygon(*query.a, query.pose_a),
                             PlacedPolygon(*query.b, query.pose_b), plan.bounding_volume, &effort);
    result.localization.nodes_evaluated += effort.nodes_evaluated;
    result.localization.pairs_rejected += effort.pairs_rejected;
    return answer;
}

void ResultDecoder::begin_batch(const plan::Plan& plan) {
    words_.resize(plan.points.size());
    samples_.clear();
    instances_.clear();
    penetration_.begin_batch();
    simplified_.clear();
    fields_.begin_batch(plan);
}

void ResultDecoder::add_points(const plan::Round& round, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        words_[round.point_index[i]] = words[i];
    }
}

void ResultDecoder::add_summaries(const plan::Plan& plan, const plan::Round& round,
                                  std::span<const plan::TileSummary> summaries,
                                  std::vector<AnyResult>& results) {
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const Tile& tile = plan.tiles[round.tile_index[i]];
        if (tile.kind == plan::TileKind::overlap) {
            add_summary(tile, summaries[i], std::get<IntersectionResult>(results[tile.query]));
        }
    }
}

void ResultDecoder::add_samples(const plan::Plan& plan, const plan::Round& round,
                                std::span<const plan::SampleData> samples) {
    for (const plan::SampleData& sample : samples) {
        const std::uint32_t index = round.tile_index[sample.tile];
        const Tile& tile = plan.tiles[index];
        samples_.push_back(
            {tile.query, tile.region, tile.row + (sample.cell >> 16U),
             tile.column + (sample.cell & 0xffffU),
             make_sample(plan.queries[tile.query], tile, sample.cell & 0xffffU, sample.cell >> 16U,
                         round.runs.empty() ? plan::EdgeRun{} : round.runs[sample.run])});
    }
}

void ResultDecoder::finish_penetration(const plan::Plan& plan, const PlannedQuery& planned,
                                       PenetrationResult& result) {
    const bool keep = std::get<PenetrationQuery>(*planned.query).records;
    if (planned.edge_by_edge) {
        penetration_.answer(planned, instances_, result);
        return;
    }
    resolver_.begin(plan, planned);
    for (std::uint32_t i = planned.first_point; i < planned.first_point + planned.point_count;
         ++i) {
        if ((words_[i] & plan::point_inside) == 0) {
            continue;
        }
        const ResolvedPoint resolved = resolver_.resolve(plan.points[i], words_[i]);
        if (!resolved.inside) {
            continue;  // it touches the boundary
        }
        const PenetrationRecord record = penetration_record(resolved);
        if (result.count == 0 || record.depth > result.deepest.depth) {
            result.deepest = record;
        }
        ++result.count;
        if (keep) {
            result.records.push_back(record);
        }
    }
    result.intersects = result.count > 0 || shapes_intersect(plan, planned, result);
}

void ResultDecoder::write_drawn_samples(std::vector<AnyResult>& results) {
    // The device found them in no particular order; the result has one.
    std::sort(samples_.begin(), samples_.end(), [](const FoundSample& i, const FoundSample& j) {
        return std::tie(i.query, i.region, i.row, i.column) <
               std::tie(j.query, j.region, j.row, j.column);
    });
    for (const FoundSample& sample : samples_) {
        std::get<IntersectionResult>(results[sample.query]).samples.push_back(sample.sample);
    }
}

void ResultDecoder::answer_on_cpu(const plan::Plan& plan, std::vector<AnyResult>& results) {
    exact_points_.answer(plan, instances_, words_);
    finish_queries(plan, true, results);
}

void ResultDecoder::finish(const plan::Plan& plan, std::vector<AnyResult>& results) {
    write_drawn_samples(results);
    finish_queries(plan, false, results);
}

void ResultDecoder::finish_queries(const plan::Plan& plan, bool on_cpu,
                                   std::vector<AnyResult>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        const PlannedQuery& planned = plan.queries[i];
        if (planned.on_cpu != on_cpu) {
            continue;
        }
        if (auto* penetration = std::get_if<PenetrationResult>(&results[i])) {
            if (penetration->status.ok()) {
                finish_penetration(plan, planned, *penetration);
            }
        } else if (auto* intersection = std::get_if<IntersectionResult>(&results[i])) {
            if (intersection->status.ok()) {
                if (planned.on_cpu) {
                    overlaps_.answer(plan, planned, simplified_, *intersection);
                }
                intersection->area = static_cast<double>(intersection->count) * intersection->cell *
                                     intersection->cell;
                intersection->intersects = shapes_intersect(plan, planned, *intersection);
            }
        } else if (auto* field = std::get_if<DistanceFieldResult>(&results[i])) {
            if (field->status.ok()) {
                field->intersects = planned.a != nullptr && shapes_intersect(plan, planned, *field);
                const auto query = static_cast<std::uint32_t>(i);
                if (planned.on_cpu) {
                    fields_.set_largest(query,
                                        exact_fields_.answer(plan, planned, simplified_, *field));
                }
                fields_.finish(planned, query, *field);
            }
        } else if (auto* contact = std::get_if<ContactResult>(&results[i])) {
            if (contact->status.ok()) {
                if (std::get<ContactQuery>(*planned.query).normals == ContactNormals::analytic) {
                    contacts_.find(plan, planned, words_, contact->cell);
                    contacts_.write(planned, *contact);
                }
                contact->intersects = shapes_intersect(plan, planned, *contact);
            }
        } else if (auto* closest = std::get_if<ClosestPointResult>(&results[i])) {
            if (closest->status.ok()) {
                closest_.decode(plan, planned, words_, instances_, *closest);
            }
        } else if (auto* separation = std::get_if<SeparationResult>(&results[i])) {
            if (separation->status.ok()) {
                closest_.decode(plan, planned, words_, instances_, *separation);
            }
        } else if (auto* test = std::get_if<IntersectionTestResult>(&results[i])) {
            if (test->status.ok()) {
                intersection_test_.answer(planned, instances_, *test);
            }
        } else if (auto* impact = std::get_if<TimeOfImpactResult>(&results[i])) {
            if (impact->status.ok()) {
                time_of_impact_.answer(planned, *impact);
            }
        } else if (auto* vector = std::get_if<SeparationVectorResult>(&results[i])) {
            if (vector->status.ok()) {
                separation_vector_.answer(planned, instances_, *vector);
            }
        }
    }
}

}  // namespace nearfield
