#include <engine/base/status_exception.hpp>
#include <engine/geometry/whole.hpp>
#include <engine/outline/exact_kernels.hpp>
#include <engine/outline/snap_rounding.hpp>
#include <engine/simd/box_hierarchy.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace nearfield::outline {
namespace {

using exact::Axis;
using exact::Crossing;

/// An edge of a ring that is longer than 0.
struct Segment {
    Vector2 a;
    Vector2 b;
    Cell cell_of_a;
    Cell cell_of_b;
    std::uint32_t ring;
};

/// A hot cell that a segment passes.
struct Passage {
    std::uint32_t segment;
    Cell cell;
};

std::int64_t nearest_integer(double value) {
    const double below = geometry::whole_below(value);
    return static_cast<std::int64_t>(value - below >= 0.5 ? below + 1.0 : below);
}

int sign_of_difference(double first, double second) {
    return (first > second ? 1 : 0) - (first < second ? 1 : 0);
}

/// A coordinate of the cell that holds a crossing. It lies in the boxes of both segments.
std::int64_t crossing_coordinate(const Crossing& crossing, Axis axis) {
    const auto ends = [axis](const Vector2& first, const Vector2& second) {
        return axis == Axis::x ? std::minmax(first.x, second.x) : std::minmax(first.y, second.y);
    };
    const std::pair<double, double> of_ab = ends(crossing.a, crossing.b);
    const std::pair<double, double> of_cd = ends(crossing.c, crossing.d);
    std::int64_t low = nearest_integer(std::max(of_ab.first, of_cd.first));
    std::int64_t high = nearest_integer(std::min(of_ab.second, of_cd.second));
    // The integer is the last one whose cell begins no later than at the crossing. The first
    // guesses are nearly always right.
    std::int64_t guess =
        std::clamp(nearest_integer(exact::approximate_coordinate(crossing, axis)), low, high);
    for (int round = 0; low < high; ++round) {
        if (exact::compare_coordinate(crossing, axis, static_cast<double>(guess) - 0.5) >= 0) {
            low = guess;
        } else {
            high = guess - 1;
        }
        guess = round == 0 && low < high && low == guess ? guess + 1 : low + (high - low + 1) / 2;
    }
    return low;
}

/// True if one rounded product shows that the line from a to b does not pass the cell around a
/// centre: most cells in the box of a long segment are far from it.
bool is_clearly_beside(const Vector2& a, const Vector2& b, const Vector2& centre) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double left = dx * (centre.y - a.y);
    const double right = dy * (centre.x - a.x);
    const double rounding = 0x1p-50 * (std::abs(left) + std::abs(right));
    return std::abs(left - right) > 0.51 * (std::abs(dx) + std::abs(dy)) + rounding;
}

std::vector<Segment> segments_of(std::span<const Ring> rings) {
    std::vector<Segment> segments;
    std::size_t size = 0;
    for (const Ring& ring : rings) {
        size += ring.size();
    }
    segments.reserve(size);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        for (std::size_t i = 0; i < rings[r].size(); ++i) {
            const Vector2& a = rings[r][i];
            const Vector2& b = rings[r][i + 1 == rings[r].size() ? 0 : i + 1];
            if (a != b) {
                segments.push_back({a, b, cell_of(a), cell_of(b), static_cast<std::uint32_t>(r)});
            }
        }
    }
    return segments;
}

/// Finds the hot cells and the segments that pass them.
class HotCells {
public:
    HotCells(std::span<const Segment> segments, std::size_t most)
        : segments_(segments), most_(most) {
        for (std::uint32_t i = 0; i < segments.size(); ++i) {
            tree_.set(i, box_of(segments[i]));
        }
        tree_.prepare();
    }

    std::vector<Passage> find() {
        passages_.reserve(3 * segments_.size());
        for (std::uint32_t i = 0; i < segments_.size(); ++i) {
            passages_.push_back({i, segments_[i].cell_of_a});
            passages_.push_back({i, segments_[i].cell_of_b});
        }
        for (std::uint32_t i = 0; i < segments_.size(); ++i) {
            tree_.for_meeting(box_of(segments_[i]), [&](std::uint32_t j) {
                if (i < j) {
                    examine(i, j);
                }
            });
        }
        add_passages_of_crossings();
        return std::move(passages_);
    }

private:
    /// Contains every cell that a segment passes.
    static geometry::Box box_of(const Segment& segment) {
        geometry::Box box(geometry::to_vector(segment.a));
        box.extend(geometry::to_vector(segment.b));
        return geometry::grown(box, 1.0);
    }

    void examine(std::uint32_t i, std::uint32_t j) {
        const Segment& first = segments_[i];
        const Segment& second = segments_[j];
        // Every vertex is the beginning of one segment.
        add_if_passing(i, second.cell_of_a);
        add_if_passing(j, first.cell_of_a);
        if (cross(first, second)) {
            const Crossing crossing{first.a, first.b, second.a, second.b};
            crossings_.push_back(
                {crossing_coordinate(crossing, Axis::x), crossing_coordinate(crossing, Axis::y)});
            if (crossings_.size() > 2 * most_) {
                keep_different_crossings();
            }
        }
    }

    void add_if_passing(std::uint32_t i, const Cell& cell) {
        const Segment& segment = segments_[i];
        if (cell != segment.cell_of_a && cell != segment.cell_of_b &&
            passes(segment.a, segment.b, cell)) {
            passages_.push_back({i, cell});
        }
    }

    /// True if two segments cross at an inner point of both.
    static bool cross(const Segment& first, const Segment& second) {
        if (first.b == second.a || second.b == first.a) {
            return false;
        }
        const int c = exact::orientation(first.a, first.b, second.a);
        if (c == 0 || c * exact::orientation(first.a, first.b, second.b) >= 0) {
            return false;
        }
        const int a = exact::orientation(second.a, second.b, first.a);
        return a != 0 && a * exact::orientation(second.a, second.b, first.b) < 0;
    }

    void keep_different_crossings() {
        std::sort(crossings_.begin(), crossings_.end());
        crossings_.erase(std::unique(crossings_.begin(), crossings_.end()), crossings_.end());
        if (crossings_.size() > most_) {
            throw StatusException(
                {StatusCode::too_large,
                 "the rings cross at more than " + std::to_string(most_) + " places, the limit"});
        }
    }

    /// Cells of vertices were compared with all segments near them; those of crossings were not.
    void add_passages_of_crossings() {
        keep_different_crossings();
        for (const Cell& cell : crossings_) {
            const geometry::Vector centre(static_cast<double>(cell.x), static_cast<double>(cell.y));
            tree_.for_meeting(geometry::Box(centre),
                              [&](std::uint32_t i) { add_if_passing(i, cell); });
        }
    }

    std::span<const Segment> segments_;
    std::size_t most_;
    simd::BoxHierarchy tree_;  // of the segments
    std::vector<Passage> passages_;
    std::vector<Cell> crossings_;
};

/// The cells of passages, sorted.
std::vector<Cell> cells_of(std::span<const Passage> passages) {
    std::vector<Cell> cells;
    cells.reserve(passages.size());
    for (const Passage& passage : passages) {
        cells.push_back(passage.cell);
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

/// Sorts passages by segment, and along each. Points of a segment in two cells differ in the sign
/// of neither coordinate from the centres of these cells, so the sum of the coordinates, each with
/// the sign of the segment's direction, grows along the segment.
void sort_along_segments(std::span<const Segment> segments, std::vector<Passage>& passages) {
    const auto along = [&](const Passage& passage) {
        const Segment& segment = segments[passage.segment];
        return sign_of_difference(segment.b.x, segment.a.x) * passage.cell.x +
               sign_of_difference(segment.b.y, segment.a.y) * passage.cell.y;
    };
    std::sort(passages.begin(), passages.end(), [&](const Passage& first, const Passage& second) {
        return first.segment != second.segment ? first.segment < second.segment
                                               : along(first) < along(second);
    });
}

}  // namespace

int orientation(const Cell& a, const Cell& b, const Cell& c) {
    __extension__ using Wide = __int128;
    const Wide left = static_cast<Wide>(b.x - a.x) * (c.y - a.y);
    const Wide right = static_cast<Wide>(b.y - a.y) * (c.x - a.x);
    return (left > right ? 1 : 0) - (left < right ? 1 : 0);
}

Cell cell_of(const Vector2& point) {
    return {nearest_integer(point.x), nearest_integer(point.y)};
}

bool passes(const Vector2& a, const Vector2& b, const Cell& cell) {
    const double left = static_cast<double>(cell.x) - 0.5;
    const double right = left + 1.0;
    const double bottom = static_cast<double>(cell.y) - 0.5;
    const double top = bottom + 1.0;
    if (std::max(a.x, b.x) < left || std::min(a.x, b.x) >= right || std::max(a.y, b.y) < bottom ||
        std::min(a.y, b.y) >= top) {
        return false;
    }
    const int along_x = sign_of_difference(b.x, a.x);
    const int along_y = sign_of_difference(b.y, a.y);
    if (along_x == 0 || along_y == 0) {
        return true;
    }
    if (is_clearly_beside(a, b, {left + 0.5, bottom + 0.5})) {
        return false;
    }
    // The line has to pass between the two corners that lie farthest to its sides. The top and the
    // right side are not of the cell: a corner on the line counts as if it lay a little inside.
    int first = 0;
    int second = 0;
    if (along_x == along_y) {
        first = exact::orientation(a, b, {left, top});
        second = exact::orientation(a, b, {right, bottom});
        first = first != 0 ? first : -along_x;
        second = second != 0 ? second : along_y;
    } else {
        first = exact::orientation(a, b, {left, bottom});
        second = exact::orientation(a, b, {right, top});
        second = second != 0 ? second : along_y;
    }
    return first * second <= 0;
}

SnapRounding snap_round(std::span<const Ring> rings, std::size_t most) {
    const std::vector<Segment> segments = segments_of(rings);
    std::vector<Passage> passages = HotCells(segments, most).find();
    SnapRounding result;
    result.cells = cells_of(passages);
    if (result.cells.size() > most) {
        throw StatusException({StatusCode::too_large, "the rings have more than " +
                                                          std::to_string(most) +
                                                          " vertices and crossings, the limit"});
    }
    sort_along_segments(segments, passages);
    const auto index_of = [&](const Cell& cell) {
        return static_cast<std::uint32_t>(
            std::lower_bound(result.cells.begin(), result.cells.end(), cell) -
            result.cells.begin());
    };
    result.edges.reserve(passages.size());
    for (std::size_t i = 1; i < passages.size(); ++i) {
        const Passage& from = passages[i - 1];
        const Passage& to = passages[i];
        if (from.segment == to.segment && from.cell != to.cell) {
            result.edges.push_back(
                {index_of(from.cell), index_of(to.cell), segments[from.segment].ring});
        }
    }
    return result;
}

}  // namespace nearfield::outline
