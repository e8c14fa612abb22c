#include <tools/simulation/impulses.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>

namespace nearfield::simulation {
namespace {

/// A contact and the impulses applied there.
struct Constraint {
    const Contact* contact = nullptr;
    double resistance_along = 0.0;   // impulse per change of speed along the normal
    double resistance_across = 0.0;  // and across it
    double wanted_speed = 0.0;       // minimum speed along the normal
    double along = 0.0;              // total impulses so far
    double across = 0.0;
};

double parting_speed(const Contact& contact, Vector2 direction) {
    return dot(contact.a->velocity(contact.on_a) - contact.b->velocity(contact.on_b), direction);
}

double resistance(const Contact& contact, Vector2 direction) {
    const double yielding =
        contact.a->yielding(contact.on_a, direction) + contact.b->yielding(contact.on_b, direction);
    return yielding > 0.0 ? 1.0 / yielding : 0.0;
}

/// The closest points nearby may come no closer; if they are too close, they separate slowly, by a
/// fraction of the missing distance per step, because more would add energy. The other contacts may
/// come as close as these: a surface that faces a corner at a slant is not a wall.
double wanted_speed(const Contact& contact, const Touch& touch, double gap,
                    const StepTimes& times) {
    constexpr double opened_a_step = 0.05;
    const double room = contact.distance - std::min(gap, contact.closest);
    if (room > 0.05 * gap) {
        return -room / times.remaining;
    }
    // Slower approaches are resting contact, without a rebound.
    const double resting = 0.2 * gap / times.step;
    const double approach = -parting_speed(contact, contact.normal);
    const double rebound = approach > resting ? touch.restitution * approach : 0.0;
    const double opening = opened_a_step * std::max(0.0, gap - contact.distance) / times.step;
    return std::max(rebound, opening);
}

void kick_apart(const Contact& contact, Vector2 impulse) {
    contact.a->kick(contact.on_a, impulse);
    contact.b->kick(contact.on_b, -impulse);
}

void improve(Constraint& constraint, double friction) {
    const Contact& contact = *constraint.contact;
    const double missing = constraint.wanted_speed - parting_speed(contact, contact.normal);
    const double along = std::max(0.0, constraint.along + constraint.resistance_along * missing);
    kick_apart(contact, (along - constraint.along) * contact.normal);
    constraint.along = along;
    const Vector2 tangent = left_of(contact.normal);
    const double most = friction * constraint.along;
    const double across = std::clamp(
        constraint.across - constraint.resistance_across * parting_speed(contact, tangent), -most,
        most);
    kick_apart(contact, (across - constraint.across) * tangent);
    constraint.across = across;
}

Contact contact_at(const ContactPoint& record, Body& a, Body& b) {
    const bool on_a = record.on == Side::a;
    const Vector2 point_a = on_a ? record.position : record.nearest;
    const Vector2 point_b = on_a ? record.nearest : record.position;
    const Vector2 normal = record.distance > 0.0 && !record.inside
                               ? (1.0 / record.distance) * (point_a - point_b)
                               : record.normal;
    // One point for both bodies conserves angular momentum.
    const Vector2 between = 0.5 * (point_a + point_b);
    return {&a, &b, a.grip(between), b.grip(between), normal, record.distance, record.distance};
}

/// Finds the minimum distance among nearby contacts of one pair.
void compare(std::span<Contact> contacts, double reach) {
    for (Contact& contact : contacts) {
        for (const Contact& other : contacts) {
            if (length(other.on_a.point - contact.on_a.point) <= reach) {
                contact.closest = std::min(contact.closest, other.distance);
            }
        }
    }
}

}  // namespace

std::vector<Contact> contacts_of(std::span<const Proximity::Touching> touching,
                                 const Scene& scene) {
    std::vector<Contact> contacts;
    for (const Proximity::Touching& pair : touching) {
        Body& a = *scene.bodies[pair.pair.first];
        Body& b = *scene.bodies[pair.pair.second];
        const std::size_t first = contacts.size();
        for (const ContactCluster& cluster : pair.contacts->manifold) {
            contacts.push_back(contact_at(cluster.extreme, a, b));
            for (const ContactPoint& record : pair.contacts->points) {
                const bool is_an_end = record.on == Side::a && (record.position == cluster.first ||
                                                                record.position == cluster.last);
                if (is_an_end && record.position != cluster.extreme.position) {
                    contacts.push_back(contact_at(record, a, b));
                }
            }
        }
        compare(std::span(contacts).subspan(first), 2.0 * scene.tolerance);
    }
    return contacts;
}

void resolve(std::span<const Contact> contacts, const Touch& touch, double gap,
             const StepTimes& times) {
    constexpr int tile_batches = 60;
    std::vector<Constraint> constraints;
    constraints.reserve(contacts.size());
    for (const Contact& contact : contacts) {
        constraints.push_back({&contact, resistance(contact, contact.normal),
                               resistance(contact, left_of(contact.normal)),
                               wanted_speed(contact, touch, gap, times)});
    }
    // Alternating directions, so that no end of a chain is favoured.
    for (int round = 0; round < tile_batches; ++round) {
        for (Constraint& constraint : constraints) {
            improve(constraint, touch.friction);
        }
        std::reverse(constraints.begin(), constraints.end());
    }
}

}  // namespace nearfield::simulation
