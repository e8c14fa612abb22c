#pragma once

#include <nearfield/context.hpp>

#include <tools/simulation/body.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::simulation {

/// Proximity queries on the bodies of a scene in a context, with a count of their time. All members
/// throw tools::LibraryError if the library rejects something.
class Proximity {
public:
    /// The bodies and the context must outlive this.
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

    /// The pairs worth a query at the bodies' current positions, at least one of which can move.
    [[nodiscard]] const std::vector<InstancePair>& near_pairs(double reach);
    /// The points of every near pair that are inside the other body; valid until the next query.
    [[nodiscard]] const std::vector<Overlap>& overlaps();
    /// Minimum distances; 0 if the bodies intersect.
    [[nodiscard]] const std::vector<double>& distances(std::span<const InstancePair> pairs);
    /// A pair of moving rigid bodies, and the minimum distance it may reach, > 0.
    struct Approach {
        InstancePair pair;
        double least = 0.0;
    };
    /// When pairs first reach their minimum distance on the way from the current poses to `ends`,
    /// the poses of all bodies; valid until the next query.
    [[nodiscard]] const std::vector<const TimeOfImpactResult*>& impacts(
        std::span<const Approach> approaches, std::span<const Pose> ends);
    /// The contacts of every near pair; valid until the next query.
    [[nodiscard]] const std::vector<Touching>& contacts(double contact_distance);

    /// Fills a batch with the queries of overlaps() for the current state, as in a frame of the
    /// paper's tables.
    void fill_with_overlaps(Batch& batch);

    [[nodiscard]] double tolerance() const { return tolerance_; }
    [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }

    /// The queries since reset_count().
    struct Count {
        double milliseconds = 0.0;  ///< spent in calls of the library
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

}  // namespace nearfield::simulation
