#pragma once

#include <tools/dynamics/proximity.hpp>
#include <tools/dynamics/scene.hpp>

namespace nearfield::dynamics {

/// What a step with backtracking came to.
struct BacktrackingReport {
    std::size_t events = 0;    ///< times the scene was taken back to just before a contact
    std::size_t contacts = 0;  ///< points where impulses acted
    std::size_t stopped = 0;   ///< bodies that had to wait for the rest of the step
};

/// The paper's constrained response. Moves all bodies for `time`; where two would come closer than
/// a quarter of the tolerance, takes the whole scene back to just before that, lets impulses act at
/// the contacts, and goes on from there. Bodies that keep meeting in one step stay where they were
/// for the rest of it, so none ever penetrates another.
///
/// Of rigid bodies the time is the certified one of TimeOfImpactQuery: nothing can have met before
/// it, not even what is past each other at the end of the step. The way of a deformable body is no
/// motion that the query knows; there the end of the step is looked at, and the time is found by
/// bisection.
///
/// Precondition: the bodies are settled where none touches another.
BacktrackingReport move_without_penetration(Proximity& proximity, const Scene& scene, double time);

}  // namespace nearfield::dynamics
