#pragma once

#include <tools/dynamics/proximity.hpp>
#include <tools/dynamics/scene.hpp>

#include <span>

namespace nearfield::dynamics {

/// What the penalty forces of a step came to.
struct PenaltyReport {
    std::size_t points = 0;  ///< inside another body
    double deepest = 0.0;    ///< the greatest point depth
};

/// The paper's response without a constraint: every point of a boundary inside another body is
/// pushed along the way out by a spring as long as it is deep, damped, until it is out. Both bodies
/// feel it, with opposite signs; nothing but the two matters.
PenaltyReport push_apart(Proximity& proximity, const Scene& scene);

/// The energy in the springs that these forces stand for.
[[nodiscard]] double stored_energy(std::span<const Proximity::Overlap> overlaps,
                                   const Touch& touch);

}  // namespace nearfield::dynamics
