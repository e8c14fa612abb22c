#pragma once

#include <tools/simulation/proximity.hpp>
#include <tools/simulation/scene.hpp>

#include <span>

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

}  // namespace nearfield::simulation
