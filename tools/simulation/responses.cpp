#include <tools/simulation/plane.hpp>
#include <tools/simulation/responses.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

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

namespace {

using Approach = Proximity::Approach;

std::vector<InstancePair> pairs_of(const std::vector<Approach>& approaches) {
    std::vector<InstancePair> pairs;
    pairs.reserve(approaches.size());
    for (const Approach& approach : approaches) {
        pairs.push_back(approach.pair);
    }
    return pairs;
}

/// The minimum distance of a pair that is already this close, by rounding or because the scene
/// started so: it may stay but come no closer.
double min_from(double start) {
    return start * (1.0 - 1e-9);
}

/// The pairs that would come too close, and a time before which no pair does.
struct Meeting {
    std::vector<InstancePair> pairs;
    double clear = 0.0;
};

/// One step: finds the pairs that come too close within a time after the last settled state.
class Step {
public:
    Step(Proximity& proximity, const Scene& scene)
        : proximity_(proximity),
          scene_(scene),
          deforming_(static_cast<std::size_t>(
              std::count_if(scene.bodies.begin(), scene.bodies.end(),
                            [](const auto& body) { return body->deforms(); }))),
          waiting_(scene.bodies.size(), false) {}

    /// Moves all bodies; waiting bodies stay where they settled.
    void move(double time) {
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            scene_.bodies[i]->move(waiting_[i] ? 0.0 : time);
        }
    }
    void settle() {
        for (const std::unique_ptr<Body>& body : scene_.bodies) {
            body->settle();
        }
    }

    [[nodiscard]] Meeting first_meeting(double time) {
        Meeting overlap_test{{}, time};
        if (deforming_ + 1 < scene_.bodies.size()) {
            find_rigid(overlap_test);
        }
        if (deforming_ > 0) {
            find_deforming(overlap_test);
        }
        return overlap_test;
    }

    [[nodiscard]] std::size_t wait(const Meeting& overlap_test) {
        std::size_t more = 0;
        for (const InstancePair& pair : overlap_test.pairs) {
            for (const std::uint32_t body : {pair.first, pair.second}) {
                more += waiting_[body] ? 0U : 1U;
                waiting_[body] = true;
            }
        }
        return more;
    }

private:
    /// The minimum distance between bodies.
    [[nodiscard]] double floor() const { return 0.25 * proximity_.tolerance(); }

    [[nodiscard]] bool deforms(const InstancePair& pair) const {
        return scene_.bodies[pair.first]->deforms() || scene_.bodies[pair.second]->deforms();
    }

    /// Finds the poses of rigid bodies after a time. Returns an upper bound on how far any point of
    /// one moves until then. Leaves all bodies where they settled.
    double find_ends(double time) {
        move(time);
        ends_.clear();
        for (const std::unique_ptr<Body>& body : scene_.bodies) {
            ends_.push_back(body->pose());
        }
        move(0.0);
        double farthest = 0.0;
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            const Body& body = *scene_.bodies[i];
            if (body.deforms()) {
                continue;
            }
            double radius = 0.0;
            for (const Ring& ring : body.rings()) {
                for (const Vector2 vertex : ring) {
                    radius = std::max(radius, length(vertex));
                }
            }
            const Pose start = body.pose();
            farthest = std::max(farthest, length(ends_[i].translation - start.translation) +
                                              radius * std::abs(ends_[i].angle - start.angle));
        }
        return farthest;
    }

    /// Adds the pairs of rigid bodies that come too close within overlap_test.clear, and lowers it
    /// to the earliest of these times.
    void find_rigid(Meeting& overlap_test) {
        const double time = overlap_test.clear;
        const double farthest = find_ends(time);
        std::vector<Approach> approaches;
        for (const InstancePair& pair : proximity_.near_pairs(floor() + 2.0 * farthest)) {
            const bool both_wait = waiting_[pair.first] && waiting_[pair.second];
            if (!deforms(pair) && !both_wait) {
                approaches.push_back({pair, floor()});
            }
        }
        const std::vector<Approach> close = add_impacts(approaches, time, overlap_test);
        if (!close.empty()) {
            static_cast<void>(add_impacts(close, time, overlap_test));
        }
    }

    /// Returns the pairs that start at the minimum distance or closer, with the distance that they
    /// may keep.
    std::vector<Approach> add_impacts(const std::vector<Approach>& approaches, double time,
                                      Meeting& overlap_test) {
        std::vector<Approach> close;
        const std::vector<const TimeOfImpactResult*>& impacts =
            proximity_.impacts(approaches, ends_);
        for (std::size_t i = 0; i < approaches.size(); ++i) {
            const TimeOfImpactResult& impact = *impacts[i];
            const InstancePair& pair = approaches[i].pair;
            const double rounding = impact.error_bound;
            if (impact.time == 0.0 && impact.distance <= approaches[i].least + rounding) {
                close.push_back({pair, std::max(0.0, min_from(impact.distance) - 2.0 * rounding)});
            } else if (impact.state != ImpactState::separated) {
                overlap_test.pairs.push_back(pair);
                overlap_test.clear = std::min(overlap_test.clear, impact.time * time);
            }
        }
        return close;
    }

    /// Adds the pairs with a deformable body that are too close after overlap_test.clear, and
    /// lowers it to a time at which they are not.
    void find_deforming(Meeting& overlap_test) {
        const std::vector<Approach> offenders = deforming_offenders_after(overlap_test.clear);
        if (offenders.empty()) {
            return;
        }
        overlap_test.clear = time_before(offenders, overlap_test.clear);
        for (const Approach& offender : offenders) {
            overlap_test.pairs.push_back(offender.pair);
        }
    }

    [[nodiscard]] std::vector<Approach> deforming_offenders_after(double time) {
        move(time);
        std::vector<InstancePair> pairs = proximity_.near_pairs(floor());
        std::erase_if(pairs, [this](const InstancePair& pair) { return !deforms(pair); });
        std::vector<Approach> close;
        const std::vector<double>& ends = proximity_.distances(pairs);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (ends[i] < floor()) {
                close.push_back({pairs[i], ends[i]});
            }
        }
        if (close.empty()) {
            return close;
        }
        move(0.0);
        const std::vector<double>& starts = proximity_.distances(pairs_of(close));
        std::vector<Approach> offenders;
        for (std::size_t i = 0; i < close.size(); ++i) {
            const double least = std::min(floor(), min_from(starts[i]));
            if (close[i].least < least) {
                offenders.push_back({close[i].pair, least});
            }
        }
        return offenders;
    }

    /// The longest time, found by bisection, after which none of the pairs is too close.
    [[nodiscard]] double time_before(const std::vector<Approach>& offenders, double time) {
        constexpr int halvings = 9;
        const std::vector<InstancePair> pairs = pairs_of(offenders);
        double clear = 0.0;
        double late = time;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (clear + late);
            move(middle);
            const std::vector<double>& distances = proximity_.distances(pairs);
            bool good = true;
            for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
                good = good && distances[pair] >= offenders[pair].least;
            }
            (good ? clear : late) = middle;
        }
        return clear;
    }

    Proximity& proximity_;
    const Scene& scene_;
    std::size_t deforming_;
    std::vector<bool> waiting_;
    std::vector<Pose> ends_;
};

}  // namespace

BacktrackingReport move_without_penetration(Proximity& proximity, const Scene& scene, double time) {
    constexpr std::size_t max_events = 6;
    const double gap = 0.5 * proximity.tolerance();
    BacktrackingReport report;
    Step step(proximity, scene);
    double remaining = time;
    while (true) {
        const Meeting overlap_test = step.first_meeting(remaining);
        if (overlap_test.pairs.empty()) {
            break;
        }
        if (report.events == max_events) {
            report.stopped += step.wait(overlap_test);
            continue;
        }
        step.move(overlap_test.clear);
        step.settle();
        remaining -= overlap_test.clear;
        const std::vector<Contact> contacts =
            contacts_of(proximity.contacts(2.0 * proximity.tolerance()), scene);
        resolve(contacts, scene.touch, gap, {time, std::max(remaining, 0.01 * time)});
        report.contacts += contacts.size();
        ++report.events;
    }
    step.move(remaining);
    step.settle();
    return report;
}

}  // namespace nearfield::simulation
