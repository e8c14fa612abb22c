#pragma once

#include <tools/dynamics/proximity.hpp>
#include <tools/dynamics/scene.hpp>

#include <span>
#include <vector>

namespace nearfield::dynamics {

/// Two points in touch, one of each body.
struct Contact {
    Body* a;
    Body* b;
    Grip on_a;  ///< half way between the two points, as on_b
    Grip on_b;
    Vector2 normal;         ///< from B to A, unit
    double distance = 0.0;  ///< between the two points
    double closest = 0.0;   ///< the least distance of the contacts close by
};

/// The contacts of a scene that stand for all of them: the ends and the closest point of every
/// stretch of contact.
[[nodiscard]] std::vector<Contact> contacts_of(std::span<const Proximity::Touching> touching,
                                               const Scene& scene);

struct StepTimes {
    double step = 0.0;       ///< length of the step
    double remaining = 0.0;  ///< what is left of it, > 0
};

/// Changes velocities by impulses at all contacts together, so that until the end of the step none
/// comes closer than `gap`, and those that met with some speed part again (Touch::restitution).
void resolve(std::span<const Contact> contacts, const Touch& touch, double gap,
             const StepTimes& times);

}  // namespace nearfield::dynamics
