#include <engine/base/interruption.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/toi/motion.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

namespace nearfield {
namespace {

using geometry::Box;
using geometry::number;
using geometry::TransformedPolygon;

/// Contains the shape at all times of a motion.
Box swept_box(const geometry::Polygon& shape, const Sweep& sweep) {
    Box box = TransformedPolygon(shape, sweep.start).box();
    box.extend(TransformedPolygon(shape, sweep.end).box());
    if (sweep.start.angle == sweep.end.angle) {
        return box;
    }
    // It turns about its own origin, which moves straight.
    const toi::Motion motion(shape, sweep.start, sweep.end);
    Box turned(geometry::to_vector(sweep.start.translation));
    turned.extend(geometry::to_vector(sweep.end.translation));
    return box.merged(geometry::grown(turned, motion.reach()));
}

ShapeCastHit hit_of(const TimeOfImpactResult& result, InstanceHandle instance) {
    return {result.state,       instance,       result.time,    result.time_error_bound,
            result.error_bound, result.point_a, result.point_b, result.direction};
}

}  // namespace

void World::Implementation::find_candidates(const ShapeCastQuery& query,
                                            const geometry::Polygon& shape, const Sweep& sweep,
                                            std::size_t number) {
    // Rounding grows with the arcs and paths that are moved along.
    const toi::Motion motion(shape, sweep.start, sweep.end);
    const double margin = query.contact_distance + instances_.max_rounding() +
                          64.0 * std::numeric_limits<double>::epsilon() * motion.magnitude();
    const Box box = geometry::grown(swept_box(shape, sweep), margin);
    instances_.boxes().for_meeting(box, [&](std::uint32_t index) {
        if (!instances_.passes(index, query.filter)) {
            return;
        }
        TimeOfImpactQuery impact;
        impact.a = {query.shape, sweep.start};
        impact.end_a = sweep.end;
        impact.b = instance_of(index);
        impact.end_b = instances_[index].pose;
        impact.tolerance = query.tolerance;
        impact.contact_distance = query.contact_distance;
        batch_.add(impact);
        candidates_.push_back({number, index});
    });
}

void World::Implementation::run_batch() {
    const Expected<Ticket> ticket = context_->submit(batch_, {}, &results_);
    Status status = ticket ? context_->collect(*ticket, results_) : ticket.error();
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
    constexpr std::size_t queries_at_a_time = 1024;
    batch_.clear();
    candidates_.clear();
    std::fill(hits.begin(), hits.end(), ShapeCastHit{});
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        checkpoint();
        find_candidates(query, polygon, sweeps[i], i);
        if (candidates_.size() >= queries_at_a_time || i + 1 == sweeps.size()) {
            answer_candidates(hits);
            batch_.clear();
            candidates_.clear();
        }
    }
}

}  // namespace nearfield
