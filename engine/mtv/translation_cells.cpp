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

// A rest that fills no more than this part of its cell is not cut.
constexpr double small_rest = 0.35;

// A cell this many times longer than wide, weighted by the walls it has, is cut in two, others in
// four.
constexpr double long_cell = 2.0;

// Crossings that reach less than this part of the first cell are not worth asking for.
constexpr double least_crossing = 0.03;

// No direction weighs less than this part of both.
constexpr double least_normal = 0.02;

// Cells overlap by so many margins: by more than one, so that nothing is in the rim of both; by
// less than two, less the rounding of lines, so that what lies between a line and a border on it
// has no core.
constexpr double overlap = 1.25;

bool is_farther(const TranslationCell& i, const TranslationCell& j) {
    return i.nearest > j.nearest;
}

/// The unit vectors to the left of all edges.
void find_normals(const simd::TransformedEdges& edges, std::vector<Vector>& normals) {
    normals.clear();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector along = edges.end(i) - edges.start(i);
        normals.push_back(Vector(-along.y(), along.x()).normalized());
    }
}

/// The distance of a rectangle from 0.
double distance_of(const Vector& centre, const Vector& half) {
    return (centre.cwiseAbs() - half).cwiseMax(0.0).norm();
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
    const double reach = longest + 4.0 * margin;
    add_certificates(a, geometry::grown(b.box, reach), work, certificates_, top_);
    of_a_ = static_cast<std::uint32_t>(certificates_.size());
    add_certificates(b, geometry::grown(a.box, reach), work, certificates_, top_);
    crossing_finder_.find(a, b, longest, least_crossing * longest, work, crossings_);
    if (is_small(a)) {
        in_reach_of_b_.pick(a, geometry::extent_of(geometry::grown(b.box, reach)));
    }
    if (is_small(b)) {
        in_reach_of_a_.pick(b, geometry::extent_of(geometry::grown(a.box, reach)));
    }
    find_normals(a, normals_a_);
    find_normals(b, normals_b_);
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
        is_inside = other.box.contains(place) && contains(other, place);
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
    std::size_t next = 0;
    while (next < left_.size()) {  // parts of groups are appended
        Asked asked = left_[next++];
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

bool TranslationSearch::overlaps(const TranslationCell& cell) {
    const Vector half = cell.half.array() + overlap * margin_;
    const double radius = half.norm() + roundings_of_depth * rounding_;
    // A cell within the margin holds nothing that its neighbours do not hold.
    if (half.maxCoeff() <= (overlap + 1.0) * margin_ || cross_throughout(cell, half) ||
        overlap_throughout(cell, radius)) {
        return true;
    }
    rest_.begin(cell.centre, half, margin_);
    in_vain_ = false;
    normals_ = lists_[cell.list].normals;
    return false;
}

CellState TranslationSearch::ask(const TranslationCell& cell) {
    // Where no wall is found, there is none for the parts either, mostly.
    if (!lists_[cell.list].in_vain) {
        // The deepest certificates usually decide the parts as well.
        const auto first = left_.begin();
        const auto sorted = first + static_cast<std::ptrdiff_t>(std::min(left_.size(), max_sorted));
        std::partial_sort(first, sorted, left_.end(),
                          [](const Asked& i, const Asked& j) { return i.bound() > j.bound(); });
        const bool are_few = cut_off_walls(cell);
        if (rest_.is_empty()) {
            return CellState::overlapping;
        }
        piece_count_ = 0;
        add_piece(rest_);
        if (are_few && split_rest()) {
            return CellState::uniform;
        }
        in_vain_ = !has_cut_ && !are_few;
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

std::uint32_t TranslationSearch::keep_answers(const TranslationCell& cell) {
    const auto list = static_cast<std::uint32_t>(lists_.size());
    lists_.push_back({asked_.size(), 0, crossings_asked_.size(), crossings_left_.size(),
                      cell.centre, in_vain_, normals_});
    for (const Asked& asked : left_) {
        if (asked.certificate != dropped) {
            asked_.push_back(asked);
        }
    }
    lists_.back().count = asked_.size() - lists_.back().first;
    crossings_asked_.insert(crossings_asked_.end(), crossings_left_.begin(), crossings_left_.end());
    return list;
}

TranslationSearch::Sides TranslationSearch::sides_of(const CrossingCertificate& crossing) const {
    const double inside = 0.5 * rounding_;
    const double half_a = crossing.half_a - inside;
    const double half_b = crossing.half_b - inside;
    const ConvexPiece::Range a = rest_.along(crossing.across_a);
    const ConvexPiece::Range b = rest_.along(crossing.across_b);
    const bool in_a = a.least >= crossing.middle_a - half_a && a.most <= crossing.middle_a + half_a;
    const bool in_b = b.least >= crossing.middle_b - half_b && b.most <= crossing.middle_b + half_b;
    Sides sides;
    sides.across = in_b ? crossing.across_a : crossing.across_b;
    const double middle = in_b ? crossing.middle_a : crossing.middle_b;
    const double half = in_b ? half_a : half_b;
    const ConvexPiece::Range& range = in_b ? a : b;
    sides.low = middle - half;
    sides.high = middle + half;
    sides.before = range.least < sides.low;
    sides.beyond = range.most > sides.high;
    sides.are_whole = (in_a || in_b) && range.least < sides.high && range.most > sides.low;
    return sides;
}

bool TranslationSearch::cut_off(const CrossingCertificate& crossing) {
    const Sides sides = sides_of(crossing);
    if (!sides.are_whole || (sides.before && sides.beyond)) {
        return false;
    }
    if (!sides.before && !sides.beyond) {
        rest_.clear();
    } else if (sides.beyond) {
        rest_.keep(sides.across, sides.high);
    } else {
        rest_.keep(-sides.across, -sides.low);
    }
    return true;
}

bool TranslationSearch::divide(const TranslationCell& cell, const CrossingCertificate& crossing) {
    const Sides sides = sides_of(crossing);
    if (!sides.are_whole || !sides.before || !sides.beyond) {
        return false;
    }
    const std::uint32_t list = keep_answers(cell);
    beyond_.keep_of(rest_, sides.across, sides.high);
    before_.keep_of(rest_, -sides.across, -sides.low);
    push_piece(beyond_, cell.nearest, list);
    push_piece(before_, cell.nearest, list);
    return true;
}

void TranslationSearch::push_piece(const ConvexPiece& piece, double nearest, std::uint32_t list) {
    if (!piece.is_empty()) {
        const geometry::Box box = piece.box();
        push({box.center(), (0.5 * box.diagonal().array() - overlap * margin_).max(0.0),
              std::max(nearest, piece.nearest().norm()), list});
    }
}

void TranslationSearch::cut(const TranslationCell& cell) {
    const std::uint32_t list = keep_answers(cell);
    const geometry::Box box = rest_.box();
    const Vector centre = box.center();
    Vector half = (0.5 * box.diagonal().array() - overlap * margin_).max(0.0);
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
