#include <tools/simulation/backtracking.hpp>
#include <tools/simulation/impulses.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::simulation {
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
