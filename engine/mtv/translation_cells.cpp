#include <engine/mtv/translation_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// Certificates clip the cell in order of decreasing depth, until this many could not clip.
constexpr std::size_t max_others = 16;

// Depths are off by less than this many roundings.
constexpr double roundings_of_depth = 4.0;

// Maximum number of lines that split the rest of a cell; if there are more, it is split into four.
constexpr std::size_t max_lines = 6;

// Groups of vertices with a larger spread, in half sides of a cell, are replaced by their parts.
constexpr double max_spread = 0.25;

bool is_farther(const TranslationCell& i, const TranslationCell& j) {
    return i.nearest > j.nearest;
}

/// The distance of a square from 0.
double distance_of(const Vector& centre, double half) {
    return (centre.cwiseAbs().array() - half).matrix().cwiseMax(0.0).norm();
}

/// The unit vector to the left of a direction.
Vector left_of(const Vector& along) {
    return Vector(-along.y(), along.x()).normalized();
}

/// Lists the edges at most `distance` from a point, and perhaps a few more.
std::uint32_t find_edges_within(const simd::TransformedEdges& edges, const Vector& point,
                                double distance, std::uint32_t* found) {
    const double squared = distance * distance;
    return is_small(edges)
               ? simd::kernels::find_edges_within(edges, point.x(), point.y(), squared, found)
               : simd::kernels::find_edges_within(edges.tree(), point.x(), point.y(), squared,
                                                  found);
}

}  // namespace

void TranslationSearch::begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                              double longest, double rounding, WorkBudget& work) {
    a_ = &a;
    b_ = &b;
    work_ = &work;
    rounding_ = rounding;
    edges_.resize(std::max(edges_.size(), simd::padded(std::max(a.count, b.count))));
    certificates_.clear();
    top_.clear();
    add_certificates(a, work, certificates_, top_);
    of_a_ = static_cast<std::uint32_t>(certificates_.size());
    add_certificates(b, work, certificates_, top_);
    asked_.clear();
    for (const std::uint32_t certificate : top_) {
        asked_.push_back({certificate, 0.0});
    }
    lists_.assign(1, {0, asked_.size()});
    squares_.clear();
    push({Vector::Zero(), longest, 0.0, 0});
}

void TranslationSearch::push(const TranslationCell& square) {
    squares_.push_back(square);
    std::push_heap(squares_.begin(), squares_.end(), is_farther);
}

TranslationCell TranslationSearch::take_nearest() {
    std::pop_heap(squares_.begin(), squares_.end(), is_farther);
    TranslationCell square = squares_.back();
    squares_.pop_back();
    return square;
}

Vector TranslationSearch::place_of(std::uint32_t certificate, const Vector& shift) const {
    const Vector& centre = certificates_[certificate].centre;
    return is_of_a(certificate) ? Vector(centre + shift) : Vector(centre - shift);
}

void TranslationSearch::cut_off(const Asked& vertex, const TranslationCell& square,
                                const Vector& outwards, const Vector& start) {
    const Vector place = place_of(vertex.certificate, square.centre);
    // Moving A moves a vertex of A with it, and a vertex of B the opposite way relative to A.
    const Vector way = is_of_a(vertex.certificate) ? outwards : Vector(-outwards);
    // A vertex outside by at most a fraction of the rounding still counts as touching.
    rest_.keep(way, way.dot(square.centre) + outwards.dot(start - place) + 0.5 * rounding_);
}

bool TranslationSearch::cut_off_wall(const Asked& vertex, const TranslationCell& square,
                                     double radius) {
    const simd::TransformedEdges& other = is_of_a(vertex.certificate) ? *b_ : *a_;
    const Vector place = place_of(vertex.certificate, square.centre);
    work_->add(work_of_search(other.count));
    const std::uint32_t count = find_edges_within(other, place, radius, edges_.data());
    // Too close to an edge, the inside cannot be distinguished from the outside.
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
    // Two edges with a common corner: the inside is the union of two half planes if it takes up
    // more than half of the plane around the corner.
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
        return cut_off_side(before);  // collinear
    }
    // Orient both normals towards the other edge.
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

bool TranslationSearch::cut_off_walls(const TranslationCell& square, double radius) {
    std::size_t others = 0;
    for (const Asked& asked : left_) {
        const OverlapCertificate& certificate = certificates_[asked.certificate];
        if (rest_.is_empty() || others > max_others) {
            return false;
        }
        const bool is_group = certificate.parts > 0;
        if (is_group || (certificate.is_vertex && !cut_off_wall(asked, square, radius))) {
            ++others;
        }
    }
    return others == 0;
}

bool TranslationSearch::split_rest(const TranslationCell& square, double radius) {
    std::size_t lines = 0;
    for (const Asked& asked : left_) {
        const OverlapCertificate& certificate = certificates_[asked.certificate];
        if (certificate.radius > 0.0) {
            continue;
        }
        const simd::TransformedEdges& other = is_of_a(asked.certificate) ? *b_ : *a_;
        const Vector place = place_of(asked.certificate, square.centre);
        work_->add(work_of_search(other.count));
        const std::uint32_t count = find_edges_within(other, place, radius, edges_.data());
        lines += count;
        if (!certificate.is_vertex || lines > max_lines) {
            return false;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vector start = other.start(edges_[i]);
            const Vector along = other.end(edges_[i]) - start;
            if (along.squaredNorm() > 0.0) {
                const Vector way = is_of_a(asked.certificate) ? left_of(along) : -left_of(along);
                split(way, way.dot(square.centre) + left_of(along).dot(start - place));
            }
        }
    }
    return true;
}

void TranslationSearch::add_piece(const ConvexPiece& piece) {
    if (piece_count_ == pieces_.size()) {
        pieces_.emplace_back();
    }
    pieces_[piece_count_++] = piece;
}

void TranslationSearch::split(const Vector& direction, double at) {
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

CellState TranslationSearch::ask(const TranslationCell& square) {
    const double radius = std::numbers::sqrt2 * square.half + roundings_of_depth * rounding_;
    const List list = lists_[square.list];
    left_.clear();
    rest_.begin(square.centre, square.half);
    for (std::size_t i = list.first; i < list.first + list.count; ++i) {
        const std::uint32_t certificate = asked_[i].certificate;
        const simd::TransformedEdges& other = is_of_a(certificate) ? *b_ : *a_;
        work_->add(2 * work_of_search(other.count));
        const OverlapCertificate& asked = certificates_[certificate];
        const double reach =
            asked.radius - asked.spread + depth_in(other, place_of(certificate, square.centre));
        if (reach >= radius) {
            return CellState::overlapping;
        }
        if (reach + 2.0 * asked.spread > -radius) {
            left_.push_back({certificate, reach});
        }
    }
    // The deepest certificates usually decide the parts as well.
    std::sort(left_.begin(), left_.end(),
              [](const Asked& i, const Asked& j) { return i.reach > j.reach; });
    const bool is_uniform = cut_off_walls(square, radius);
    if (rest_.is_empty()) {
        return CellState::overlapping;
    }
    piece_count_ = 0;
    add_piece(rest_);
    if (is_uniform) {
        return CellState::uniform;
    }
    if (split_rest(square, radius)) {
        return CellState::uniform;
    }
    return !left_.empty() && left_.front().reach > roundings_of_depth * rounding_
               ? CellState::touching
               : CellState::unknown;
}

void TranslationSearch::list_parts(const Asked& asked, double half) {
    const OverlapCertificate& certificate = certificates_[asked.certificate];
    const bool is_narrow = certificate.spread > 0.0 && certificate.spread <= max_spread * half;
    if (certificate.parts == 0 || is_narrow) {
        asked_.push_back(asked);
        return;
    }
    for (std::uint32_t part = certificate.first; part < certificate.first + certificate.parts;
         ++part) {
        list_parts({part, 0.0}, half);
    }
}

void TranslationSearch::cut(const TranslationCell& square) {
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

}  // namespace nearfield::mtv
