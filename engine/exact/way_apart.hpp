#pragma once

#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/exact/shift_cover.hpp>
#include <engine/exact/shifts.hpp>
#include <engine/exact/work_meter.hpp>

#include <cstdint>

namespace nearfield::exact {

/// A translation of A that separates it from B.
struct WayApart {
    bool intersect = false;  ///< at rest; where false, nothing has to move
    geometry::Vector vector = geometry::Vector::Zero();
    double lower_bound = 0.0;  ///< no shorter translation separates them
    std::uint64_t work = 0;    ///< by WorkMeter
};

/// How far to search for it.
struct WayApartLimits {
    double tolerance = 0.0;  ///< it may be so much longer than the shortest
    std::uint64_t most_work = 0;
};

/// Finds a short translation of A that separates two shapes, and a bound below which there is none.
/// Keeps its memory from pair to pair.
///
/// The translations for which the shapes share a point are a set, the Minkowski sum of B and A
/// mirrored, and sought is the way out of it from 0. Along a direction it is found exactly
/// (ShiftFinder), and no translation counts that the intersection test has not seen to separate
/// them. It is straight at right angles to an edge of either shape wherever it ends on a wall of
/// the set, so from the edges that part last the search goes on to their normals; and from there
/// along the wall, into the corner with another one.
///
/// The bound: squares of translations, the nearest to 0 first (ShiftCover). What is not settled is
/// cut in four, and where a square's middle separates the shapes, the search goes on from there.
class WayApartFinder {
public:
    /// `pose_a`: where A was placed. The search ends where the length is within the tolerance of
    /// the bound, or where the work is done; then only the step at hand is finished.
    [[nodiscard]] WayApart find(const PlacedEdges& a, const PlacedEdges& b, const Pose& pose_a,
                                const WayApartLimits& limits);

private:
    /// A where it is after a translation. Valid until it is moved again.
    [[nodiscard]] const PlacedEdges& move_a(const geometry::Vector& shift);
    [[nodiscard]] bool separates(const geometry::Vector& shift);
    /// True where the translation is shorter than the best and separates them; then it is the best.
    bool accept(const geometry::Vector& shift);
    /// The first way there is: along an axis, until the boxes are apart.
    void go_past_box();
    void look_around();
    /// Tries the shortest way that ends in a gap; true where it separates the shapes and is
    /// shorter than `longest`.
    bool try_gap(const ShiftGap& gap, const geometry::Vector& direction, double longest);
    /// True where it gives a shorter way; then `wall` is what parts where it ends.
    bool try_direction(const geometry::Vector& direction, EdgePair& wall);
    /// Tries a direction and, from there, normals of edges; then goes along the wall.
    void descend(const geometry::Vector& direction);
    /// Moves the best along a wall it ends at, to where it is shortest or another wall is in the
    /// way; true where that is shorter. Then `wall` is that other one, if there is one.
    bool slide(const geometry::Vector& along, EdgePair& wall);
    void slide_into_corner(EdgePair wall);
    /// The shortest of translations that are all known to separate the shapes, if it is the best.
    void go_to_nearest(const ConvexPiece& piece);
    /// Looks which of the pieces separate the shapes; how near the nearest is, or the length.
    [[nodiscard]] double nearest_open();
    [[nodiscard]] double find_lower_bound(double tolerance);

    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    Pose pose_a_;
    double clearance_ = 0.0;  // what a way is longer than to where the shapes touch
    geometry::Vector best_ = geometry::Vector::Zero();
    double length_ = 0.0;  // of the best
    WorkMeter work_;
    PlacedInstances moved_;
    MeetingFinder meeting_;
    ShiftFinder shifts_;
    ShiftCover cover_;
};

}  // namespace nearfield::exact
