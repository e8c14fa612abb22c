#include <engine/geometry/segment.hpp>
#include <engine/mtv/translation_cells.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// Walls are looked for until so many vertices could not be cut off.
constexpr std::size_t max_undecided = 10;

// Maximum number of lines that split the rest of a cell; if there are more, it is cut.
constexpr std::size_t max_lines = 6;

// Groups with a larger spread, in half sides of a cell, are replaced by their parts.
constexpr double max_spread = 0.5;

// So many edges near each of so many vertices decide in which direction a cell is cut.
constexpr std::uint32_t max_normals = 24;
constexpr std::uint32_t max_vertices_of_normals = 4;

// Lines whose angle has a smaller sine are parallel.
constexpr double parallel = 1e-6;

/// The unit vector to the left of a direction.
Vector left_of(const Vector& along) {
    return Vector(-along.y(), along.x()).normalized();
}

/// Lists the edges that intersect a rectangle.
std::uint32_t find_edges_in(const simd::TransformedEdges& edges, const Vector& centre,
                            const Vector& half, std::uint32_t* found) {
    const simd::Extent box{centre.x() - half.x(), centre.y() - half.y(), centre.x() + half.x(),
                           centre.y() + half.y()};
    const std::uint32_t count = is_small(edges)
                                    ? simd::kernels::find_edges_in(edges, box, found)
                                    : simd::kernels::find_edges_in(edges.tree(), box, found);
    // So far their boxes do.
    return static_cast<std::uint32_t>(
        std::remove_if(found, found + count,
                       [&](std::uint32_t edge) {
                           const Vector start = edges.start(edge);
                           const Vector along = edges.end(edge) - start;
                           return std::abs(geometry::cross(along, centre - start)) >
                                  std::abs(along.x()) * half.y() + std::abs(along.y()) * half.x();
                       }) -
        found);
}

}  // namespace

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
    work_->add(work_of_search(other.count));
    return contains(other, place_of(vertex.certificate, shift));
}

void TranslationSearch::add_normals(const simd::TransformedEdges& edges, std::uint32_t count) {
    if (has_normals_ == max_vertices_of_normals) {
        return;
    }
    ++has_normals_;
    lines_.clear();
    for (std::uint32_t i = 0; i < std::min(count, max_normals); ++i) {
        const Vector start = edges.start(edges_[i]);
        const Vector normal = left_of(edges.end(edges_[i]) - start);
        // Several edges on one line count once: a cut along it is good for all.
        const bool is_new = std::none_of(lines_.begin(), lines_.end(), [&](const Line& line) {
            return std::abs(geometry::cross(line.normal, normal)) <= parallel &&
                   std::abs(line.normal.dot(start - line.start)) <= rounding_;
        });
        if (is_new) {
            lines_.push_back({start, normal});
            normals_ += normal.cwiseAbs();
        }
    }
}

void TranslationSearch::cut_off_side(const Asked& vertex, const Focus& focus, bool inside,
                                     std::uint32_t edge) {
    const simd::TransformedEdges& other = other_of(vertex.certificate);
    const Vector start = other.start(edge);
    const Vector left = left_of(other.end(edge) - start);
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
    Vector to_left = left_of(corner - other.start(before));
    Vector of_next = left_of(other.end(after) - corner);
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
    work_->add(work_of_search(other.count));
    const std::uint32_t count = find_edges_in(other, place, focus.half, edges_.data());
    if (count > 2) {
        add_normals(other, count);
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
            return Wall::undecided;
        }
    }
    if (count == 1) {
        cut_off_side(vertex, focus, inside, edges_[0]);
        return Wall::cut;
    }
    return cut_off_corner(vertex, focus, inside);
}

TranslationSearch::Wall TranslationSearch::expand(std::uint32_t index, const TranslationCell& cell,
                                                  const Focus& focus) {
    const Asked asked = left_[index];
    const double spread = certificates_[asked.certificate].spread;
    const simd::TransformedEdges& other = other_of(asked.certificate);
    work_->add(work_of_search(other.count));
    if (find_edges_in(other, place_of(asked.certificate, focus.centre), focus.half.array() + spread,
                      edges_.data()) > 0) {
        if (spread <= max_spread * focus.half.maxCoeff()) {
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
    normals_.setZero();
    has_normals_ = 0;
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
            undecided_.push_back(i);
            if (undecided_.size() > max_undecided) {
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
    std::size_t lines = 0;
    for (const std::uint32_t i : undecided_) {
        const std::uint32_t vertex = left_[i].certificate;
        const OverlapCertificate& certificate = certificates_[vertex];
        const simd::TransformedEdges& other = other_of(vertex);
        const Vector place = place_of(vertex, focus.centre);
        work_->add(work_of_search(other.count));
        const std::uint32_t count =
            find_edges_in(other, place, focus.half.array() + certificate.spread, edges_.data());
        if (certificate.parts > 0 && count > 0) {
            return false;
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vector start = other.start(edges_[k]);
            const Vector along = other.end(edges_[k]) - start;
            if (along.squaredNorm() > 0.0) {
                const Vector left = left_of(along);
                const Vector way = is_of_a(vertex) ? left : Vector(-left);
                lines += split(way, way.dot(focus.centre) + left.dot(start - place)) ? 1U : 0U;
                if (lines > max_lines) {
                    return false;
                }
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
