#include <engine/base/interruption.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/toi/swept_box.hpp>

#include <algorithm>
#include <string>
#include <tuple>

namespace nearfield {
namespace {

using geometry::number;

/// So that the lists of their candidates stay small.
constexpr std::size_t sweeps_at_a_time = std::size_t{1} << 12U;

ShapeCastHit hit_of(const TimeOfImpactResult& result, InstanceHandle instance) {
    return {result.state,       instance,       result.time,    result.time_error_bound,
            result.error_bound, result.point_a, result.point_b, result.direction};
}

}  // namespace

void World::Implementation::find_candidates(const ShapeCastQuery& query,
                                            const geometry::Polygon& shape, const Sweep& sweep,
                                            std::vector<std::uint32_t>& found) const {
    const geometry::Box box =
        geometry::grown(toi::swept_box({shape, sweep.start, sweep.end}), query.contact_distance);
    const geometry::Box search = geometry::grown(box, instances_.max_rounding());
    instances_.boxes().for_meeting(search, [&](std::uint32_t index) {
        // Who is a candidate must not depend on the rounding of others.
        if (instances_.passes(index, query.filter) &&
            localize::boxes_meet(instances_.box(index), box, instances_.rounding(index))) {
            found.push_back(index);
        }
    });
}

void World::Implementation::add_candidate(const ShapeCastQuery& query, const Sweep& sweep,
                                          std::size_t number, std::uint32_t index) {
    TimeOfImpactQuery impact;
    impact.a = {query.shape, sweep.start};
    impact.end_a = sweep.end;
    impact.b = instance_of(index);
    impact.end_b = instances_[index].pose;
    impact.tolerance = query.tolerance;
    impact.contact_distance = query.contact_distance;
    batch_.add(impact);
    candidates_.push_back({number, index});
}

void World::Implementation::run_batch() {
    Status status = context_->run(batch_, results_);
    if (!status.ok()) {
        throw StatusException(status);
    }
    checkpoint();  // what was cut must not look whole
}

void World::Implementation::answer_candidates(std::span<ShapeCastHit> hits) {
    run_batch();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const auto& result = *std::get_if<TimeOfImpactResult>(&results_.results[i]);
        const auto [sweep, index] = candidates_[i];
        if (!result.status.ok()) {
            throw StatusException(
                {result.status.code(),
                 "cast_shape: sweep " + std::to_string(sweep) + ": " + result.status.message()});
        }
        ShapeCastHit& hit = hits[sweep];
        if (result.state == ImpactState::separated) {
            continue;
        }
        // A hit can have time 0 too, but what is touched at the start is touched before.
        const auto order = [&](ImpactState state, double time, std::uint32_t instance) {
            return std::tuple(time, state != ImpactState::intersecting_at_start,
                              instances_.number(instance));
        };
        const bool is_first = hit.state == ImpactState::separated ||
                              order(result.state, result.time, index) <
                                  order(hit.state, hit.time, hit.instance.index);
        if (is_first) {
            hit = hit_of(result, instances_.handle(index));
        }
    }
}

void World::Implementation::cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                                       std::span<ShapeCastHit> hits) {
    require_lengths("cast_shape", "sweeps", sweeps.size(), hits.size());
    const geometry::Polygon& polygon = shape(query.shape, "cast_shape");
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        require_pose("cast_shape", "the shape's start", i, sweeps[i].start);
        require_pose("cast_shape", "the shape's end", i, sweeps[i].end);
    }
    if (!(query.tolerance > 0.0 && query.tolerance <= largest_coordinate)) {
        refuse("cast_shape", "the tolerance is " + number(query.tolerance) +
                                 "; it must be a finite number above 0 and at most " +
                                 number(largest_coordinate));
    }
    if (!(query.contact_distance >= 0.0 && query.contact_distance <= largest_coordinate)) {
        refuse("cast_shape", "the contact distance is " + number(query.contact_distance) +
                                 "; it must be a finite number of at least 0");
    }
    prepare(query.filter, "cast_shape");
    std::fill(hits.begin(), hits.end(), ShapeCastHit{});
    for (std::size_t first = 0; first < sweeps.size(); first += sweeps_at_a_time) {
        const auto some = sweeps.subspan(first, std::min(sweeps_at_a_time, sweeps.size() - first));
        candidate_lists_.write(
            jobs_, some.size(), candidate_offsets_, candidates_of_sweeps_,
            [&](std::uint32_t /*job*/, std::size_t i, std::vector<std::uint32_t>& found) {
                find_candidates(query, polygon, some[i], found);
            });
        cast_among_candidates(query, some, first, hits);
    }
}

void World::Implementation::cast_among_candidates(const ShapeCastQuery& query,
                                                  std::span<const Sweep> sweeps, std::size_t first,
                                                  std::span<ShapeCastHit> hits) {
    constexpr std::size_t queries_at_a_time = 1024;
    batch_.clear();
    candidates_.clear();
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        for (std::uint32_t k = candidate_offsets_[i]; k < candidate_offsets_[i + 1]; ++k) {
            add_candidate(query, sweeps[i], first + i, candidates_of_sweeps_[k]);
        }
        if (candidates_.size() >= queries_at_a_time || i + 1 == sweeps.size()) {
            answer_candidates(hits);
            batch_.clear();
            candidates_.clear();
        }
    }
}

}  // namespace nearfield
