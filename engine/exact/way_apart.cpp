#include <engine/exact/way_apart.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace nearfield::exact {

using geometry::Vector;

namespace {

// Directions that are tried whatever the shapes, evenly spread, as long as they take no more than
// a quarter of the work.
constexpr int even_directions = 8;
constexpr std::uint64_t part_of_directions = 4;

// How often the best is moved along a wall, from corner to corner.
constexpr int most_slides = 16;

// What is shorter by less than this part is no shorter.
constexpr double least_gain = 1e-6;

// Until the shapes are seen to be apart a way is made longer, by four times as much each time and
// by so much at the most: rounding along edges that hardly part is more than that of a vertex.
constexpr double longer_each_time = 4.0;
constexpr int trials_of_clearance = 10;
constexpr double most_clearances = 262144.0;  // of the last of them

// To place an edge, put it into boxes and test it takes about as long as to hold it against so
// many others.
constexpr std::uint64_t work_of_test = 8;

Vector along(const PlacedEdges& edges, std::uint32_t edge) {
    return edges.end(edge) - edges.start(edge);
}

}  // namespace

const PlacedEdges& WayApartFinder::move_a(const Vector& shift) {
    Pose pose = pose_a_;
    pose.translation.x += shift.x();
    pose.translation.y += shift.y();
    moved_.clear();
    const std::uint32_t index = moved_.place(a_->placed.polygon(), pose);
    moved_.complete(index);
    return moved_[index];
}

bool WayApartFinder::separates(const Vector& shift) {
    work_.add(work_of_test * (a_->count + b_->count));
    return !meeting_.intersect(move_a(shift), *b_);
}

bool WayApartFinder::accept(const Vector& shift) {
    const double length = shift.norm();
    if (!(length < length_) || !separates(shift)) {
        return false;
    }
    best_ = shift;
    length_ = length;
    return true;
}

bool WayApartFinder::try_gap(const ShiftGap& gap, const Vector& direction, double longest) {
    const double most = most_clearances * clearance_;
    // Whose boundaries do not meet are apart or hold each other, and that all along the gap.
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

bool WayApartFinder::try_direction(const Vector& direction, EdgePair& wall) {
    const double longest = (1.0 - least_gain) * length_;
    const std::vector<ShiftGap>& gaps = shifts_.find(*a_, *b_, direction, longest, work_);
    const auto shorter = std::find_if(gaps.begin(), gaps.end(), [&](const ShiftGap& candidate) {
        return !work_.is_used_up() && try_gap(candidate, direction, longest);
    });
    if (shorter == gaps.end()) {
        return false;
    }
    wall = shorter->begins_at;
    return true;
}

void WayApartFinder::go_past_box() {
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

void WayApartFinder::descend(const Vector& direction) {
    EdgePair wall;
    bool shorter = try_direction(direction, wall);
    if (!shorter) {
        return;
    }
    while (shorter && !work_.is_used_up()) {
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

bool WayApartFinder::slide(const Vector& along, EdgePair& wall) {
    const double length = along.norm();
    if (!(length > 0.0)) {
        return false;
    }
    const Vector direction = (along.dot(best_) > 0.0 ? -1.0 : 1.0) / length * along;
    const double most = -direction.dot(best_);
    if (most <= least_gain * length_) {
        return false;
    }
    const ShiftGap gap = shifts_.find_first(move_a(best_), *b_, direction, most, work_);
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

void WayApartFinder::slide_into_corner(EdgePair wall) {
    for (int i = 0; i < most_slides && !work_.is_used_up(); ++i) {
        const EdgePair from = wall;
        if (!slide(along(*a_, from.first), wall) && !slide(along(*b_, from.second), wall)) {
            return;
        }
    }
}

void WayApartFinder::look_around() {
    const std::uint64_t enough = work_.left() - work_.left() / part_of_directions;
    for (int i = 0; i < even_directions && work_.left() > enough; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / even_directions;
        descend({std::cos(angle), std::sin(angle)});
    }
}

void WayApartFinder::go_to_nearest(const ConvexPiece& piece) {
    const Vector nearest = piece.nearest();
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

double WayApartFinder::nearest_open() {
    double open = length_;
    for (const ConvexPiece& piece : cover_.pieces()) {
        const double nearest = piece.nearest().norm();
        if (nearest >= open) {
            continue;
        }
        if (work_.is_used_up()) {
            open = nearest;  // it may be
        } else if (separates(piece.middle())) {
            go_to_nearest(piece);
            open = nearest;
        }
    }
    return open;
}

double WayApartFinder::find_lower_bound(double tolerance) {
    if (work_.is_used_up()) {
        return 0.0;
    }
    cover_.begin(*a_, *b_, length_, a_->rounding + b_->rounding, work_);
    double open = length_;  // how near one is that may separate the shapes, of those looked at
    while (!cover_.is_empty()) {
        const ShiftSquare square = cover_.take_nearest();
        if (square.nearest >= std::min(open, length_ - tolerance) || work_.is_used_up()) {
            return std::min({square.nearest, open, length_});
        }
        const ShiftWord word = cover_.ask(square);
        if (word == ShiftWord::meet) {
            continue;
        }
        if (word == ShiftWord::alike) {
            open = std::min(open, nearest_open());
            continue;
        }
        if (word == ShiftWord::nothing && accept(cover_.rest().middle())) {
            descend(best_.normalized());
        }
        cover_.cut(square);
    }
    return std::min(open, length_);
}

WayApart WayApartFinder::find(const PlacedEdges& a, const PlacedEdges& b, const Pose& pose_a,
                              const WayApartLimits& limits) {
    a_ = &a;
    b_ = &b;
    pose_a_ = pose_a;
    clearance_ = 4.0 * (a.rounding + b.rounding);
    best_ = Vector::Zero();
    work_ = WorkMeter(limits.most_work);
    WayApart way;
    way.intersect = meeting_.intersect(a, b);
    if (!way.intersect) {
        return way;
    }
    go_past_box();
    look_around();
    way.lower_bound = find_lower_bound(limits.tolerance);
    way.vector = best_;
    way.work = work_.used();
    return way;
}

}  // namespace nearfield::exact
