#pragma once

#include <tools/simulation/proximity.hpp>
#include <tools/simulation/scene.hpp>

namespace nearfield::simulation {

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
