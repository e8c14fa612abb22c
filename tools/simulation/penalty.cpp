#include <tools/simulation/penalty.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>

namespace nearfield::simulation {
namespace {

/// The length of boundary that a point represents: half the distance to each neighbour along the
/// boundary, and half a cell if that neighbour is not inside.
double length_at(const PenetrationResult& result, std::size_t index) {
    const auto half_way = [&result](std::size_t from, std::size_t to) {
        const double apart = length(result.points[from].position - result.points[to].position);
        return 0.5 * std::min(apart, result.cell);
    };
    const double before = index > 0 ? half_way(index - 1, index) : 0.5 * result.cell;
    const double after =
        index + 1 < result.points.size() ? half_way(index, index + 1) : 0.5 * result.cell;
    return before + after;
}

/// The force on a point of A that is inside B. Points of both bodies push, so each contributes
/// half.
Vector2 force_at(const PenetratingPoint& record, Vector2 velocity, double span,
                 const Touch& touch) {
    const double half = 0.5 * span;
    const double leaving = dot(velocity, record.direction);
    const double press =
        std::max(0.0, half * (touch.stiffness * record.depth - touch.damping * leaving));
    const Vector2 sliding = velocity - leaving * record.direction;
    const double speed = length(sliding);
    if (speed == 0.0) {
        return press * record.direction;
    }
    const double rub = std::min(touch.friction * press, half * touch.damping * speed);
    return press * record.direction - (rub / speed) * sliding;
}

void push_out(const PenetrationResult& result, Body& a, Body& b, const Touch& touch,
              PenaltyReport& report) {
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        const PenetratingPoint& record = result.points[i];
        const double span = length_at(result, i);
        // One point for both bodies conserves angular momentum.
        const Grip on_a = a.grip(record.position);
        const Grip on_b = b.grip(record.position);
        const Vector2 force = force_at(record, a.velocity(on_a) - b.velocity(on_b), span, touch);
        a.push(on_a, force);
        b.push(on_b, -force);
        report.deepest = std::max(report.deepest, record.depth);
    }
    report.points += result.points.size();
}

double energy_of(const PenetrationResult& result, const Touch& touch) {
    double energy = 0.0;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        const double depth = result.points[i].depth;
        energy += 0.25 * touch.stiffness * length_at(result, i) * depth * depth;
    }
    return energy;
}

}  // namespace

PenaltyReport push_apart(Proximity& proximity, const Scene& scene) {
    PenaltyReport report;
    for (const Proximity::Overlap& overlap : proximity.overlaps()) {
        Body& first = *scene.bodies[overlap.pair.first];
        Body& second = *scene.bodies[overlap.pair.second];
        push_out(*overlap.first_in_second, first, second, scene.touch, report);
        push_out(*overlap.second_in_first, second, first, scene.touch, report);
    }
    return report;
}

double stored_energy(std::span<const Proximity::Overlap> overlaps, const Touch& touch) {
    double energy = 0.0;
    for (const Proximity::Overlap& overlap : overlaps) {
        energy +=
            energy_of(*overlap.first_in_second, touch) + energy_of(*overlap.second_in_first, touch);
    }
    return energy;
}

}  // namespace nearfield::simulation
