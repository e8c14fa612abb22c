#include <engine/exact/shift_cover.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::exact {
namespace {

using geometry::Vector;

// What witnesses say is cut off, those that say most first, until so many said nothing that could
// be.
constexpr std::size_t most_others = 16;

// Depths are off by less than so many roundings.
constexpr double roundings_of_depth = 4.0;

// Lines that what is left is split along; of more it is cut in four.
constexpr std::size_t most_lines = 6;

// Groups of vertices that spread farther than this, by halves of a square, are asked by their
// parts.
constexpr double most_spread = 0.25;

bool is_farther(const ShiftSquare& i, const ShiftSquare& j) {
    return i.nearest > j.nearest;
}

/// The distance from 0 of a square.
double distance_of(const Vector& centre, double half) {
    return (centre.cwiseAbs().array() - half).matrix().cwiseMax(0.0).norm();
}

/// The unit vector to the left of a way.
Vector left_of(const Vector& along) {
    return Vector(-along.y(), along.x()).normalized();
}

/// Lists the edges no farther from a point, and perhaps a few more.
std::uint32_t find_edges_within(const PlacedEdges& edges, const Vector& point, double distance,
                                std::uint32_t* found) {
    const double squared = distance * distance;
    return is_small(edges)
               ? kernels::find_edges_within(edges, point.x(), point.y(), squared, found)
               : kernels::find_edges_within(edges.tree(), point.x(), point.y(), squared, found);
}

}  // namespace

void ShiftCover::begin(const PlacedEdges& a, const PlacedEdges& b, double longest, double rounding,
                       WorkMeter& work) {
    a_ = &a;
    b_ = &b;
    work_ = &work;
    rounding_ = rounding;
    edges_.resize(std::max(edges_.size(), padded(std::max(a.count, b.count))));
    witnesses_.clear();
    top_.clear();
    add_witnesses(a, work, witnesses_, top_);
    of_a_ = static_cast<std::uint32_t>(witnesses_.size());
    add_witnesses(b, work, witnesses_, top_);
    asked_.clear();
    for (const std::uint32_t witness : top_) {
        asked_.push_back({witness, 0.0});
    }
    lists_.assign(1, {0, asked_.size()});
    squares_.clear();
    push({Vector::Zero(), longest, 0.0, 0});
}

void ShiftCover::push(const ShiftSquare& square) {
    squares_.push_back(square);
    std::push_heap(squares_.begin(), squares_.end(), is_farther);
}

ShiftSquare ShiftCover::take_nearest() {
    std::pop_heap(squares_.begin(), squares_.end(), is_farther);
    ShiftSquare square = squares_.back();
    squares_.pop_back();
    return square;
}

Vector ShiftCover::place_of(std::uint32_t witness, const Vector& shift) const {
    const Vector& centre = witnesses_[witness].centre;
    return is_of_a(witness) ? Vector(centre + shift) : Vector(centre - shift);
}

void ShiftCover::cut_off(const Asked& vertex, const ShiftSquare& square, const Vector& outwards,
                         const Vector& start) {
    const Vector place = place_of(vertex.witness, square.centre);
    // The vertex goes where A goes, or A comes to where it is.
    const Vector way = is_of_a(vertex.witness) ? outwards : Vector(-outwards);
    // What is outside by no more than a part of the rounding still is touching.
    rest_.keep(way, way.dot(square.centre) + outwards.dot(start - place) + 0.5 * rounding_);
}

bool ShiftCover::cut_off_wall(const Asked& vertex, const ShiftSquare& square, double radius) {
    const PlacedEdges& other = is_of_a(vertex.witness) ? *b_ : *a_;
    const Vector place = place_of(vertex.witness, square.centre);
    work_->add(work_of_search(other.count));
    const std::uint32_t count = find_edges_within(other, place, radius, edges_.data());
    // Too close to an edge it cannot be told which side is inside.
    if (count == 0 || count > 2 || std::abs(vertex.reach) <= roundings_of_depth * rounding_) {
        return false;
    }
    const bool is_inside = vertex.reach > 0.0;
    const auto cut_off_side = [&](std::uint32_t edge) {
        const Vector start = other.start(edge);
        const Vector left = left_of(other.end(edge) - start);
        const bool is_left = left.dot(place - start) > 0.0;
        cut_off(vertex, square, is_left == is_inside ? Vector(-left) : left, start);
        return true;
    };
    if (count == 1) {
        return cut_off_side(edges_[0]);
    }
    // Two edges that share a corner: what is inside can be seen as two sides of lines where it
    // takes up more than a half of the plane around it.
    std::uint32_t before = edges_[0];
    std::uint32_t after = edges_[1];
    if (other.end(before) != other.start(after)) {
        std::swap(before, after);
    }
    const Vector corner = other.start(after);
    if (other.end(before) != corner) {
        return false;
    }
    Vector to_left = left_of(corner - other.start(before));
    Vector of_next = left_of(other.end(after) - corner);
    const double turn = to_left.dot(other.end(after) - corner);
    if (std::abs(turn) <= 0.25 * rounding_ && to_left.dot(of_next) > 0.0) {
        return cut_off_side(before);  // straight on
    }
    // Both to where the other edge is.
    if (turn < 0.0) {
        to_left = -to_left;
        of_next = -of_next;
    }
    const bool between = to_left.dot(place - corner) > 0.0 && of_next.dot(place - corner) > 0.0;
    if (between == is_inside) {
        return false;
    }
    cut_off(vertex, square, to_left, corner);
    cut_off(vertex, square, of_next, corner);
    return true;
}

bool ShiftCover::cut_off_walls(const ShiftSquare& square, double radius) {
    std::size_t others = 0;
    for (const Asked& asked : left_) {
        const Witness& witness = witnesses_[asked.witness];
        if (rest_.is_empty() || others > most_others) {
            return false;
        }
        const bool is_group = witness.parts > 0;
        if (is_group || (witness.is_vertex && !cut_off_wall(asked, square, radius))) {
            ++others;
        }
    }
    return others == 0;
}

bool ShiftCover::split_rest(const ShiftSquare& square, double radius) {
    std::size_t lines = 0;
    for (const Asked& asked : left_) {
        const Witness& witness = witnesses_[asked.witness];
        if (witness.radius > 0.0) {
            continue;
        }
        const PlacedEdges& other = is_of_a(asked.witness) ? *b_ : *a_;
        const Vector place = place_of(asked.witness, square.centre);
        work_->add(work_of_search(other.count));
        const std::uint32_t count = find_edges_within(other, place, radius, edges_.data());
        lines += count;
        if (!witness.is_vertex || lines > most_lines) {
            return false;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vector start = other.start(edges_[i]);
            const Vector along = other.end(edges_[i]) - start;
            if (along.squaredNorm() > 0.0) {
                const Vector way = is_of_a(asked.witness) ? left_of(along) : -left_of(along);
                split(way, way.dot(square.centre) + left_of(along).dot(start - place));
            }
        }
    }
    return true;
}

void ShiftCover::add_piece(const ConvexPiece& piece) {
    if (piece_count_ == pieces_.size()) {
        pieces_.emplace_back();
    }
    pieces_[piece_count_++] = piece;
}

void ShiftCover::split(const Vector& direction, double at) {
    const std::size_t count = piece_count_;
    for (std::size_t i = 0; i < count; ++i) {
        beyond_ = pieces_[i];
        beyond_.keep(direction, at);
        before_ = pieces_[i];
        before_.keep(-direction, -at);
        if (!beyond_.is_empty() && !before_.is_empty()) {
            pieces_[i] = beyond_;
            add_piece(before_);
        }
    }
}

ShiftWord ShiftCover::ask(const ShiftSquare& square) {
    const double radius = std::numbers::sqrt2 * square.half + roundings_of_depth * rounding_;
    const List list = lists_[square.list];
    left_.clear();
    rest_.begin(square.centre, square.half);
    for (std::size_t i = list.first; i < list.first + list.count; ++i) {
        const std::uint32_t witness = asked_[i].witness;
        const PlacedEdges& other = is_of_a(witness) ? *b_ : *a_;
        work_->add(2 * work_of_search(other.count));
        const Witness& asked = witnesses_[witness];
        const double reach =
            asked.radius - asked.spread + depth_in(other, place_of(witness, square.centre));
        if (reach >= radius) {
            return ShiftWord::meet;
        }
        if (reach + 2.0 * asked.spread > -radius) {
            left_.push_back({witness, reach});
        }
    }
    // Who said most mostly says most of the parts as well.
    std::sort(left_.begin(), left_.end(),
              [](const Asked& i, const Asked& j) { return i.reach > j.reach; });
    const bool is_alike = cut_off_walls(square, radius);
    if (rest_.is_empty()) {
        return ShiftWord::meet;
    }
    piece_count_ = 0;
    add_piece(rest_);
    if (is_alike) {
        return ShiftWord::alike;
    }
    if (split_rest(square, radius)) {
        return ShiftWord::alike;
    }
    return !left_.empty() && left_.front().reach > roundings_of_depth * rounding_
               ? ShiftWord::touched
               : ShiftWord::nothing;
}

void ShiftCover::list_parts(const Asked& asked, double half) {
    const Witness& witness = witnesses_[asked.witness];
    const bool is_narrow = witness.spread > 0.0 && witness.spread <= most_spread * half;
    if (witness.parts == 0 || is_narrow) {
        asked_.push_back(asked);
        return;
    }
    for (std::uint32_t part = witness.first; part < witness.first + witness.parts; ++part) {
        list_parts({part, 0.0}, half);
    }
}

void ShiftCover::cut(const ShiftSquare& square) {
    const auto list = static_cast<std::uint32_t>(lists_.size());
    lists_.push_back({asked_.size(), 0});
    for (const Asked& asked : left_) {
        list_parts(asked, square.half);
    }
    lists_.back().count = asked_.size() - lists_.back().first;
    const double nearest = std::max(square.nearest, rest_.nearest().norm());
    const double half = 0.5 * square.half;
    for (const double x : {-half, half}) {
        for (const double y : {-half, half}) {
            const Vector centre = square.centre + Vector(x, y);
            push({centre, half, std::max(nearest, distance_of(centre, half)), list});
        }
    }
}

}  // namespace nearfield::exact
