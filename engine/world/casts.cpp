// When moving shapes first touch a world.

#include <engine/batch/call_within.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/toi/swept_box.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/world_state.hpp>

#include <algorithm>
#include <string>
#include <tuple>

namespace nearfield {
namespace {

using geometry::number;

/// The number of sweeps that a job takes at a time: each may come near many instances.
constexpr std::size_t sweeps_of_part = 8;

void require_query(const ShapeCastQuery& query) {
    if (!(query.tolerance > 0.0 && query.tolerance <= largest_coordinate)) {
        refuse("cast_shape", "the tolerance is " + number(query.tolerance) +
                                 "; it must be a finite number above 0 and at most " +
                                 number(largest_coordinate));
    }
    if (!(query.contact_distance >= 0.0 && query.contact_distance <= largest_coordinate)) {
        refuse("cast_shape", "the contact distance is " + number(query.contact_distance) +
                                 "; it must be a finite number of at least 0");
    }
}

ShapeCastHit hit_of(const TimeOfImpactResult& result, InstanceHandle instance) {
    return {result.state,       instance,       result.time,    result.time_error_bound,
            result.error_bound, result.point_a, result.point_b, result.direction};
}

}  // namespace

/// One call of cast_shape(): times of impact with the instances that each sweep comes near.
struct World::State::Casts {
    const world::Instances& all;
    const ShapeCastQuery& query;
    const WorldFilter& filter;
    const geometry::Polygon& polygon;

    /// Appends the instances that a sweep may touch, in any order.
    void find_candidates(const Sweep& sweep, std::vector<std::uint32_t>& found) const {
        const geometry::Box box = geometry::grown(toi::swept_box({polygon, sweep.start, sweep.end}),
                                                  query.contact_distance);
        all.boxes().for_meeting(geometry::grown(box, all.max_rounding()), [&](std::uint32_t index) {
            // Who is a candidate must not depend on the rounding of others.
            if (all.passes(index, filter) &&
                geometry::boxes_meet(all.box(index), box, all.rounding(index))) {
                found.push_back(index);
            }
        });
    }

    /// The time of impact of a sweep with an instance, until the job's next one.
    [[nodiscard]] const TimeOfImpactResult& answer(const Sweep& sweep, std::uint32_t index,
                                                   Job& job) const {
        TimeOfImpactQuery impact;
        impact.a = {query.shape, sweep.start};
        impact.end_a = sweep.end;
        impact.b = {all[index].shape, all[index].pose};
        impact.end_b = impact.b.pose;
        impact.tolerance = query.tolerance;
        impact.technique = Technique::cpu;
        impact.contact_distance = query.contact_distance;
        const AnyQuery any = impact;
        queries::CheckedQuery checked;
        if (queries::check(0, any, {&polygon, &all.polygon(index)}, {}, checked, job.result)) {
            auto& result = std::get<TimeOfImpactResult>(job.result);
            job.impacts.answer(checked, job.workspace, result);
        }
        return std::get<TimeOfImpactResult>(job.result);
    }

    /// Makes the hit one with this instance, if that is touched first.
    void take(const TimeOfImpactResult& result, std::uint32_t index, ShapeCastHit& hit) const {
        if (result.state == ImpactState::separated) {
            return;
        }
        // A hit can have time 0 too, but what is touched at the start is touched before.
        const auto order = [&](ImpactState state, double time, std::uint32_t instance) {
            return std::tuple(time, state != ImpactState::intersecting_at_start,
                              all.number(instance));
        };
        const bool is_first = hit.state == ImpactState::separated ||
                              order(result.state, result.time, index) <
                                  order(hit.state, hit.time, hit.instance.index);
        if (is_first) {
            hit = hit_of(result, all.handle(index));
        }
    }

    /// `number`: of the sweep.
    void cast(const Sweep& sweep, std::size_t number, Job& job, ShapeCastHit& hit) const {
        checkpoint();
        job.found.clear();
        find_candidates(sweep, job.found);
        for (const std::uint32_t index : job.found) {
            checkpoint();
            const TimeOfImpactResult& result = answer(sweep, index, job);
            if (!result.status.ok()) {
                throw StatusException({result.status.code(), "cast_shape: sweep " +
                                                                 std::to_string(number) + ": " +
                                                                 result.status.message()});
            }
            take(result, index, hit);
        }
    }
};

Status World::cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                         std::span<ShapeCastHit> hits, const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        require_cpu("cast_shape", options.technique);
        require_lengths("cast_shape", "sweeps", sweeps.size(), hits.size());
        const geometry::Polygon& polygon = state_->shape(query.shape, "cast_shape");
        for (std::size_t i = 0; i < sweeps.size(); ++i) {
            require_pose("cast_shape", "the shape's start", i, sweeps[i].start);
            require_pose("cast_shape", "the shape's end", i, sweeps[i].end);
        }
        require_query(query);
        state_->prepare(options.filter, "cast_shape");
        std::fill(hits.begin(), hits.end(), ShapeCastHit{});
        const State::Casts casts{state_->instances, query, options.filter, polygon};
        expect_answers(sweeps.size());
        state_->jobs.divide(sweeps.size(), sweeps_of_part,
                            [&](std::uint32_t job, std::size_t first, std::size_t end) {
                                for (std::size_t i = first; i < end; ++i) {
                                    casts.cast(sweeps[i], i, state_->scratch[job], hits[i]);
                                }
                                finish_answers(end - first);
                            });
    });
}

}  // namespace nearfield
