#pragma once

#include <tools/simulation/proximity.hpp>
#include <tools/simulation/scene.hpp>

#include <span>
#include <vector>

namespace nearfield::simulation {

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

}  // namespace nearfield::simulation
