#include <engine/exact/way_apart.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace nearfield::exact {
namespace {

using geometry::Vector;

// Directions that are tried whatever the shapes, evenly spread.
constexpr int even_directions = 32;

// How often the best direction is turned, by half as much each time that does not help.
constexpr int turns = 10;

// What the search for the lower bound may cost: edges that points are held against, and as many
// more for each edge there is, since the search along directions takes longer too.
constexpr double most_work = 1U << 21U;
constexpr double work_of_edge = 1U << 13U;

// A pair of edges that a direction is held against, and an edge of a shape that is tested, take
// about as long as so many of those.
constexpr double work_of_pair = 16.0;
constexpr double work_of_test = 8.0;

// What is shorter by less than this part is no shorter.
constexpr double least_gain = 1e-6;

// Until the shapes are seen to be apart a way is made longer, by four times as much each time and
// by so much at the most: rounding along edges that hardly part is more than that of a vertex.
constexpr double longer_each_time = 4.0;
constexpr int trials_of_clearance = 10;
constexpr double most_clearances = 262144.0;  // of the last of them

bool is_farther(double nearest, double other_nearest) {
    return nearest > other_nearest;
}

}  // namespace

bool WayApartFinder::separates(const Vector& shift) {
    Pose pose = pose_a_;
    pose.translation.x += shift.x();
    pose.translation.y += shift.y();
    work_left_ -= work_of_test * (a_->count + b_->count);
    moved_.clear();
    const std::uint32_t index = moved_.place(a_->placed.polygon(), pose);
    moved_.complete(index);
    return !meeting_.intersect(moved_[index], *b_);
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
        const Vector shift = way * direction;
        if (separates(shift)) {
            best_ = shift;
            length_ = shift.norm();
            return true;
        }
        clearance *= longer_each_time;
    }
    return false;
}

bool WayApartFinder::try_direction(const Vector& direction, ShiftGap& gap) {
    const double longest = (1.0 - least_gain) * length_;
    const std::vector<ShiftGap>& gaps = shifts_.find(*a_, *b_, direction, longest);
    work_left_ -= work_of_pair * static_cast<double>(shifts_.pairs_looked_at());
    const auto shorter = std::find_if(gaps.begin(), gaps.end(), [&](const ShiftGap& candidate) {
        return try_gap(candidate, direction, longest);
    });
    if (shorter == gaps.end()) {
        return false;
    }
    gap = *shorter;
    return true;
}

Vector WayApartFinder::normal_of(const PlacedEdges& edges, std::uint32_t edge) const {
    const Vector along = edges.end(edge) - edges.start(edge);
    const Vector normal(-along.y(), along.x());
    return normal.dot(best_) < 0.0 ? Vector(-normal) : normal;
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
    ShiftGap gap;
    bool shorter = try_direction(direction, gap);
    while (shorter) {
        const Vector normals[] = {normal_of(*a_, gap.edge_a), normal_of(*b_, gap.edge_b)};
        shorter = false;
        for (const Vector& normal : normals) {
            const double length = normal.norm();
            shorter = (length > 0.0 && try_direction(normal / length, gap)) || shorter;
        }
    }
}

void WayApartFinder::turn_best() {
    double angle = std::numbers::pi / even_directions;
    for (int i = 0; i < turns; ++i) {
        const double before = length_;
        for (const double sign : {-1.0, 1.0}) {
            descend(Eigen::Rotation2Dd(sign * angle) * best_.normalized());
        }
        if (length_ == before) {
            angle /= 2.0;
        }
    }
}

double WayApartFinder::depth_of(std::uint32_t witness, const Vector& shift) const {
    const std::vector<Witness>& of_a = of_a_.all();
    if (witness < of_a.size()) {
        return of_a[witness].radius + depth_in(*b_, of_a[witness].centre + shift);
    }
    const Witness& of_b = of_b_.all()[witness - of_a.size()];
    return of_b.radius + depth_in(*a_, of_b.centre - shift);
}

double WayApartFinder::crossing_depth_at(const Vector& shift) {
    double deepest = -1.0;
    for (const Chord& of_a : of_a_.chords()) {
        for (const Chord& of_b : of_b_.chords()) {
            deepest = std::max(deepest, crossing_depth(of_a, shift, of_b));
        }
    }
    work_left_ -= static_cast<double>(of_a_.chords().size() * of_b_.chords().size());
    return deepest;
}

WayApartFinder::Word WayApartFinder::ask_witnesses(const Cell& cell, double enough) {
    const auto of_a = static_cast<std::uint32_t>(of_a_.all().size());
    const auto count = of_a + static_cast<std::uint32_t>(of_b_.all().size());
    Word word{-std::numeric_limits<double>::infinity(), 0};
    const auto ask = [&](std::uint32_t witness) {
        const double depth = depth_of(witness, cell.centre) - clearance_;
        if (depth > word.reach) {
            word = {depth, witness};
        }
        work_left_ -= witness < of_a ? b_->count : a_->count;
        return word.reach >= enough;
    };
    // The square it was cut from mostly had the same.
    if (cell.witness < count && ask(cell.witness)) {
        return word;
    }
    const double crossing = crossing_depth_at(cell.centre) - clearance_;
    word.reach = std::max(word.reach, crossing);
    if (crossing >= enough) {
        return word;
    }
    for (std::uint32_t witness = 0; witness < count; ++witness) {
        if (ask(witness)) {
            break;
        }
    }
    return word;
}

void WayApartFinder::push(const Vector& centre, double half, std::uint32_t witness) {
    const Vector beside = (centre.cwiseAbs().array() - half).matrix().cwiseMax(0.0);
    cells_.push_back({centre, half, beside.norm(), witness});
    std::push_heap(cells_.begin(), cells_.end(),
                   [](const Cell& i, const Cell& j) { return is_farther(i.nearest, j.nearest); });
}

WayApartFinder::Cell WayApartFinder::pop() {
    std::pop_heap(cells_.begin(), cells_.end(),
                  [](const Cell& i, const Cell& j) { return is_farther(i.nearest, j.nearest); });
    Cell cell = cells_.back();
    cells_.pop_back();
    return cell;
}

double WayApartFinder::find_lower_bound(double tolerance) {
    work_left_ = most_work + work_of_edge * (a_->count + b_->count);
    of_a_.choose(*a_);
    of_b_.choose(*b_);
    cells_.clear();
    push(Vector::Zero(), length_, 0);
    while (!cells_.empty()) {
        const Cell cell = pop();
        // The best may have become shorter in between.
        if (cell.nearest >= length_ - tolerance || work_left_ <= 0.0) {
            return std::min(cell.nearest, length_);
        }
        const double radius = std::numbers::sqrt2 * cell.half;
        // None can say it of a square that reaches as far as the best way.
        const bool may_be_done = radius < (best_ - cell.centre).norm();
        const Word word = may_be_done ? ask_witnesses(cell, radius) : Word{0.0, cell.witness};
        if (word.reach >= radius) {
            continue;
        }
        if (word.reach <= 0.0 && cell.centre.norm() > 0.0) {
            descend(cell.centre.normalized());
        }
        const double half = 0.5 * cell.half;
        for (const double x : {-half, half}) {
            for (const double y : {-half, half}) {
                push(cell.centre + Vector(x, y), half, word.witness);
            }
        }
    }
    return length_;
}

WayApart WayApartFinder::find(const PlacedEdges& a, const PlacedEdges& b, const Pose& pose_a,
                              double tolerance) {
    a_ = &a;
    b_ = &b;
    pose_a_ = pose_a;
    clearance_ = 4.0 * (a.rounding + b.rounding);
    best_ = Vector::Zero();
    WayApart way;
    way.intersect = meeting_.intersect(a, b);
    if (!way.intersect) {
        return way;
    }
    go_past_box();
    for (int i = 0; i < even_directions; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / even_directions;
        descend({std::cos(angle), std::sin(angle)});
    }
    turn_best();
    way.lower_bound = find_lower_bound(tolerance);
    way.vector = best_;
    return way;
}

}  // namespace nearfield::exact
