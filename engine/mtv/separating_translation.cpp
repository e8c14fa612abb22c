#include <engine/base/interruption.hpp>
#include <engine/mtv/separating_translation.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace nearfield::mtv {

using geometry::Vector;

namespace {

// Evenly spaced directions tried for any shapes, as long as they take at most a quarter of the
// work.
constexpr int even_directions = 8;
constexpr std::uint64_t part_of_directions = 16;
constexpr std::uint64_t work_before_looking = 8;

// No more than half of the work goes into tests of cells' middles.
constexpr std::uint64_t part_of_tests = 2;

// Of so many pairs of edges that cross, the one that certifies most is used.
constexpr std::size_t max_crossings = 64;

// If a crossing found before certifies more of a cell than this, no other is looked for.
constexpr double enough_of_rest = 0.05;

// Maximum number of slides of the best translation along a wall, from corner to corner.
constexpr int max_slides = 16;

// A relative gain below this does not count as shorter.
constexpr double min_gain = 1e-6;

// A translation is lengthened until the shapes test as separate, by a factor of four each time and
// by at most this much in total: along edges that barely separate, rounding exceeds that of a
// vertex.
constexpr double longer_each_time = 4.0;
constexpr int trials_of_clearance = 10;
constexpr double max_clearances = 262144.0;  // in the last trial

// Transforming an edge, inserting it into a tree and testing it costs about as much as comparing it
// with this many others.
constexpr std::uint64_t work_of_test = 4;

Vector along(const simd::TransformedEdges& edges, std::uint32_t edge) {
    return edges.end(edge) - edges.start(edge);
}

}  // namespace

const simd::TransformedEdges& SeparatingTranslationFinder::move_a(const Vector& shift) {
    Pose pose = pose_a_;
    pose.translation.x += shift.x();
    pose.translation.y += shift.y();
    moved_.clear();
    const std::uint32_t index = moved_.place(a_->placed.polygon(), pose);
    moved_.complete(index);
    return moved_[index];
}

bool SeparatingTranslationFinder::separates(const Vector& shift) {
    checkpoint();
    work_.add(work_of_test * (a_->count + b_->count));
    return !overlap_test_.intersect(move_a(shift), *b_);
}

bool SeparatingTranslationFinder::accept(const Vector& shift) {
    const double length = shift.norm();
    if (!(length < length_) || !separates(shift)) {
        return false;
    }
    best_ = shift;
    length_ = length;
    return true;
}

bool SeparatingTranslationFinder::try_gap(const TranslationGap& gap, const Vector& direction,
                                          double longest) {
    const double most = max_clearances * clearance_;
    // Shapes whose boundaries do not intersect are separate or one contains the other, throughout
    // the gap.
    const double within = std::min(gap.from + most, 0.5 * (gap.from + gap.to));
    if (within < longest && !separates(within * direction)) {
        return false;
    }
    double clearance = clearance_;
    for (int trial = 0; trial < trials_of_clearance; ++trial) {
        const double way = gap.from + clearance;
        if (way >= std::min(longest, gap.to)) {
            return false;
        }
        if (accept(way * direction)) {
            return true;
        }
        clearance *= longer_each_time;
    }
    return false;
}

bool SeparatingTranslationFinder::try_direction(const Vector& direction, simd::EdgePair& wall) {
    const double longest = (1.0 - min_gain) * length_;
    WorkBudget work = work_for_directions();
    const std::vector<TranslationGap>& gaps = shifts_.find(*a_, *b_, direction, longest, work);
    add_for_directions(work.used());
    const auto shorter =
        std::find_if(gaps.begin(), gaps.end(), [&](const TranslationGap& candidate) {
            return !work_.is_used_up() && try_gap(candidate, direction, longest);
        });
    if (shorter == gaps.end()) {
        return false;
    }
    wall = shorter->begins_at;
    return true;
}

void SeparatingTranslationFinder::go_past_box() {
    const geometry::Box& a = a_->box;
    const geometry::Box& b = b_->box;
    const double ways[] = {b.max().x() - a.min().x(), a.max().x() - b.min().x(),
                           b.max().y() - a.min().y(), a.max().y() - b.min().y()};
    const Vector directions[] = {Vector::UnitX(), -Vector::UnitX(), Vector::UnitY(),
                                 -Vector::UnitY()};
    const auto shortest = std::min_element(std::begin(ways), std::end(ways)) - std::begin(ways);
    double clearance = clearance_;
    do {
        best_ = (ways[shortest] + clearance) * directions[shortest];
        clearance *= longer_each_time;
    } while (!separates(best_));
    length_ = best_.norm();
}

void SeparatingTranslationFinder::descend(const Vector& direction) {
    simd::EdgePair wall;
    bool shorter = try_direction(direction, wall);
    if (!shorter) {
        return;
    }
    while (shorter && !work_for_directions().is_used_up()) {
        const Vector edges[] = {along(*a_, wall.first), along(*b_, wall.second)};
        shorter = false;
        for (const Vector& edge : edges) {
            const double length = edge.norm();
            const Vector normal(-edge.y(), edge.x());
            const double side = normal.dot(best_) < 0.0 ? -1.0 : 1.0;
            shorter = (length > 0.0 && try_direction(side / length * normal, wall)) || shorter;
        }
    }
    slide_into_corner(wall);
}

bool SeparatingTranslationFinder::slide(const Vector& along, simd::EdgePair& wall) {
    const double length = along.norm();
    if (!(length > 0.0)) {
        return false;
    }
    const Vector direction = (along.dot(best_) > 0.0 ? -1.0 : 1.0) / length * along;
    const double most = -direction.dot(best_);
    if (most <= min_gain * length_) {
        return false;
    }
    WorkBudget work = work_for_directions();
    const TranslationGap gap = shifts_.find_first(move_a(best_), *b_, direction, most, work);
    add_for_directions(work.used());
    if (gap.from > 0.0) {
        return false;
    }
    const Vector from = best_;
    double clearance = clearance_;
    for (int trial = 0; trial < trials_of_clearance; ++trial) {
        const double way = std::min(most, gap.to - clearance);
        if (way <= 0.0) {
            return false;
        }
        if (accept(from + way * direction)) {
            wall = gap.ends_at;
            return gap.to < most;
        }
        clearance *= longer_each_time;
    }
    return false;
}

void SeparatingTranslationFinder::slide_into_corner(simd::EdgePair wall) {
    for (int i = 0; i < max_slides && !work_for_directions().is_used_up(); ++i) {
        const simd::EdgePair from = wall;
        if (!slide(along(*a_, from.first), wall) && !slide(along(*b_, from.second), wall)) {
            return;
        }
    }
}

void SeparatingTranslationFinder::look_around() {
    for (int i = 0; i < even_directions && !work_for_directions().is_used_up(); ++i) {
        descend(geometry::direction(2.0 * std::numbers::pi * i / even_directions));
    }
}

WorkBudget SeparatingTranslationFinder::work_for_directions() const {
    const std::uint64_t most = max_work_ / part_of_directions;
    return WorkBudget(std::min(work_.left(), most - std::min(most, used_for_directions_)));
}

void SeparatingTranslationFinder::add_for_directions(std::uint64_t work) {
    work_.add(work);
    used_for_directions_ += work;
}

void SeparatingTranslationFinder::go_to_nearest(const ConvexPiece& piece) {
    const Vector nearest = piece.nearest_of_core();
    if (accept(nearest)) {
        return;
    }
    // Rounding of the lines: a little farther into the core.
    const Vector inwards = piece.middle() - nearest;
    double part = clearance_ / inwards.norm();
    for (int trial = 0; trial < trials_of_clearance && part < 1.0; ++trial) {
        if (accept(nearest + part * inwards)) {
            return;
        }
        part *= longer_each_time;
    }
    static_cast<void>(accept(piece.middle()));
}

double SeparatingTranslationFinder::nearest_open() {
    double open = length_;
    for (const ConvexPiece& piece : cover_.pieces()) {
        const double nearest = piece.nearest().norm();
        if (nearest >= open) {
            continue;
        }
        if (work_.is_used_up()) {
            open = nearest;  // it may separate the shapes
        } else if (!is_crossed(piece.middle()) && separates(piece.middle())) {
            go_to_nearest(piece);
            open = nearest;
        }
    }
    return open;
}

bool SeparatingTranslationFinder::find_crossing(const Vector& shift, CrossingCertificate& best) {
    checkpoint();
    const geometry::Box box = cover_.rest().box();
    const Vector half = 0.5 * box.diagonal();
    double largest = 0.0;
    work_.add(crossings_.size() / 4);
    for (const CrossingCertificate& crossing : crossings_) {
        const double part = crossing.part_of(shift, half);
        if (part > largest) {
            largest = part;
            best = crossing;
        }
    }
    if (largest > enough_of_rest) {
        return true;
    }
    const std::uint64_t before = work_.used();
    work_.add(work_of_test * (a_->count + b_->count));
    std::size_t tried = 0;
    const double found = largest;
    static_cast<void>(pairs_.for_each(move_a(shift), *b_, [&](const simd::EdgePair& pair) {
        const CrossingCertificate crossing = crossing_of(*a_, *b_, pair);
        const double part = crossing.part_of(shift, half);
        if (part > largest) {
            largest = part;
            best = crossing;
        }
        return ++tried < max_crossings && largest < 1.0;
    }));
    work_.add(tried);
    used_for_tests_ += work_.used() - before;
    if (largest > found) {
        crossings_.push_back(best);
    }
    return largest > 0.0;
}

bool SeparatingTranslationFinder::is_crossed(const Vector& shift) {
    work_.add(crossings_.size() / 4);
    return std::any_of(crossings_.begin(), crossings_.end(),
                       [&](const CrossingCertificate& crossing) {
                           return crossing.reach(shift, Vector::Zero()).least > 0.0;
                       });
}

bool SeparatingTranslationFinder::settle_by_crossings(const TranslationCell& cell) {
    CrossingCertificate crossing;
    while (used_for_tests_ < work_.used() / part_of_tests &&
           find_crossing(cover_.rest().middle(), crossing)) {
        if (!cover_.cut_off(crossing)) {
            return cover_.divide(cell, crossing);
        }
        if (cover_.rest().is_empty()) {
            return true;
        }
    }
    return false;
}

void SeparatingTranslationFinder::test_middle() {
    if (used_for_tests_ >= work_.used() / part_of_tests) {
        return;
    }
    const std::uint64_t before = work_.used();
    const bool is_shorter = accept(cover_.rest().middle());
    used_for_tests_ += work_.used() - before;
    if (is_shorter) {
        descend(best_.normalized());
    }
}

void SeparatingTranslationFinder::find_lower_bound(double tolerance) {
    if (work_.is_used_up()) {
        return;
    }
    cover_.begin(*a_, *b_, length_, a_->rounding + b_->rounding, clearance_, work_);
    double open = length_;  // length of the shortest that may separate the shapes, so far
    bool has_looked_around = false;
    const bool has_many_edges = !is_small(*a_) || !is_small(*b_);
    used_for_tests_ = 0;
    crossings_.clear();
    while (!cover_.is_empty()) {
        checkpoint();
        const TranslationCell square = cover_.take_nearest();
        lower_bound_ = std::min({square.nearest, open, length_});
        if (square.nearest >= std::min(open, length_ - tolerance) || work_.is_used_up()) {
            return;
        }
        if (!has_looked_around && work_.used() > max_work_ / work_before_looking) {
            look_around();
            has_looked_around = true;
        }
        if (cover_.overlaps(square) || (has_many_edges && settle_by_crossings(square))) {
            continue;
        }
        const CellState word = cover_.ask(square);
        if (word == CellState::overlapping) {
            continue;
        }
        if (word == CellState::uniform) {
            open = std::min(open, nearest_open());
            continue;
        }
        if (word == CellState::unknown) {
            test_middle();
        }
        cover_.cut(square);
    }
    lower_bound_ = std::min(open, length_);
}

SeparatingTranslation SeparatingTranslationFinder::find(const simd::TransformedEdges& a,
                                                        const simd::TransformedEdges& b,
                                                        const Pose& pose_a,
                                                        const SeparatingTranslationLimits& limits) {
    a_ = &a;
    b_ = &b;
    pose_a_ = pose_a;
    clearance_ = 4.0 * (a.rounding + b.rounding);
    best_ = Vector::Zero();
    lower_bound_ = 0.0;
    max_work_ = limits.max_work;
    used_for_directions_ = 0;
    work_ = WorkBudget(limits.max_work);
    SeparatingTranslation way;
    way.intersect = overlap_test_.intersect(a, b);
    if (!way.intersect) {
        return way;
    }
    go_past_box();
    shifts_.begin(a, b, length_);
    try {
        descend(best_.normalized());
        find_lower_bound(limits.tolerance);
    } catch (const Interrupted&) {
        // The best translation separates the shapes, and the bound held when it was stated.
        lower_bound_ = std::min(lower_bound_, length_);
    }
    way.vector = best_;
    way.lower_bound = lower_bound_;
    way.work = work_.used();
    return way;
}

}  // namespace nearfield::mtv
