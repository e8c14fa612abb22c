#pragma once

#include <engine/mtv/translation_cells.hpp>
#include <engine/mtv/translations.hpp>
#include <engine/mtv/work_budget.hpp>
#include <engine/narrowphase/candidate_edge_pairs.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>

namespace nearfield::mtv {

/// A translation of A that separates it from B.
struct SeparatingTranslation {
    bool intersect = false;  ///< at the given poses; if false, nothing has to move
    geometry::Vector vector = geometry::Vector::Zero();
    double lower_bound = 0.0;  ///< no shorter translation separates them
    std::uint64_t work = 0;    ///< in units of WorkBudget
};

/// Termination criteria of the search.
struct SeparatingTranslationLimits {
    double tolerance = 0.0;  ///< allowed excess over the shortest length
    std::uint64_t max_work = 0;
};

/// Finds a short translation of A that separates two shapes, and a lower bound on all of them.
/// Reuses its memory between pairs.
///
/// The translations for which the shapes share a point form a set, the Minkowski sum of B and the
/// mirrored A; the search looks for the shortest way out of it from 0. Along a given direction
/// TranslationFinder finds it exactly, and no translation is accepted unless the intersection test
/// confirms that it separates the shapes. A locally shortest translation that ends on a wall of the
/// set is perpendicular to an edge of either shape, so the search continues from the edges that
/// separate last to their normals, and from there along the wall to its corner with another wall.
///
/// The lower bound comes from cells of translation space, nearest to 0 first (TranslationSearch).
/// An undecided cell is split into four, and where a cell's centre separates the shapes, the search
/// continues from there.
class SeparatingTranslationFinder {
public:
    /// `pose_a`: the pose of A. Stops once the length is within the tolerance of the bound, or once
    /// the work budget is spent; the current step is then completed. If the call is interrupted, it
    /// returns the best translation and bound so far; before there is any, it throws Interrupted.
    [[nodiscard]] SeparatingTranslation find(const simd::TransformedEdges& a,
                                             const simd::TransformedEdges& b, const Pose& pose_a,
                                             const SeparatingTranslationLimits& limits);

private:
    /// A after a translation. Valid until the next call.
    [[nodiscard]] const simd::TransformedEdges& move_a(const geometry::Vector& shift);
    [[nodiscard]] bool separates(const geometry::Vector& shift);
    /// If the translation is shorter than the best and separates the shapes, makes it the best and
    /// returns true.
    bool accept(const geometry::Vector& shift);
    /// The first candidate: along an axis until the boxes are separate.
    void go_past_box();
    void look_around();
    /// What is left of the part of the work that directions may take.
    [[nodiscard]] WorkBudget work_for_directions() const;
    void add_for_directions(std::uint64_t work);
    /// Tries the shortest translation that ends in a gap; true if it separates the shapes and is
    /// shorter than `longest`.
    bool try_gap(const TranslationGap& gap, const geometry::Vector& direction, double longest);
    /// True if it gives a shorter translation; `wall` is then the pair of edges that separate at
    /// its end.
    bool try_direction(const geometry::Vector& direction, simd::EdgePair& wall);
    /// Tries a direction, then the normals of the edges reached, then slides along the wall.
    void descend(const geometry::Vector& direction);
    /// Moves the best translation along the wall it ends at, to where it is shortest or another
    /// wall blocks it; true if that is shorter. `wall` is then the blocking wall, if any.
    bool slide(const geometry::Vector& along, simd::EdgePair& wall);
    void slide_into_corner(simd::EdgePair wall);
    /// Makes the shortest of translations known to separate the shapes the best, if it is shorter.
    void go_to_nearest(const ConvexPiece& piece);
    /// Tests which of the pieces separate the shapes; returns the distance of the nearest, or the
    /// length.
    [[nodiscard]] double nearest_open();
    /// Writes, of the crossings found so far, and if none certifies a translation, of some edges
    /// that cross after it, the one that certifies most of the rest of a cell; false if none does.
    [[nodiscard]] bool find_crossing(const geometry::Vector& shift, CrossingCertificate& best);
    /// Cuts crossings off a cell that the certificates did not decide; true if nothing is left, or
    /// what is left was put back.
    [[nodiscard]] bool settle_by_crossings(const TranslationCell& cell);
    /// True if a crossing found so far certifies a translation.
    [[nodiscard]] bool is_crossed(const geometry::Vector& shift);
    /// Tries the middle of what is left of a cell.
    void test_middle();
    /// Raises the lower bound, until it is within the tolerance of the length or the work is used
    /// up.
    void find_lower_bound(double tolerance);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    Pose pose_a_;
    double clearance_ = 0.0;  // excess length beyond the point where the shapes touch
    geometry::Vector best_ = geometry::Vector::Zero();
    double length_ = 0.0;  // of the best
    double lower_bound_ = 0.0;
    WorkBudget work_;
    std::uint64_t max_work_ = 0;
    std::uint64_t used_for_directions_ = 0;
    std::uint64_t used_for_tests_ = 0;
    simd::TransformedInstances moved_;
    narrowphase::OverlapTest overlap_test_;
    narrowphase::CandidateEdgePairs pairs_;
    std::vector<CrossingCertificate> crossings_;  // found so far
    TranslationFinder shifts_;
    TranslationSearch cover_;
};

}  // namespace nearfield::mtv
