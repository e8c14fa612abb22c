// When moving shapes first touch a world.

#include <engine/context/call_within.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/toi/swept_box.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/world_state.hpp>

#include <algorithm>
#include <string>
#include <tuple>

namespace nearfield {
namespace {

using geometry::number;

/// So that the lists of their candidates stay small.
constexpr std::size_t sweeps_at_a_time = std::size_t{1} << 12U;
constexpr std::size_t queries_at_a_time = 1024;

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

/// One call of cast_shape(): times of impact with the instances that each sweep comes near, asked
/// of the context a batch at a time.
struct World::State::Casts {
    State& world;
    const ShapeCastQuery& query;
    const WorldFilter& filter;
    const geometry::Polygon& polygon;
    std::span<ShapeCastHit> hits;

    /// Appends the instances that a sweep may touch, in any order.
    void find_candidates(const Sweep& sweep, std::vector<std::uint32_t>& found) const {
        const world::Instances& all = world.instances;
        const geometry::Box box = geometry::grown(toi::swept_box({polygon, sweep.start, sweep.end}),
                                                  query.contact_distance);
        all.boxes().for_meeting(geometry::grown(box, all.max_rounding()), [&](std::uint32_t index) {
            // Who is a candidate must not depend on the rounding of others.
            if (all.passes(index, filter) &&
                localize::boxes_meet(all.box(index), box, all.rounding(index))) {
                found.push_back(index);
            }
        });
    }

    void add_candidate(const Sweep& sweep, std::size_t number, std::uint32_t index) {
        TimeOfImpactQuery impact;
        impact.a = {query.shape, sweep.start};
        impact.end_a = sweep.end;
        impact.b = world.instance_of(index);
        impact.end_b = impact.b.pose;
        impact.tolerance = query.tolerance;
        impact.contact_distance = query.contact_distance;
        world.batch.add(impact);
        world.candidates.push_back({number, index});
    }

    void take(const TimeOfImpactResult& result, const Candidate& candidate) {
        if (!result.status.ok()) {
            throw StatusException({result.status.code(), "cast_shape: sweep " +
                                                             std::to_string(candidate.number) +
                                                             ": " + result.status.message()});
        }
        ShapeCastHit& hit = hits[candidate.number];
        if (result.state == ImpactState::separated) {
            return;
        }
        // A hit can have time 0 too, but what is touched at the start is touched before.
        const auto order = [&](ImpactState state, double time, std::uint32_t instance) {
            return std::tuple(time, state != ImpactState::intersecting_at_start,
                              world.instances.number(instance));
        };
        const bool is_first = hit.state == ImpactState::separated ||
                              order(result.state, result.time, candidate.instance) <
                                  order(hit.state, hit.time, hit.instance.index);
        if (is_first) {
            hit = hit_of(result, world.instances.handle(candidate.instance));
        }
    }

    void answer_candidates() {
        world.run_batch();
        for (std::size_t i = 0; i < world.candidates.size(); ++i) {
            take(*std::get_if<TimeOfImpactResult>(&world.results.results[i]), world.candidates[i]);
        }
        world.batch.clear();
        world.candidates.clear();
    }

    /// `first`: the number of the first of them.
    void cast(std::span<const Sweep> sweeps, std::size_t first) {
        const std::vector<std::uint32_t>& offsets = world.candidate_offsets;
        world.candidate_lists.write(
            world.jobs, sweeps.size(), world.candidate_offsets, world.candidates_of_sweeps,
            [&](std::uint32_t /*job*/, std::size_t i, std::vector<std::uint32_t>& found) {
                find_candidates(sweeps[i], found);
            });
        world.batch.clear();
        world.candidates.clear();
        for (std::size_t i = 0; i < sweeps.size(); ++i) {
            for (std::uint32_t k = offsets[i]; k < offsets[i + 1]; ++k) {
                add_candidate(sweeps[i], first + i, world.candidates_of_sweeps[k]);
            }
            if (world.candidates.size() >= queries_at_a_time || i + 1 == sweeps.size()) {
                answer_candidates();
            }
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
        State::Casts casts{*state_, query, options.filter, polygon, hits};
        for (std::size_t first = 0; first < sweeps.size(); first += sweeps_at_a_time) {
            const std::size_t count = std::min(sweeps_at_a_time, sweeps.size() - first);
            casts.cast(sweeps.subspan(first, count), first);
        }
    });
}

}  // namespace nearfield
