#include <engine/intersection_samples.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/query_answers.hpp>

namespace nearfield {

using geometry::PlacedPolygon;
using plan::PlannedQuery;

/// Counts what it takes among the result's statistics, where hierarchies take it.
bool QueryAnswers::shapes_intersect(const plan::Plan& plan, const PlannedQuery& query,
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

void QueryAnswers::begin_batch() {
    instances_.clear();
    simplified_.clear();
    penetration_.begin_batch();
}

void QueryAnswers::find_points(const plan::Plan& plan, const PlannedQuery& planned,
                               std::span<std::uint32_t> words) {
    exact_points_.answer(plan, planned, instances_, words);
    if (planned.reverse != PlannedQuery::none) {
        exact_points_.answer(plan, plan.queries[planned.reverse], instances_, words);
    }
}

void QueryAnswers::finish_penetration(const plan::Plan& plan, const PlannedQuery& planned,
                                      std::span<const std::uint32_t> words,
                                      PenetrationResult& result) {
    const bool keep = std::get<PenetrationQuery>(*planned.query).records;
    if (planned.edge_by_edge) {
        penetration_.answer(planned, instances_, result);
        return;
    }
    resolver_.begin(plan, planned);
    for (std::uint32_t i = planned.first_point; i < planned.first_point + planned.point_count;
         ++i) {
        if ((words[i] & plan::point_inside) == 0) {
            continue;
        }
        const ResolvedPoint resolved = resolver_.resolve(plan.points[i], words[i]);
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

std::size_t QueryAnswers::write(const plan::Plan& plan, std::size_t first, std::size_t end,
                                bool on_cpu, std::span<std::uint32_t> words, FieldDecoder& fields,
                                std::vector<AnyResult>& results) {
    std::size_t count = 0;
    for (std::size_t i = first; i < end; ++i) {
        const PlannedQuery& planned = plan.queries[i];
        if (planned.on_cpu != on_cpu) {
            continue;
        }
        ++count;
        if (on_cpu) {
            find_points(plan, planned, words);
        }
        if (auto* penetration = std::get_if<PenetrationResult>(&results[i])) {
            if (penetration->status.ok()) {
                finish_penetration(plan, planned, words, *penetration);
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
                    fields.set_largest(query,
                                       exact_fields_.answer(plan, planned, simplified_, *field));
                }
                fields.finish(planned, query, *field);
            }
        } else if (auto* contact = std::get_if<ContactResult>(&results[i])) {
            if (contact->status.ok()) {
                if (std::get<ContactQuery>(*planned.query).normals == ContactNormals::analytic) {
                    contacts_.find(plan, planned, words, contact->cell);
                    contacts_.write(planned, *contact);
                }
                contact->intersects = shapes_intersect(plan, planned, *contact);
            }
        } else if (auto* closest = std::get_if<ClosestPointResult>(&results[i])) {
            if (closest->status.ok()) {
                closest_.decode(plan, planned, words, instances_, *closest);
            }
        } else if (auto* separation = std::get_if<SeparationResult>(&results[i])) {
            if (separation->status.ok()) {
                closest_.decode(plan, planned, words, instances_, *separation);
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
    return count;
}

}  // namespace nearfield
