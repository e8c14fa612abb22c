#include <tools/dynamics/backtracking.hpp>
#include <tools/dynamics/impulses.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::dynamics {
namespace {

/// A pair and how close it may come.
struct Watched {
    InstancePair pair;
    double least = 0.0;
};

/// One step: knows which pairs are too close at a time after the last settled state.
class Step {
public:
    Step(Proximity& proximity, const Scene& scene)
        : proximity_(proximity), scene_(scene), waiting_(scene.bodies.size(), false) {}

    /// Bodies that wait stay where they settled.
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

    /// The pairs that are too close after `time`. A pair that is so already, by rounding or because
    /// the scene started so, may stay but come no closer.
    [[nodiscard]] std::vector<Watched> offenders_after(double time) {
        move(time);
        std::vector<InstancePair> pairs = proximity_.near_pairs(floor());
        std::vector<Watched> close;
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
        const std::vector<double> starts = proximity_.distances(pairs_of(close));
        std::vector<Watched> offenders;
        for (std::size_t i = 0; i < close.size(); ++i) {
            const double least = std::min(floor(), starts[i] * (1.0 - 1e-9));
            if (close[i].least < least) {
                offenders.push_back({close[i].pair, least});
            }
        }
        move(time);
        return offenders;
    }

    /// The longest time found by bisection after which none of the pairs is too close.
    [[nodiscard]] double time_before(const std::vector<Watched>& offenders, double time) {
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

    [[nodiscard]] std::size_t wait(const std::vector<Watched>& offenders) {
        std::size_t more = 0;
        for (const Watched& offender : offenders) {
            for (const std::uint32_t body : {offender.pair.first, offender.pair.second}) {
                more += waiting_[body] ? 0U : 1U;
                waiting_[body] = true;
            }
        }
        return more;
    }

    /// The least distance that bodies keep.
    [[nodiscard]] double floor() const { return 0.25 * proximity_.tolerance(); }

private:
    static std::vector<InstancePair> pairs_of(const std::vector<Watched>& watched) {
        std::vector<InstancePair> pairs;
        for (const Watched& each : watched) {
            pairs.push_back(each.pair);
        }
        return pairs;
    }

    Proximity& proximity_;
    const Scene& scene_;
    std::vector<bool> waiting_;
};

}  // namespace

BacktrackingReport move_without_penetration(Proximity& proximity, const Scene& scene, double time) {
    constexpr std::size_t most_events = 6;
    const double gap = 0.5 * proximity.tolerance();
    BacktrackingReport report;
    Step step(proximity, scene);
    double remaining = time;
    while (true) {
        std::vector<Watched> offenders = step.offenders_after(remaining);
        if (offenders.empty()) {
            break;
        }
        if (report.events == most_events) {
            report.stopped += step.wait(offenders);
            continue;
        }
        const double clear = step.time_before(offenders, remaining);
        step.move(clear);
        step.settle();
        remaining -= clear;
        const std::vector<Contact> contacts =
            contacts_of(proximity.contacts(2.0 * proximity.tolerance()), scene);
        resolve(contacts, scene.touch, gap, {time, std::max(remaining, 0.01 * time)});
        report.contacts += contacts.size();
        ++report.events;
    }
    step.settle();
    return report;
}

}  // namespace nearfield::dynamics
