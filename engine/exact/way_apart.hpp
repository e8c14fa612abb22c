#pragma once

#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/exact/shifts.hpp>
#include <engine/exact/witnesses.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// A translation of A that separates it from B.
struct WayApart {
    bool intersect = false;  ///< at rest; where false, nothing has to move
    geometry::Vector vector = geometry::Vector::Zero();
    double lower_bound = 0.0;  ///< no shorter translation separates them
};

/// Finds a short translation of A that separates two shapes, and a bound below which there is none.
/// Keeps its memory from pair to pair.
///
/// The translations for which the shapes share a point are a set, the Minkowski sum of B and A
/// mirrored, and sought is the way out of it from 0. Along a direction it is found exactly
/// (ShiftFinder), and no translation counts that the intersection test has not seen to separate
/// them. It is straight at right angles to an edge of either shape wherever it ends on a wall of
/// the set, so from the edges that part last the search goes on to their normals.
///
/// The bound: squares of translations, the nearest to 0 first. A square is done with where a
/// witness says of the translation at its middle that no other translation in the square separates
/// the shapes; otherwise it is cut in four, and the way through its middle is tried.
class WayApartFinder {
public:
    /// `pose_a`: where A was placed. The search ends where the length is within `tolerance` of the
    /// bound, or after a fixed number of trials.
    [[nodiscard]] WayApart find(const PlacedEdges& a, const PlacedEdges& b, const Pose& pose_a,
                                double tolerance);

private:
    /// A square of translations.
    struct Cell {
        geometry::Vector centre;
        double half = 0.0;          ///< of its side
        double nearest = 0.0;       ///< no translation in it is shorter
        std::uint32_t witness = 0;  ///< that said most of the square it was cut from
    };
    /// What the witnesses say of a translation.
    struct Word {
        double reach = 0.0;  ///< no translation separates the shapes that differs by less
        std::uint32_t witness = 0;
    };

    [[nodiscard]] bool separates(const geometry::Vector& shift);
    /// The first way there is: along an axis, until the boxes are apart.
    void go_past_box();
    /// Tries the shortest way that ends in a gap; true where it separates the shapes and is
    /// shorter than `longest`.
    bool try_gap(const ShiftGap& gap, const geometry::Vector& direction, double longest);
    /// True where it gives a shorter way; then `gap` is where it ends.
    bool try_direction(const geometry::Vector& direction, ShiftGap& gap);
    /// Tries a direction and, from there, normals of edges.
    void descend(const geometry::Vector& direction);
    /// Turns the best direction a little, to either side.
    void turn_best();
    [[nodiscard]] geometry::Vector normal_of(const PlacedEdges& edges, std::uint32_t edge) const;

    [[nodiscard]] double depth_of(std::uint32_t witness, const geometry::Vector& shift) const;
    [[nodiscard]] double crossing_depth_at(const geometry::Vector& shift);
    /// Looks no farther than `enough`.
    [[nodiscard]] Word ask_witnesses(const Cell& cell, double enough);
    void push(const geometry::Vector& centre, double half, std::uint32_t witness);
    [[nodiscard]] Cell pop();
    [[nodiscard]] double find_lower_bound(double tolerance);

    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    Pose pose_a_;
    double clearance_ = 0.0;  // what a way is longer than to where the shapes touch
    geometry::Vector best_ = geometry::Vector::Zero();
    double length_ = 0.0;  // of the best
    PlacedInstances moved_;
    MeetingFinder meeting_;
    ShiftFinder shifts_;
    Witnesses of_a_;
    Witnesses of_b_;
    std::vector<Cell> cells_;  // a heap, the nearest first
    double work_left_ = 0.0;   // edges that may still be looked at
};

}  // namespace nearfield::exact
