#include <engine/geometry/segment.hpp>
#include <engine/mtv/translation_cells.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// Walls are looked for until so many groups of vertices, or the vertices of so many lines, could
// not be cut off.
constexpr std::size_t max_undecided = 10;
constexpr std::size_t max_listed = 16;

// Groups with a larger spread, in half sides of a cell, are replaced by their parts.
constexpr double max_spread = 0.5;

// Maximum number of lines that split the rest of a cell; if there are more, it is cut.
constexpr std::size_t max_lines = 6;

}  // namespace

std::uint32_t TranslationSearch::find_edges_in(std::uint32_t certificate, const Vector& centre,
                                               const Vector& half) {
    const simd::TransformedEdges& other = other_of(certificate);
    const geometry::Box box(centre - half, centre + half);
    if (!other.box.intersects(box)) {
        return 0;
    }
    work_->add(work_of_search(other.count));
    std::uint32_t* const found = edges_.data();
    std::uint32_t count = 0;
    if (is_small(other)) {
        const simd::EdgeSubset& in_reach = is_of_a(certificate) ? in_reach_of_a_ : in_reach_of_b_;
        if (in_reach.empty()) {
            return 0;
        }
        count = simd::kernels::find_edges_in(in_reach.edges(), geometry::extent_of(box), found);
        std::transform(found, found + count, found,
                       [&](std::uint32_t edge) { return in_reach.index(edge); });
    } else {
        count = simd::kernels::find_edges_in(other.tree(), geometry::extent_of(box), found);
    }
    // So far their boxes do.
    return static_cast<std::uint32_t>(
        std::remove_if(found, found + count,
                       [&](std::uint32_t edge) {
                           const Vector start = other.start(edge);
                           const Vector along = other.end(edge) - start;
                           return std::abs(geometry::cross(along, centre - start)) >
                                  std::abs(along.x()) * half.y() + std::abs(along.y()) * half.x();
                       }) -
        found);
}

TranslationSearch::Focus TranslationSearch::focus_of_rest() const {
    const geometry::Box box = rest_.box();
    return {box.center(), 0.5 * box.diagonal().array() + roundings_of_depth * rounding_};
}

void TranslationSearch::cut_off(const Asked& vertex, const Focus& focus, const Vector& outwards,
                                const Vector& start) {
    const Vector place = place_of(vertex.certificate, focus.centre);
    // Moving A moves a vertex of A with it, and a vertex of B the opposite way relative to A.
    const Vector way = is_of_a(vertex.certificate) ? outwards : Vector(-outwards);
    // A vertex outside by at most a fraction of the rounding still counts as touching.
    rest_.keep(way, way.dot(focus.centre) + outwards.dot(start - place) + 0.5 * rounding_);
}

bool TranslationSearch::is_inside(const Asked& vertex, const TranslationCell& cell,
                                  const Vector& shift) {
    const double moved = vertex.moved + (shift - cell.centre).norm();
    if (moved + roundings_of_depth * rounding_ < std::abs(vertex.depth)) {
        return vertex.depth > 0.0;
    }
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector place = place_of(vertex.certificate, shift);
    if (!other.box.contains(place)) {
        return false;
    }
    work_->add(work_of_search(other.count));
    return contains(other, place);
}

void TranslationSearch::add_lines(const Asked& vertex, const Focus& focus, std::uint32_t count) {
    const OverlapCertificate& certificate = certificates_[vertex.certificate];
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector place = place_of(vertex.certificate, focus.centre);
    const double sign = is_of_a(vertex.certificate) ? 1.0 : -1.0;
    const double radius = focus.half.norm();
    const double beside = roundings_of_depth * rounding_;
    for (std::uint32_t i = 0; i < count && lines_.size() <= max_listed; ++i) {
        const Vector start = other.start(edges_[i]);
        const Vector& left = normal_of(vertex.certificate, edges_[i]);
        if (left.isZero(0.0)) {
            continue;
        }
        const double before = left.dot(certificate.before);
        const double after = left.dot(certificate.after);
        if (std::min(before, after) < -beside && std::max(before, after) > beside) {
            continue;  // the boundaries cross on both sides of the line
        }
        const Vector normal = sign * left;
        const double offset = left.dot(start - place);  // of the line from the focus
        // Lines that differ by less than the rim of a core count once.
        const bool is_new = std::none_of(lines_.begin(), lines_.end(), [&](const Line& line) {
            const double way = line.at - line.normal.dot(focus.centre);
            const double same = line.normal.dot(normal) < 0.0 ? -offset : offset;
            return std::abs(way - same) + std::abs(geometry::cross(line.normal, normal)) * radius <=
                   rounding_;
        });
        if (is_new) {
            lines_.push_back({normal, normal.dot(focus.centre) + offset});
            normals_ += normal.cwiseAbs();
        }
    }
}

void TranslationSearch::cut_off_side(const Asked& vertex, const Focus& focus, bool inside,
                                     std::uint32_t edge) {
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector start = other.start(edge);
    const Vector& left = normal_of(vertex.certificate, edge);
    const bool is_left = left.dot(place_of(vertex.certificate, focus.centre) - start) > 0.0;
    cut_off(vertex, focus, is_left == inside ? Vector(-left) : left, start);
}

TranslationSearch::Wall TranslationSearch::cut_off_corner(const Asked& vertex, const Focus& focus,
                                                          bool inside) {
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector place = place_of(vertex.certificate, focus.centre);
    // Two edges with a common corner: the inside is the union of two half planes if it takes up
    // more than half of the plane around the corner.
    std::uint32_t before = edges_[0];
    std::uint32_t after = edges_[1];
    if (other.end(before) != other.start(after)) {
        std::swap(before, after);
    }
    const Vector corner = other.start(after);
    if (other.end(before) != corner) {
        return Wall::undecided;
    }
    Vector to_left = normal_of(vertex.certificate, before);
    Vector of_next = normal_of(vertex.certificate, after);
    const double turn = to_left.dot(other.end(after) - corner);
    if (std::abs(turn) <= 0.25 * rounding_ && to_left.dot(of_next) > 0.0) {
        cut_off_side(vertex, focus, inside, before);  // collinear
        return Wall::cut;
    }
    // Orient both normals towards the other edge.
    if (turn < 0.0) {
        to_left = -to_left;
        of_next = -of_next;
    }
    const bool between = to_left.dot(place - corner) > 0.0 && of_next.dot(place - corner) > 0.0;
    if (between == inside) {
        return Wall::undecided;
    }
    cut_off(vertex, focus, to_left, corner);
    cut_off(vertex, focus, of_next, corner);
    return Wall::cut;
}

TranslationSearch::Wall TranslationSearch::cut_off_wall(const Asked& vertex,
                                                        const TranslationCell& cell,
                                                        const Focus& focus) {
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector place = place_of(vertex.certificate, focus.centre);
    const std::uint32_t count = find_edges_in(vertex.certificate, place, focus.half);
    if (count > 2) {
        add_lines(vertex, focus, count);
        return Wall::undecided;
    }
    const bool inside = is_inside(vertex, cell, focus.centre);
    if (count == 0) {
        return inside ? Wall::all : Wall::none;
    }
    // Too close to an edge, the inside cannot be distinguished from the outside.
    for (std::uint32_t i = 0; i < count; ++i) {
        const double least = roundings_of_depth * rounding_;
        if (geometry::nearest_on_segment(place, other.start(edges_[i]), other.end(edges_[i]))
                .squared_distance <= least * least) {
            add_lines(vertex, focus, count);
            return Wall::undecided;
        }
    }
    if (count == 1) {
        cut_off_side(vertex, focus, inside, edges_[0]);
        return Wall::cut;
    }
    const Wall wall = cut_off_corner(vertex, focus, inside);
    if (wall == Wall::undecided) {
        add_lines(vertex, focus, count);
    }
    return wall;
}

TranslationSearch::Wall TranslationSearch::expand(std::uint32_t index, const TranslationCell& cell,
                                                  const Focus& focus) {
    const Asked asked = left_[index];
    const double spread = certificates_[asked.certificate].spread;
    if (find_edges_in(asked.certificate, place_of(asked.certificate, focus.centre),
                      focus.half.array() + spread) > 0) {
        if (spread <= max_spread * focus.half.minCoeff()) {
            return Wall::undecided;
        }
        append_parts(asked, left_);
        left_[index].certificate = dropped;
        return Wall::cut;
    }
    return is_inside(asked, cell, focus.centre) ? Wall::all : Wall::none;
}

bool TranslationSearch::cut_off_walls(const TranslationCell& cell) {
    undecided_.clear();
    lines_.clear();
    normals_.setZero();
    Focus focus = focus_of_rest();
    bool is_whole = true;
    has_cut_ = false;
    for (std::uint32_t i = 0; i < left_.size(); ++i) {
        const OverlapCertificate& certificate = certificates_[left_[i].certificate];
        if (certificate.is_disc) {
            continue;
        }
        const bool is_group = certificate.parts > 0;
        const Wall wall = is_group ? expand(i, cell, focus) : cut_off_wall(left_[i], cell, focus);
        if (wall == Wall::all) {
            rest_.clear();
            return true;
        }
        if (wall == Wall::none && is_whole) {
            left_[i].certificate = dropped;
        } else if (wall == Wall::undecided) {
            if (is_group) {
                undecided_.push_back(i);
            }
            if (undecided_.size() > max_undecided || lines_.size() > max_listed) {
                return false;
            }
        } else if (wall == Wall::cut && !is_group) {
            if (rest_.is_empty()) {
                return true;
            }
            focus = focus_of_rest();
            is_whole = false;
            has_cut_ = true;
        }
    }
    return true;
}

bool TranslationSearch::split_rest() {
    const Focus focus = focus_of_rest();
    for (const std::uint32_t i : undecided_) {
        const std::uint32_t group = left_[i].certificate;
        if (find_edges_in(group, place_of(group, focus.centre),
                          focus.half.array() + certificates_[group].spread) > 0) {
            return false;
        }
    }
    std::size_t splits = 0;
    for (const Line& line : lines_) {
        splits += split(line.normal, line.at) ? 1U : 0U;
        if (splits > max_lines) {
            return false;
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

bool TranslationSearch::split(const Vector& direction, double at) {
    const std::size_t count = piece_count_;
    bool splits = false;
    for (std::size_t i = 0; i < count; ++i) {
        beyond_.keep_of(pieces_[i], direction, at);
        before_.keep_of(pieces_[i], -direction, -at);
        if (!beyond_.is_empty()) {
            pieces_[i].swap(beyond_);
            if (!before_.is_empty()) {
                add_piece(before_);
                splits = true;
            }
        } else if (!before_.is_empty()) {
            pieces_[i].swap(before_);
        }
    }
    return splits;
}

}  // namespace nearfield::mtv
