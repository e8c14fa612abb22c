#pragma once

#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/toi/motion.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::toi {

/// The required accuracy of the time of impact, and the maximum cost.
struct ContactAim {
    double motion = 0.0;  ///< largest relative motion of two points in the interval left open
    double time = 1.0;    ///< largest length of that interval
    std::uint32_t max_steps = 0;  ///< maximum number of distance queries
    double distance = 0.0;        ///< shapes at most this far apart touch
};

/// The first contact of two moving shapes, as far as it is known.
struct Impact {
    enum class Kind : std::uint8_t {
        none,      ///< separate from 0 to 1
        found,     ///< between `time` and `latest`
        at_start,  ///< touching at 0
        unknown,   ///< separate until `time`; may touch before `latest`, but where was not found
    };
    Kind kind = Kind::none;
    double time = 0.0;             ///< separate from 0 until this time
    double latest = 0.0;           ///< found: they touch no later than this, up to `rounding`
    bool touch_at_latest = false;  ///< confirmed to touch then
    bool share_a_point_at_start = false;  ///< at_start: they are not merely near
    narrowphase::ClosestPair closest;     ///< at `time`, unless they share a point
    double min_distance = std::numeric_limits<double>::infinity();  ///< lower bound before `time`
    double rounding = 0.0;    ///< shapes reported as touching are at most this far apart
    std::uint32_t steps = 0;  ///< number of distance queries
};

/// Finds the time of impact by conservative advancement: repeatedly moves from a time at which the
/// shapes are separate to a later one before which they cannot have touched. Reuses its memory
/// between pairs.
///
/// The step. Separate boundaries first touch where a vertex of one reaches an edge of the other. A
/// near vertex-edge pair is separated by a direction n: along n the vertex is ahead of neither end
/// of the edge. Their distance along n is a function of time with known value and slope, and the
/// accelerations bound its second derivative, so it stays above a given length until the root of a
/// parabola. The ends of the edge enclose its other points, so the bound holds for all of them.
/// Pairs beyond some distance are covered by a bound on all relative motion. If shapes touch at a
/// positive distance, the given length is larger than that distance.
class ConservativeAdvancement {
public:
    /// If the call is interrupted, ends as with a limit of steps reached; before the first distance
    /// is known, it throws Interrupted.
    [[nodiscard]] Impact find(const Motion& a, const Motion& b, const ContactAim& aim);

    /// The shapes at the start. Precondition: find() returned share_a_point_at_start.
    [[nodiscard]] const simd::TransformedEdges& transformed_a() const {
        return instances_[index_a_];
    }
    [[nodiscard]] const simd::TransformedEdges& transformed_b() const {
        return instances_[index_b_];
    }

private:
    /// Transforms the shapes to their poses at a time, and counts a step.
    void place(double time, Impact& contact);
    [[nodiscard]] bool meet();
    /// Leaves the shapes at that time. `at_most`: a known upper bound on their distance then.
    [[nodiscard]] bool touch_at(double time, double distance, double at_most, Impact& contact);
    /// Whether the shapes touch at `ahead` after contact.time, the time of the last query; leaves
    /// them at the later time.
    [[nodiscard]] bool touch_soon(const ContactAim& aim, double ahead, Impact& contact);
    /// `at_most`: a known upper bound on their distance.
    [[nodiscard]] narrowphase::ClosestPair find_closest(double at_most);

    /// The shapes at one time.
    struct Look {
        double time;
        double moved;         ///< upper bound on the motion since the previous time
        double min_distance;  ///< until then
        const narrowphase::ClosestPair& closest;
    };
    void advance(const ContactAim& aim, Impact& contact);
    /// Ends the search with the time interval open; takes one more step.
    void give_up(const ContactAim& aim, Impact& contact);
    /// Records a distance query in `contact`; returns whether the search is done.
    [[nodiscard]] bool settle(const ContactAim& aim, const Look& look, Impact& contact);
    /// How long no vertex and edge come as close as `keep`; at most `left`. `distance`: now.
    [[nodiscard]] double safe_step(double distance, double keep, double left);
    /// Lists every vertex of one shape and edge of the other at most `distance` apart, and perhaps
    /// a few more, in near_: separate boundaries first touch at such a pair. Returns false, with
    /// only some of them listed, if there are more than `most`.
    [[nodiscard]] bool find_near(double distance, std::size_t most);
    [[nodiscard]] double pair_step(const simd::VertexAndEdge& pair, double keep) const;

    const Motion* a_ = nullptr;
    const Motion* b_ = nullptr;
    double rounding_ = 0.0;  // of the distance of two points at a time, and of the time
    // State at the time of the last query.
    simd::TransformedInstances instances_;
    std::uint32_t index_a_ = 0;
    std::uint32_t index_b_ = 0;
    MotionState state_a_;
    MotionState state_b_;
    RelativeMotion motion_;

    double reach_ = 0.0;  // search distance for pairs in the last step, reduced if it did not pay
    narrowphase::OverlapTest overlap_test_;
    narrowphase::ClosestPairFinder finder_;
    std::vector<simd::VertexAndEdge> near_;
};

}  // namespace nearfield::toi
