#pragma once

#include <tools/simulation/proximity.hpp>
#include <tools/simulation/scene.hpp>

#include <span>
#include <vector>

namespace nearfield::simulation {

/// The sums over the penalty forces of a step.
struct PenaltyReport {
    std::size_t points = 0;  ///< inside another body
    double deepest = 0.0;    ///< the greatest point depth
};

/// The paper's unconstrained response: a damped spring pushes every boundary point that is inside
/// another body along the way out, in proportion to its depth. The force acts on both bodies with
/// opposite signs.
PenaltyReport push_apart(Proximity& proximity, const Scene& scene);

/// The energy in the springs of these forces.
[[nodiscard]] double stored_energy(std::span<const Proximity::Overlap> overlaps,
                                   const Touch& touch);

/// A contact: one point on each of two bodies.
struct Contact {
    Body* a;
    Body* b;
    Grip on_a;  ///< midway between the two points, as on_b
    Grip on_b;
    Vector2 normal;         ///< from B to A, unit
    double distance = 0.0;  ///< between the two points
    double closest = 0.0;   ///< minimum distance of nearby contacts
};

/// A representative subset of a scene's contacts: both ends and the closest point of every
/// connected run of contacts.
[[nodiscard]] std::vector<Contact> contacts_of(std::span<const Proximity::Touching> touching,
                                               const Scene& scene);

struct StepTimes {
    double step = 0.0;       ///< duration of the step
    double remaining = 0.0;  ///< remaining time, > 0
};

/// Changes velocities by impulses at all contacts together, so that no contact becomes closer than
/// `gap` before the end of the step, and bodies that collide at sufficient speed rebound
/// (Touch::restitution).
void resolve(std::span<const Contact> contacts, const Touch& touch, double gap,
             const StepTimes& times);

/// Counts from a step with backtracking.
struct BacktrackingReport {
    std::size_t events = 0;    ///< how often the scene was taken back to just before a contact
    std::size_t contacts = 0;  ///< points where impulses acted
    std::size_t stopped = 0;   ///< bodies that had to wait for the rest of the step
};

/// The paper's constrained response. Moves all bodies for `time`. If two would come closer than a
/// quarter of the tolerance, it takes the whole scene back to just before that, applies impulses at
/// the contacts, and continues from there. Bodies that collide repeatedly in one step stay where
/// they were for the rest of it, so bodies never penetrate.
///
/// For rigid bodies the time is the certified result of TimeOfImpactQuery: no contact occurs before
/// it, not even between bodies that have passed each other by the end of the step. The query does
/// not support the motion of a deformable body; such pairs are tested at the end of the step, and
/// the time is found by bisection.
///
/// Precondition: the bodies are settled where none touches another.
BacktrackingReport move_without_penetration(Proximity& proximity, const Scene& scene, double time);

}  // namespace nearfield::simulation
