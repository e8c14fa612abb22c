#pragma once

#include <engine/exact/closest_pair.hpp>
#include <engine/exact/meeting.hpp>
#include <engine/exact/motion.hpp>
#include <engine/exact/near_pairs.hpp>
#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <limits>

namespace nearfield::exact {

/// How closely the first contact is to be known, and what it may cost.
struct ContactAim {
    double motion = 0.0;  ///< no two points move farther against each other in the time left open
    double time = 1.0;    ///< nor is that longer
    std::uint32_t most_steps = 0;  ///< so many times at the most the shapes are looked at
    double distance = 0.0;         ///< shapes no farther apart than this touch
};

/// What is known of the first contact of two moving shapes.
struct FirstContact {
    enum class Kind : std::uint8_t {
        none,      ///< they stay apart from 0 to 1
        found,     ///< between `time` and `latest`
        at_start,  ///< they touch at 0
        unknown,   ///< apart until `time`; if they do touch before `latest`, it was not found where
    };
    Kind kind = Kind::none;
    double time = 0.0;             ///< they are apart before it, from 0 on
    double latest = 0.0;           ///< found: they touch no later than this, up to `rounding`
    bool touch_at_latest = false;  ///< seen to touch then
    bool share_a_point_at_start = false;  ///< at_start: not only near each other
    ClosestPair closest;                  ///< at `time`, but where they share a point
    double least_distance = std::numeric_limits<double>::infinity();  ///< no less before `time`
    double rounding = 0.0;    ///< how far apart what is said to touch may be
    std::uint32_t steps = 0;  ///< how many times the shapes were looked at
};

/// Finds the first contact by conservative advancement: from a time at which the shapes are apart
/// to a later one until which they cannot have met. Keeps its memory from pair to pair.
///
/// The step. Boundaries that are apart meet first where a vertex of either comes to an edge of the
/// other. A vertex and an edge that are near are held apart by a direction n: along it the vertex
/// is ahead of neither end of the edge. What is between them along n is a function of time whose
/// value and slope are known and whose second derivative is no more than the accelerations, so it
/// stays above a length until the root of a parabola; the ends of the edge enclose its other
/// points, so that holds for all of them. The pairs that are farther apart than some distance are
/// left to a bound on all relative motion. Where shapes touch at a distance already, the length is
/// more than that.
class FirstContactFinder {
public:
    [[nodiscard]] FirstContact find(const Motion& a, const Motion& b, const ContactAim& aim);

    /// Of find() that said they share a point at the start: the shapes then.
    [[nodiscard]] const PlacedEdges& placed_a() const { return instances_[index_a_]; }
    [[nodiscard]] const PlacedEdges& placed_b() const { return instances_[index_b_]; }

private:
    /// Looks at the shapes as they are at a time.
    void place(double time, FirstContact& contact);
    [[nodiscard]] bool meet();
    /// Leaves them there. `at_most`: known of their distance then.
    [[nodiscard]] bool touch_at(double time, double distance, double at_most,
                                FirstContact& contact);
    /// Whether they touch `ahead` of contact.time, where they were looked at last; leaves them
    /// there.
    [[nodiscard]] bool touch_soon(const ContactAim& aim, double ahead, FirstContact& contact);
    /// `at_most`: they are known to be no farther apart.
    [[nodiscard]] ClosestPair find_closest(double at_most);

    /// The shapes as they were seen.
    struct Look {
        double time;
        double moved;           ///< since the time before, at the most
        double least_distance;  ///< up to then
        const ClosestPair& closest;
    };
    void advance(const ContactAim& aim, FirstContact& contact);
    /// Takes down what was seen; whether that is the answer.
    [[nodiscard]] bool settle(const ContactAim& aim, const Look& look, FirstContact& contact);
    /// How long no vertex and edge come as close as `keep`; at most `left`. `distance`: now.
    [[nodiscard]] double safe_step(double distance, double keep, double left);
    [[nodiscard]] double pair_step(const VertexAndEdge& pair, double keep) const;

    const Motion* a_ = nullptr;
    const Motion* b_ = nullptr;
    double rounding_ = 0.0;  // of two points' distance at a time, and of the time
    // At the time the shapes are looked at.
    PlacedInstances instances_;
    std::uint32_t index_a_ = 0;
    std::uint32_t index_b_ = 0;
    MotionState state_a_;
    MotionState state_b_;
    RelativeMotion motion_;

    double reach_ = 0.0;  // how far the last step looked for pairs, as far as that was worth it
    MeetingFinder meeting_;
    ClosestPairFinder finder_;
    NearPairFinder near_;
};

}  // namespace nearfield::exact
