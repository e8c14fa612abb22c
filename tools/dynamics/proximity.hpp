#pragma once

#include <nearfield/context.hpp>

#include <tools/dynamics/body.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::dynamics {

/// The bodies of a scene as a context knows them, and what is asked about them. Keeps count of the
/// time that takes. Everything throws tools::LibraryError where the library refuses.
class Proximity {
public:
    /// The bodies must outlive this; so must the context.
    Proximity(Context& context, std::span<const std::unique_ptr<Body>> bodies, double tolerance,
              Technique technique);
    ~Proximity();
    Proximity(const Proximity&) = delete;
    Proximity& operator=(const Proximity&) = delete;

    /// Both orders of a pair.
    struct Overlap {
        InstancePair pair;
        const PenetrationResult* first_in_second;
        const PenetrationResult* second_in_first;
    };
    struct Touching {
        InstancePair pair;
        const ContactResult* contacts;  ///< A: first, B: second
    };

    /// Pairs worth a query where the bodies are now, of which one at least can move.
    [[nodiscard]] const std::vector<InstancePair>& near_pairs(double reach);
    /// The points of every near pair that are inside the other body; valid until the next question.
    [[nodiscard]] const std::vector<Overlap>& overlaps();
    /// Least distances; 0 where they intersect.
    [[nodiscard]] const std::vector<double>& distances(std::span<const InstancePair> pairs);
    /// Rigid bodies that are on their way, and how close they may come, > 0.
    struct Approach {
        InstancePair pair;
        double least = 0.0;
    };
    /// When pairs first come as close as they may on the way from where they are to `ends`, the
    /// poses of all bodies; valid until the next question.
    [[nodiscard]] const std::vector<const TimeOfImpactResult*>& impacts(
        std::span<const Approach> approaches, std::span<const Pose> ends);
    /// Contacts of every near pair; valid until the next question.
    [[nodiscard]] const std::vector<Touching>& contacts(double contact_distance);

    /// The batch that overlaps() asks, as it stands now: what a frame of the paper's tables asks.
    void fill_with_overlaps(Batch& batch);

    [[nodiscard]] double tolerance() const { return tolerance_; }
    [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }

    /// What was asked since reset_count().
    struct Count {
        double milliseconds = 0.0;  ///< of the calls of the library
        std::size_t queries = 0;
        std::size_t batches = 0;
    };
    [[nodiscard]] const Count& count() const { return count_; }
    void reset_count() { count_ = {}; }

private:
    void place();
    void run();

    Context& context_;
    std::span<const std::unique_ptr<Body>> bodies_;
    double tolerance_;
    Technique technique_;
    std::vector<Instance> instances_;
    std::vector<InstancePair> pairs_;
    Batch batch_;
    Results results_;
    std::vector<Overlap> overlaps_;
    std::vector<Touching> touching_;
    std::vector<double> distances_;
    std::vector<const TimeOfImpactResult*> impacts_;
    Count count_;
};

}  // namespace nearfield::dynamics
