#include <engine/base/interruption.hpp>
#include <engine/cpu/transformed_pair.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/plan/empty_result.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/query_timer.hpp>
#include <engine/records/intersection_samples.hpp>
#include <engine/results/query_answers.hpp>

namespace nearfield::results {

using geometry::TransformedPolygon;
using plan::PlannedQuery;

records::QueryPoints DeviceAnswers::points_of(const plan::Plan& plan, std::uint32_t query) const {
    const PlannedQuery& planned = plan.queries[query];
    if (planned.has_points_of(plan::PointSource::device)) {
        return pairs.points(query);
    }
    const plan::PlannedPoints& points = planned.points();
    return {.points = std::span(plan.points).subspan(points.first, points.count),
            .words = std::span(words).subspan(points.first, points.count),
            .tiles = plan.tiles};
}

/// Adds the effort to the result's statistics if the test uses hierarchies.
bool QueryAnswers::shapes_intersect(const Asked& asked, ResultSummary& result) {
    const PlannedQuery& query = asked.planned();
    if (query.technique == Technique::cpu || query.has_points_of(plan::PointSource::device)) {
        return intersection_test_.intersect(query, instances_);
    }
    localize::Effort effort;
    const bool answer = localize::intersects(TransformedPolygon(*query.a, query.pose_a),
                                             TransformedPolygon(*query.b, query.pose_b),
                                             asked.plan.bounding_volume, &effort);
    result.localization.nodes_evaluated += effort.nodes_evaluated;
    result.localization.pairs_rejected += effort.pairs_rejected;
    return answer;
}

void QueryAnswers::begin_batch() {
    instances_.begin_batch();
    simplified_.clear();
    penetration_.begin_batch();
    searched_ = nullptr;
}

void QueryAnswers::find_points(const Asked& asked) {
    const PlannedQuery& planned = asked.planned();
    if (!planned.has_points_of(plan::PointSource::planner)) {
        return;
    }
    exact_points_.answer(asked.plan, planned, instances_, asked.device.words);
    const std::uint32_t reverse = planned.points().reverse;
    if (reverse != plan::PlannedPoints::none) {
        exact_points_.answer(asked.plan, asked.plan.queries[reverse], instances_,
                             asked.device.words);
    }
}

void QueryAnswers::answer(const Asked& asked, PenetrationResult& result) {
    const PlannedQuery& planned = asked.planned();
    const bool is_searched = planned.has_points_of(plan::PointSource::device);
    if (planned.has_points_of(plan::PointSource::brute_force) ||
        (is_searched && asked.device.pairs.are_left_to_cpu())) {
        result.regions.clear();  // of a search
        penetration_.answer(planned, instances_, result);
        return;
    }
    if (is_searched) {
        answer_by_search(asked, result);
        return;
    }
    resolver_.begin(planned, asked.device.points_of(asked.plan, asked.query));
    if (!std::get<PenetrationQuery>(*planned.query).summary_only) {
        list_penetrations(result);
    } else {
        take_summary(resolver_.summarize_penetration(result.tolerance), result);
    }
    result.intersects = result.count > 0 || shapes_intersect(asked, result);
}

void QueryAnswers::take_summary(const records::PenetrationSummary& summary,
                                PenetrationResult& result) {
    result.count = summary.count;
    result.deepest = summary.deepest;
}

/// Of the resolver's points.
void QueryAnswers::list_penetrations(PenetrationResult& result) {
    const std::size_t deepest = resolver_.list_penetrations(result.tolerance, result.points);
    result.count = static_cast<std::uint32_t>(result.points.size());
    if (result.count > 0) {
        result.deepest = result.points[deepest];
    }
}

/// From what the device has found.
void QueryAnswers::answer_by_search(const Asked& asked, PenetrationResult& result) {
    const PlannedQuery& planned = asked.planned();
    const plan::PairRowData* const row = asked.device.pairs.row(asked.query);
    if (row != nullptr && decode::FoundPairs::is_summary(*row)) {
        take_summary(resolver_.summarize_penetration(planned, *row, result.tolerance), result);
    } else if (row != nullptr) {
        resolver_.begin(planned, asked.device.pairs.points(asked.query));
        if (planned.points().summarized) {
            take_summary(resolver_.summarize_penetration(result.tolerance), result);
        } else {
            list_penetrations(result);
        }
    }
    const bool is_known = searched_ != nullptr && cpu::is_reverse(*searched_, planned);
    result.intersects =
        result.count > 0 || (is_known ? searched_intersect_ : shapes_intersect(asked, result));
    searched_ = &planned;
    searched_intersect_ = result.intersects;
}

void QueryAnswers::answer(const Asked& asked, IntersectionResult& result) {
    const PlannedQuery& planned = asked.planned();
    if (planned.technique == Technique::cpu) {
        overlaps_.answer(asked.plan, planned, simplified_, result);
    }
    result.area = static_cast<double>(result.count) * result.cell * result.cell;
    result.intersects = shapes_intersect(asked, result);
}

void QueryAnswers::answer(const Asked& asked, DistanceFieldResult& result) {
    const PlannedQuery& planned = asked.planned();
    result.intersects = planned.a != nullptr && shapes_intersect(asked, result);
    if (planned.technique == Technique::cpu) {
        asked.fields.set_largest(asked.query,
                                 exact_fields_.answer(asked.plan, planned, simplified_, result));
    }
    asked.fields.finish(planned, asked.query, result);
}

void QueryAnswers::answer(const Asked& asked, ContactResult& result) {
    const PlannedQuery& planned = asked.planned();
    const bool is_left_to_cpu =
        planned.has_points_of(plan::PointSource::device) && asked.device.pairs.are_left_to_cpu();
    if (planned.has_points_of(plan::PointSource::brute_force) || is_left_to_cpu) {
        result.regions.clear();  // of a search
        contacts_.answer(planned, instances_, result);
        return;
    }
    const auto& query = std::get<ContactQuery>(*planned.query);
    if (query.normals == ContactNormals::analytic) {
        const std::uint32_t reverse = planned.points().reverse;
        contact_decoder_.find(
            {planned, asked.device.points_of(asked.plan, asked.query)},
            {asked.plan.queries[reverse], asked.device.points_of(asked.plan, reverse)}, result.cell,
            found_contacts_);
        found_contacts_.write(*planned.a, *planned.b, query, result);
    }
    result.intersects = shapes_intersect(asked, result);
}

void QueryAnswers::answer(const Asked& asked, ClosestPointResult& result) {
    closest_.decode(asked.plan, asked.planned(), asked.device.words, instances_, result);
}

void QueryAnswers::answer(const Asked& asked, SeparationResult& result) {
    closest_.decode(asked.plan, asked.planned(), asked.device.words, instances_, result);
}

void QueryAnswers::answer(const Asked& asked, IntersectionTestResult& result) {
    intersection_test_.answer(asked.planned(), instances_, result);
}

void QueryAnswers::answer(const Asked& asked, TimeOfImpactResult& result) {
    time_of_impact_.answer(asked.planned(), result);
}

void QueryAnswers::answer(const Asked& asked, SeparationVectorResult& result) {
    separation_vector_.answer(asked.planned(), instances_, result);
}

void QueryAnswers::answer(const Asked& asked, ContainmentResult& result) {
    containment_.answer(asked.planned(), instances_, result);
}

std::size_t QueryAnswers::write(const plan::Plan& plan, std::size_t first, std::size_t end,
                                bool on_cpu, DeviceAnswers& device, decode::FieldDecoder& fields,
                                std::vector<AnyResult>& results) {
    std::size_t count = 0;
    for (std::size_t i = first; i < end; ++i) {
        if ((plan.queries[i].technique == Technique::cpu) != on_cpu) {
            continue;
        }
        ++count;
        const plan::QueryTimer timer(plan.times, i, &QueryTime::answer);
        try {
            write({plan, static_cast<std::uint32_t>(i), device, fields}, on_cpu, results[i]);
        } catch (const Interrupted& interrupted) {
            plan::cut_short(interrupted.status(), results[i]);
        }
    }
    return count;
}

void QueryAnswers::write(const Asked& asked, bool on_cpu, AnyResult& any) {
    std::visit(
        [&](auto& result) {
            if (!result.status.ok()) {
                return;
            }
            checkpoint();
            if (on_cpu) {
                find_points(asked);
            }
            answer(asked, result);
            finish_answers(1);
        },
        any);
}

}  // namespace nearfield::results
