#include <tests/unit/mtv/exact_difference.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nearfield::mtv::exact {
namespace {

__extension__ typedef __int128 Wide;  // products of coordinates exceed 64 bits

Point operator-(const Point& i, const Point& j) {
    return {i.x - j.x, i.y - j.y};
}

Point operator+(const Point& i, const Point& j) {
    return {i.x + j.x, i.y + j.y};
}

std::int64_t cross(const Point& i, const Point& j) {
    return i.x * j.y - i.y * j.x;
}

std::int64_t dot(const Point& i, const Point& j) {
    return i.x * j.x + i.y * j.y;
}

int sign(Wide number) {
    return number > 0 ? 1 : (number < 0 ? -1 : 0);
}

/// Counter-clockwise from the positive x axis.
bool comes_before(const Point& i, const Point& j) {
    const auto is_low = [](const Point& p) { return p.y < 0 || (p.y == 0 && p.x < 0); };
    return is_low(i) != is_low(j) ? is_low(j) : cross(i, j) > 0;
}

bool is_same_direction(const Point& i, const Point& j) {
    return cross(i, j) == 0 && dot(i, j) > 0;
}

}  // namespace

Difference::Difference(Shape a, Shape b) : a_(std::move(a)), b_(std::move(b)) {
    const auto list = [](const Shape& shape, std::vector<Edge>& edges) {
        for (const std::vector<Point>& ring : shape) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
            }
        }
    };
    list(a_, edges_a_);
    list(b_, edges_b_);
    for (const Edge& of_a : edges_a_) {
        for (const Edge& of_b : edges_b_) {
            walls_.push_back({of_b.start - of_a.start, of_b.end - of_a.start});
            walls_.push_back({of_b.start - of_a.start, of_b.start - of_a.end});
        }
    }
}

std::vector<Difference::Rational> Difference::ends() const {
    std::vector<Rational> ends;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
        const Point along = walls_[i].end - walls_[i].start;
        const std::int64_t squared = dot(along, along);
        const std::int64_t part = -dot(walls_[i].start, along);
        if (part >= 0 && part <= squared) {
            ends.push_back({walls_[i].start.x * squared + part * along.x,
                            walls_[i].start.y * squared + part * along.y, squared});
        }
        for (std::size_t k = 0; k < i; ++k) {
            const Point other = walls_[k].end - walls_[k].start;
            const Point between = walls_[k].start - walls_[i].start;
            std::int64_t area = cross(along, other);
            std::int64_t first = cross(between, other);
            std::int64_t second = cross(between, along);
            if (area < 0) {
                area = -area;
                first = -first;
                second = -second;
            }
            if (area > 0 && first >= 0 && first <= area && second >= 0 && second <= area) {
                ends.push_back({walls_[i].start.x * area + first * along.x,
                                walls_[i].start.y * area + first * along.y, area});
            }
        }
    }
    return ends;
}

std::vector<Point> Difference::sectors_at(const Rational& end) const {
    std::vector<Point> directions;
    for (const Edge& wall : walls_) {
        const Point along = wall.end - wall.start;
        const Wide off = Wide(along.x) * (end.y - Wide(wall.start.y) * end.w) -
                         Wide(along.y) * (end.x - Wide(wall.start.x) * end.w);
        if (off == 0) {
            // The whole line: more sectors than needed do no harm.
            directions.push_back(along);
            directions.push_back({-along.x, -along.y});
        }
    }
    std::sort(directions.begin(), directions.end(), comes_before);
    directions.erase(std::unique(directions.begin(), directions.end(), is_same_direction),
                     directions.end());
    if (directions.empty()) {
        return {{1, 1}};
    }
    std::vector<Point> sectors;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const Point& from = directions[i];
        const Point& to = directions[(i + 1) % directions.size()];
        sectors.push_back(cross(from, to) > 0 ? from + to : Point{-from.y, from.x});
    }
    return sectors;
}

bool Difference::share_a_point(const Rational& end, const Point& step) const {
    // The side of `point`, moved by the translation and the step, of the line from `from` to `to`;
    // `point` minus `from` is stated, so that it serves both shapes.
    const auto side = [&](const Point& along, const Point& way) {
        const int there = sign(Wide(along.x) * (end.y + Wide(way.y) * end.w) -
                               Wide(along.y) * (end.x + Wide(way.x) * end.w));
        return there != 0 ? there : sign(cross(along, step));
    };
    for (const Edge& of_a : edges_a_) {
        const Point along_a = of_a.end - of_a.start;
        for (const Edge& of_b : edges_b_) {
            const Point along_b = of_b.end - of_b.start;
            // A's ends on both sides of B's edge, and, as A moves, B's ends of A's edge.
            if (side(along_b, of_a.start - of_b.start) * side(along_b, of_a.end - of_b.start) < 0 &&
                side(along_a, of_a.start - of_b.start) * side(along_a, of_a.start - of_b.end) < 0) {
                return true;
            }
        }
    }
    // No boundary crosses the other: a ring of one may lie in the other.
    const auto is_above = [&](std::int64_t way) {
        const int there = sign(end.y + Wide(way) * end.w);
        return there != 0 ? there > 0 : step.y > 0;
    };
    const auto a_in_b = [&](const Point& vertex) {
        bool inside = false;
        for (const Edge& edge : edges_b_) {
            const bool start_is_below = is_above(vertex.y - edge.start.y);
            if (start_is_below != is_above(vertex.y - edge.end.y)) {
                const int left = side(edge.end - edge.start, vertex - edge.start);
                inside ^= start_is_below ? left > 0 : left < 0;
            }
        }
        return inside;
    };
    const auto b_in_a = [&](const Point& vertex) {
        bool inside = false;
        for (const Edge& edge : edges_a_) {
            const bool start_is_above = is_above(edge.start.y - vertex.y);
            if (start_is_above != is_above(edge.end.y - vertex.y)) {
                // Of the moved edge, the vertex is on the opposite side as the edge of the vertex.
                const int left = -side(edge.end - edge.start, edge.start - vertex);
                inside ^= start_is_above ? left < 0 : left > 0;
            }
        }
        return inside;
    };
    return std::any_of(a_.begin(), a_.end(), [&](const auto& r) { return a_in_b(r.front()); }) ||
           std::any_of(b_.begin(), b_.end(), [&](const auto& r) { return b_in_a(r.front()); });
}

bool Difference::separates(double x, double y) const {
    constexpr int bits = 50;
    const Rational end{std::llround(std::ldexp(x, bits)), std::llround(std::ldexp(y, bits)),
                       std::int64_t{1} << bits};
    const std::vector<Point> sectors = sectors_at(end);
    return std::none_of(sectors.begin(), sectors.end(),
                        [&](const Point& sector) { return share_a_point(end, sector); });
}

double Difference::shortest() const {
    struct Candidate {
        double length;
        Rational end;
    };
    std::vector<Candidate> candidates{{0.0, {}}};
    for (const Rational& end : ends()) {
        const auto w = static_cast<double>(end.w);
        candidates.push_back(
            {std::hypot(static_cast<double>(end.x) / w, static_cast<double>(end.y) / w), end});
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& i, const Candidate& j) { return i.length < j.length; });
    const auto is_same = [](const Candidate& i, const Candidate& j) {
        return Wide(i.end.x) * j.end.w == Wide(j.end.x) * i.end.w &&
               Wide(i.end.y) * j.end.w == Wide(j.end.y) * i.end.w;
    };
    candidates.erase(std::unique(candidates.begin(), candidates.end(), is_same), candidates.end());
    for (const Candidate& candidate : candidates) {
        for (const Point& sector : sectors_at(candidate.end)) {
            if (!share_a_point(candidate.end, sector)) {
                return candidate.length;
            }
        }
    }
    throw std::logic_error("no translation separates the shapes");
}

}  // namespace nearfield::mtv::exact
