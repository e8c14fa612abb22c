#include <engine/geometry/segment.hpp>
#include <engine/mtv/translation_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::mtv {
namespace {

using geometry::Vector;

// At most this many certificates are asked whether they decide a cell, then its walls.
constexpr std::size_t max_asked = 4;

// So many of the certificates are sorted.
constexpr std::size_t max_sorted = 64;

// Marks an entry without meaning.
constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();

// Walls are looked for until so many vertices could not be cut off.
constexpr std::size_t max_undecided = 10;

// Depths are off by less than this many roundings.
constexpr double roundings_of_depth = 4.0;

// Maximum number of lines that split the rest of a cell; if there are more, it is cut.
constexpr std::size_t max_lines = 6;

// Groups with a larger spread, in half sides of a cell, are replaced by their parts.
constexpr double max_spread = 0.5;

// A rest that fills no more than this part of its cell is not cut.
constexpr double small_rest = 0.35;

// A cell this many times longer than wide, weighted by the walls it has, is cut in two, others in
// four.
constexpr double long_cell = 2.0;

// Crossings that reach less than this part of the first cell are not worth asking for.
constexpr double least_crossing = 0.005;

// So many edges near each of so many vertices decide in which direction a cell is cut.
constexpr std::uint32_t max_normals = 24;
constexpr std::uint32_t max_vertices_of_normals = 4;

// Lines whose angle has a smaller sine are parallel.
constexpr double parallel = 1e-6;

// No direction weighs less than this part of both.
constexpr double least_normal = 0.02;

// Cells overlap by so many margins.
constexpr double overlap = 2.0;

bool is_farther(const TranslationCell& i, const TranslationCell& j) {
    return i.nearest > j.nearest;
}

/// The distance of a rectangle from 0.
double distance_of(const Vector& centre, const Vector& half) {
    return (centre.cwiseAbs() - half).cwiseMax(0.0).norm();
}

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

void TranslationSearch::begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                              double longest, double rounding, double margin, WorkBudget& work) {
    a_ = &a;
    b_ = &b;
    work_ = &work;
    rounding_ = rounding;
    margin_ = margin;
    edges_.resize(std::max(edges_.size(), simd::padded(std::max(a.count, b.count))));
    certificates_.clear();
    top_.clear();
    add_certificates(a, work, certificates_, top_);
    of_a_ = static_cast<std::uint32_t>(certificates_.size());
    add_certificates(b, work, certificates_, top_);
    crossing_finder_.find(a, b, least_crossing * longest, work, crossings_);
    asked_.clear();
    for (const std::uint32_t certificate : top_) {
        asked_.push_back({certificate, 0, 0.0, std::numeric_limits<double>::infinity(),
                          certificates_[certificate].most});
    }
    crossings_asked_.clear();
    for (std::uint32_t i = 0; i < crossings_.size(); ++i) {
        crossings_asked_.push_back(i);
    }
    lists_.assign(1,
                  {0, asked_.size(), 0, crossings_.size(), Vector::Zero(), true, Vector::Zero()});
    cells_.clear();
    push({Vector::Zero(), Vector(longest, longest), 0.0, 0});
}

void TranslationSearch::push(const TranslationCell& cell) {
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end(), is_farther);
}

TranslationCell TranslationSearch::take_nearest() {
    std::pop_heap(cells_.begin(), cells_.end(), is_farther);
    TranslationCell cell = cells_.back();
    cells_.pop_back();
    return cell;
}

Vector TranslationSearch::place_of(std::uint32_t certificate, const Vector& shift) const {
    const Vector& centre = certificates_[certificate].centre;
    return is_of_a(certificate) ? Vector(centre + shift) : Vector(centre - shift);
}

void TranslationSearch::ask_depth(Asked& asked, const Vector& shift) {
    const simd::TransformedEdges& other = other_of(asked.certificate);
    const Vector place = place_of(asked.certificate, shift);
    simd::NearEdge nearest;
    if (is_small(other)) {
        nearest = simd::kernels::find_nearest(other, place.x(), place.y());
    } else {
        const double guess =
            geometry::nearest_on_segment(place, other.start(asked.edge), other.end(asked.edge))
                .squared_distance;
        nearest =
            simd::kernels::find_nearer(other.tree(), place.x(), place.y(), {asked.edge, guess});
    }
    work_->add(work_of_search(other.count));
    // The side stays the same on a way shorter than the distance.
    bool is_inside = asked.depth > 0.0;
    if (asked.moved + roundings_of_depth * rounding_ >= std::abs(asked.depth)) {
        is_inside = contains(other, place);
        work_->add(work_of_search(other.count));
    }
    const double distance = std::sqrt(nearest.squared);
    asked.edge = nearest.edge;
    asked.depth = is_inside ? distance : -distance;
    asked.moved = 0.0;
}

void TranslationSearch::append_parts(const Asked& asked, std::vector<Asked>& parts) const {
    const OverlapCertificate& group = certificates_[asked.certificate];
    for (std::uint32_t part = group.first; part < group.first + group.parts; ++part) {
        const double way = (certificates_[part].centre - group.centre).norm();
        parts.push_back(
            {part, asked.edge, asked.depth, asked.moved + way, certificates_[part].most});
    }
}

bool TranslationSearch::cross_throughout(const TranslationCell& cell, const Vector& half) {
    const List list = lists_[cell.list];
    crossings_left_.clear();
    work_->add(list.crossings);
    for (std::size_t i = list.first_crossing; i < list.first_crossing + list.crossings; ++i) {
        const CrossingCertificate::Reach reach =
            crossings_[crossings_asked_[i]].reach(cell.centre, half);
        if (reach.least >= roundings_of_depth * rounding_) {
            return true;
        }
        if (reach.most > 0.0) {
            crossings_left_.push_back(crossings_asked_[i]);
        }
    }
    return false;
}

bool TranslationSearch::overlap_throughout(const TranslationCell& cell, double radius) {
    const List list = lists_[cell.list];
    const double moved = (cell.centre - list.centre).norm();
    left_.assign(asked_.begin() + static_cast<std::ptrdiff_t>(list.first),
                 asked_.begin() + static_cast<std::ptrdiff_t>(list.first + list.count));
    work_->add(list.count / 4);
    for (Asked& asked : left_) {
        asked.moved += moved;
    }
    std::size_t kept = 0;
    std::size_t tries = 0;
    for (std::size_t i = 0; i < left_.size(); ++i) {
        Asked asked = left_[i];
        if (asked.bound() >= radius && tries < max_asked) {
            ++tries;
            ask_depth(asked, cell.centre);
            const OverlapCertificate& certificate = certificates_[asked.certificate];
            if (certificate.least + asked.depth >= radius) {
                return true;
            }
            if (certificate.parts > 0 && asked.bound() >= radius) {
                append_parts(asked, left_);
                continue;
            }
        }
        if (asked.bound() + radius >= 0.0) {
            left_[kept++] = asked;
        }
    }
    left_.resize(kept);
    return false;
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
    const auto cut_off_side = [&](std::uint32_t edge) {
        const Vector start = other.start(edge);
        const Vector left = left_of(other.end(edge) - start);
        const bool is_left = left.dot(place - start) > 0.0;
        cut_off(vertex, focus, is_left == inside ? Vector(-left) : left, start);
        return Wall::cut;
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
        return Wall::undecided;
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
    if (between == inside) {
        return Wall::undecided;
    }
    cut_off(vertex, focus, to_left, corner);
    cut_off(vertex, focus, of_next, corner);
    return Wall::cut;
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

CellState TranslationSearch::ask(const TranslationCell& cell) {
    const Vector half = cell.half.array() + overlap * margin_;
    const double radius = half.norm() + roundings_of_depth * rounding_;
    // A cell within the margin holds nothing that its neighbours do not hold.
    if (half.maxCoeff() <= (overlap + 1.0) * margin_ || cross_throughout(cell, half) ||
        overlap_throughout(cell, radius)) {
        return CellState::overlapping;
    }
    rest_.begin(cell.centre, half, margin_);
    // What is in vain for a cell is so for its parts, mostly.
    has_walls_ = !lists_[cell.list].has_walls;
    if (!has_walls_) {
        normals_ = lists_[cell.list].normals;
    }
    if (has_walls_) {
        // The deepest certificates usually decide the parts as well.
        const auto first = left_.begin();
        std::partial_sort(
            first, first + static_cast<std::ptrdiff_t>(std::min(left_.size(), max_sorted)),
            left_.end(), [](const Asked& i, const Asked& j) { return i.bound() > j.bound(); });
        const bool are_few = cut_off_walls(cell);
        if (rest_.is_empty()) {
            return CellState::overlapping;
        }
        piece_count_ = 0;
        add_piece(rest_);
        if (are_few && split_rest()) {
            return CellState::uniform;
        }
        has_walls_ = !has_cut_ && !are_few;
    }
    for (const Asked& asked : left_) {
        if (asked.certificate != dropped &&
            certificates_[asked.certificate].least + asked.depth - asked.moved >
                roundings_of_depth * rounding_) {
            return CellState::touching;
        }
    }
    return CellState::unknown;
}

void TranslationSearch::cut(const TranslationCell& cell) {
    const auto list = static_cast<std::uint32_t>(lists_.size());
    lists_.push_back({asked_.size(), 0, crossings_asked_.size(), crossings_left_.size(),
                      cell.centre, has_walls_, normals_});
    const geometry::Box box = rest_.box();
    const Vector centre = box.center();
    Vector half = (0.5 * box.diagonal().array() - overlap * margin_).max(0.0);
    for (const Asked& asked : left_) {
        if (asked.certificate != dropped) {
            asked_.push_back(asked);
        }
    }
    lists_.back().count = asked_.size() - lists_.back().first;
    crossings_asked_.insert(crossings_asked_.end(), crossings_left_.begin(), crossings_left_.end());
    const double nearest = std::max(cell.nearest, rest_.nearest().norm());
    if (half.prod() <= small_rest * cell.half.prod()) {
        push({centre, half, nearest, list});
        return;
    }
    // Where all walls in reach are parallel, cuts across them are of no use.
    const Vector weight =
        half.cwiseProduct(normals_.cwiseMax(least_normal * normals_.sum()) + Vector(1e-9, 1e-9));
    const bool is_wide = weight.y() * long_cell < weight.x();
    const bool is_high = weight.x() * long_cell < weight.y();
    const Vector step(is_high ? 0.0 : 0.5 * half.x(), is_wide ? 0.0 : 0.5 * half.y());
    half = Vector(is_high ? half.x() : step.x(), is_wide ? half.y() : step.y());
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            if ((is_high && x < 0.0) || (is_wide && y < 0.0)) {
                continue;
            }
            const Vector part = centre + Vector(x * step.x(), y * step.y());
            push({part, half,
                  std::max(nearest, distance_of(part, half.array() + overlap * margin_)), list});
        }
    }
}

}  // namespace nearfield::mtv
