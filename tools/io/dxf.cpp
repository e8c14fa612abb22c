#include <nearfield/curve.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

#include <tools/io/dxf.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// The ends of open chains: end 2 i is the first point of chain i, end 2 i + 1 its last one.
class ChainEnds {
public:
    ChainEnds(const std::vector<ArcChain>& chains, double gap)
        : chains_(chains), gap_(gap), partners_(2 * chains.size(), none) {
        double magnitude = 0.0;
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            magnitude = std::max({magnitude, std::abs(at(end).x), std::abs(at(end).y)});
        }
        side_ = std::max(gap, 0x1p-50 * magnitude);
    }

    /// Joins each end with the nearest one that is left.
    void join() {
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            if (!chains_[end / 2].closed) {
                ends_in_[cell_of(at(end))].push_back(end);
            }
        }
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            if (!chains_[end / 2].closed && partners_[end] == none) {
                take(end);
                join_with_nearest(end);
            }
        }
    }

    [[nodiscard]] Vector2 at(std::size_t end) const {
        const std::vector<ArcChain::Point>& points = chains_[end / 2].points;
        return end % 2 == 0 ? points.front().at : points.back().at;
    }
    [[nodiscard]] std::size_t partner(std::size_t end) const { return partners_[end]; }

private:
    using Cell = std::pair<std::int64_t, std::int64_t>;

    /// A square whose side is the gap, or more if its number would be too large.
    [[nodiscard]] Cell cell_of(const Vector2& point) const {
        if (side_ == 0.0) {
            return {};
        }
        return {static_cast<std::int64_t>(std::floor(point.x / side_)),
                static_cast<std::int64_t>(std::floor(point.y / side_))};
    }

    /// Removes an end from those that are left.
    void take(std::size_t end) { std::erase(ends_in_[cell_of(at(end))], end); }

    void join_with_nearest(std::size_t end) {
        const Vector2 here = at(end);
        const Cell cell = cell_of(here);
        std::size_t nearest = none;
        double least = gap_;
        for (std::int64_t i = 0; i < 9; ++i) {
            const auto found = ends_in_.find({cell.first + i / 3 - 1, cell.second + i % 3 - 1});
            if (found == ends_in_.end()) {
                continue;
            }
            for (const std::size_t other : found->second) {
                const Vector2 there = at(other);
                const double apart =
                    std::max(std::abs(there.x - here.x), std::abs(there.y - here.y));
                if (nearest == none ? apart <= least : apart < least) {
                    nearest = other;
                    least = apart;
                }
            }
        }
        if (nearest != none) {
            take(nearest);
            partners_[end] = nearest;
            partners_[nearest] = end;
        }
    }

    const std::vector<ArcChain>& chains_;
    double gap_;
    double side_ = 0.0;  ///< of a cell
    std::vector<std::size_t> partners_;
    std::map<Cell, std::vector<std::size_t>> ends_in_;  ///< those that are left
};

/// Gives a point the segment of another one, the other way round.
void reverse_segment(const ArcChain::Point& segment, ArcChain::Point& to) {
    to.bulge = -segment.bulge;
    if (segment.controls) {
        to.controls = {(*segment.controls)[1], (*segment.controls)[0]};
    }
    if (segment.ellipse) {
        to.ellipse = segment.ellipse;
        to.ellipse->counter_clockwise = !segment.ellipse->counter_clockwise;
    }
}

/// Appends an open chain to another one, from its first point on or from its last one.
void append_points(const ArcChain& chain, bool is_reversed, ArcChain& to) {
    const std::size_t count = chain.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_reversed) {
            to.points.push_back(chain.points[i]);
        } else {
            const std::size_t from = count - 1 - i;
            to.points.push_back({chain.points[from].at});
            if (from > 0) {
                reverse_segment(chain.points[from - 1], to.points.back());
            }
        }
    }
    to.points.back().bulge = 0.0;  // a straight line over the gap
}

void append_arc(const ArcChain::Point& from, const Vector2& to, CurvePath& path) {
    const Vector2 way{to.x - from.at.x, to.y - from.at.y};
    const double bulge = std::abs(from.bulge);
    constexpr double nearly_straight = 1e-8;
    if (bulge < nearly_straight) {
        // The parabola has the tangents of the arc, and differs from it by less than rounding.
        path.quadratic_to({from.at.x + 0.5 * way.x + from.bulge * way.y,
                           from.at.y + 0.5 * way.y - from.bulge * way.x},
                          to);
        return;
    }
    const double radius = 0.25 * std::hypot(way.x, way.y) * (1.0 / bulge + bulge);
    path.arc_to({.radius_x = radius,
                 .radius_y = radius,
                 .large = bulge > 1.0,
                 .counter_clockwise = from.bulge > 0.0},
                to);
}

void append_segment(const ArcChain::Point& from, const Vector2& to, CurvePath& path) {
    if (from.controls) {
        path.cubic_to((*from.controls)[0], (*from.controls)[1], to);
    } else if (from.at == to) {
        return;
    } else if (from.ellipse) {
        path.arc_to(*from.ellipse, to);
    } else if (from.bulge == 0.0) {
        path.line_to(to);
    } else {
        append_arc(from, to, path);
    }
}

}  // namespace

std::optional<LooseEnd> close_chains(std::vector<ArcChain>& chains, double gap) {
    ChainEnds ends(chains, gap);
    ends.join();
    for (std::size_t end = 0; end < 2 * chains.size(); ++end) {
        if (!chains[end / 2].closed && ends.partner(end) == none) {
            return LooseEnd{ends.at(end), chains[end / 2].offset};
        }
    }
    std::vector<ArcChain> closed;
    std::vector<bool> is_used(chains.size());
    for (std::size_t first = 0; first < chains.size(); ++first) {
        if (chains[first].closed) {
            closed.push_back(std::move(chains[first]));
            continue;
        }
        if (is_used[first]) {
            continue;
        }
        ArcChain loop{.points = {}, .closed = true, .offset = chains[first].offset};
        std::size_t entered = 2 * first;
        do {
            is_used[entered / 2] = true;
            append_points(chains[entered / 2], entered % 2 == 1, loop);
            entered = ends.partner(entered ^ 1U);
        } while (entered != 2 * first);
        closed.push_back(std::move(loop));
    }
    chains = std::move(closed);
    return std::nullopt;
}

double extent_of(const std::vector<ArcChain>& chains) {
    Vector2 low{largest_coordinate, largest_coordinate};
    Vector2 high{-largest_coordinate, -largest_coordinate};
    for (const ArcChain& chain : chains) {
        for (const ArcChain::Point& point : chain.points) {
            low = {std::min(low.x, point.at.x), std::min(low.y, point.at.y)};
            high = {std::max(high.x, point.at.x), std::max(high.y, point.at.y)};
        }
    }
    return std::max(high.x - low.x, high.y - low.y);
}

std::size_t remove_repeated(std::vector<ArcChain>& chains) {
    using Segment = std::tuple<double, double, double, double, double>;
    std::set<Segment> seen;
    return std::erase_if(chains, [&](const ArcChain& chain) {
        if (chain.closed || chain.points.size() != 2 || chain.points[0].has_curve()) {
            return false;
        }
        const Vector2& from = chain.points[0].at;
        const double bulge = chain.points[0].bulge;
        const Vector2& to = chain.points[1].at;
        const bool is_forwards = std::pair(from.x, from.y) < std::pair(to.x, to.y);
        return !seen.insert(is_forwards ? Segment(from.x, from.y, to.x, to.y, bulge)
                                        : Segment(to.x, to.y, from.x, from.y, -bulge))
                    .second;
    });
}

void append_chain(const ArcChain& chain, CurvePath& path) {
    path.move_to(chain.points.front().at);
    for (std::size_t i = 0; i < chain.points.size(); ++i) {
        append_segment(chain.points[i], chain.points[(i + 1) % chain.points.size()].at, path);
    }
    path.close();
}

namespace {

/// A group of a DXF file: two lines, of which the first one says what the second one is.
struct DxfGroup {
    int code = 0;
    std::string_view value;  ///< without spaces around it; borrowed from the text
    std::size_t offset = 0;  ///< of the value in the text
};

/// The groups of a DXF file in text form, one after the other.
class DxfGroups {
public:
    /// Both are borrowed.
    DxfGroups(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    /// Reads the next group; false at the end of the text. Throws InputError for a code that is no
    /// whole number, or that has no value.
    bool next(DxfGroup& group);

    /// Throws InputError for a place in the text.
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const;

private:
    [[nodiscard]] std::string_view take_line();

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
};

/// An entity of a drawing, or a marker of its structure (SECTION, BLOCK, EOF): what a group with
/// the code 0 names, and the groups up to the next one.
struct DxfEntity {
    std::string_view type;
    std::size_t offset = 0;  ///< of the type
    std::vector<DxfGroup> groups = {};

    /// The first group with a code; nothing if there is none.
    [[nodiscard]] const DxfGroup* find(int code) const;
    /// The value of the first group with a code; empty if there is none.
    [[nodiscard]] std::string_view text(int code) const;
    /// The same as a name, in which small letters are as capitals.
    [[nodiscard]] std::string name(int code) const;
};

/// The numbers of a DXF file's entities. All throw InputError, with the place in the file, for what
/// is no finite number of at most 1e12.
class DxfValues {
public:
    DxfValues(std::string_view text, const std::string& file) : groups_(text, file) {}

    [[nodiscard]] DxfGroups& groups() { return groups_; }

    /// Throws InputError for a place in the text, or an entity.
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const {
        groups_.fail(offset, reason);
    }
    [[noreturn]] void fail(const DxfEntity& entity, const std::string& reason) const;

    [[nodiscard]] double number(const DxfGroup& group) const;
    /// The number of the first group with a code, which there must be, or else `usual`.
    [[nodiscard]] double number(const DxfEntity& entity, int code) const;
    [[nodiscard]] double number(const DxfEntity& entity, int code, double usual) const;
    /// Those of all groups with a code.
    [[nodiscard]] std::vector<double> numbers(const DxfEntity& entity, int code) const;
    /// Whether the first group with a code has a bit.
    [[nodiscard]] bool has_flag(const DxfEntity& entity, int code, int flag) const;
    /// Of the groups `code` and `code` + 10.
    [[nodiscard]] Vector2 point(const DxfEntity& entity, int code) const;

    /// 1, or -1 for an entity that is seen from behind, whose x points the other way.
    [[nodiscard]] double direction(const DxfEntity& entity) const;
    [[nodiscard]] double radius(const DxfEntity& entity) const;

private:
    DxfGroups groups_;
};

/// An ELLIPSE.
struct DxfEllipse {
    Vector2 centre;
    double length = 0.0;    ///< of its long half-axis
    double width = 0.0;     ///< of the other one
    double rotation = 0.0;  ///< of the long one, radians
    /// Nothing if it is whole.
    std::optional<ArcChain> arc = std::nullopt;
};

void DxfGroups::fail(std::size_t offset, const std::string& reason) const {
    throw InputError(text_position(file_, text_, offset) + ": " + reason);
}

std::string_view DxfGroups::take_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    return without_spaces(line);
}

bool DxfGroups::next(DxfGroup& group) {
    const std::size_t start = at_;
    const std::string_view code = take_line();
    constexpr std::string_view end_mark = "\x1A";  // of DOS
    if (code == end_mark ||
        (code.empty() && text_.find_first_not_of(" \t\r\n", start) == std::string_view::npos)) {
        return false;
    }
    const auto [rest, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (error != std::errc{} || rest != code.data() + code.size()) {
        fail(start, "expected the code of a group, a whole number; found \"" +
                        std::string(code.substr(0, 40)) + "\"");
    }
    if (at_ == text_.size()) {
        fail(at_,
             "the file ends where the value of group " + std::to_string(group.code) + " should be");
    }
    group.offset = at_;
    group.value = take_line();
    return true;
}

const DxfGroup* DxfEntity::find(int code) const {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [code](const DxfGroup& group) { return group.code == code; });
    return found == groups.end() ? nullptr : &*found;
}

std::string_view DxfEntity::text(int code) const {
    const DxfGroup* const group = find(code);
    return group == nullptr ? std::string_view() : group->value;
}

std::string DxfEntity::name(int code) const {
    std::string name(text(code));
    std::transform(name.begin(), name.end(), name.begin(), to_upper);
    return name;
}

/// Whether entities of a type are no outlines, but say something about them.
bool is_dxf_annotation(std::string_view type) {
    constexpr std::string_view types[] = {
        "TEXT",   "MTEXT",  "DIMENSION", "LEADER", "MULTILEADER", "TOLERANCE", "POINT",  "HATCH",
        "ATTDEF", "ATTRIB", "XLINE",     "RAY",    "VIEWPORT",    "IMAGE",     "SEQEND", "WIPEOUT"};
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

/// All entities and markers of a DXF file in text form.
std::vector<DxfEntity> read_dxf_entities(DxfGroups& groups) {
    constexpr int comment = 999;
    std::vector<DxfEntity> entities;
    for (DxfGroup group; groups.next(group);) {
        if (group.code == 0) {
            entities.push_back({.type = group.value, .offset = group.offset});
        } else if (group.code == comment) {
            continue;
        } else if (entities.empty()) {
            groups.fail(group.offset, "a DXF file begins with a group of code 0");
        } else {
            entities.back().groups.push_back(group);
        }
    }
    return entities;
}

void DxfValues::fail(const DxfEntity& entity, const std::string& reason) const {
    groups_.fail(entity.offset, std::string(entity.type) + ": " + reason);
}

double DxfValues::number(const DxfGroup& group) const {
    double number = 0.0;
    if (!parse_finite(group.value, number)) {
        groups_.fail(group.offset, "group " + std::to_string(group.code) + ": \"" +
                                       std::string(group.value.substr(0, 40)) +
                                       "\" is not a finite number");
    }
    if (std::abs(number) > largest_coordinate) {
        groups_.fail(group.offset, "group " + std::to_string(group.code) +
                                       ": numbers must be at most 1e12 in magnitude");
    }
    return number;
}

double DxfValues::number(const DxfEntity& entity, int code) const {
    const DxfGroup* const group = entity.find(code);
    if (group == nullptr) {
        fail(entity, "lacks group " + std::to_string(code));
    }
    return number(*group);
}

double DxfValues::number(const DxfEntity& entity, int code, double usual) const {
    const DxfGroup* const group = entity.find(code);
    return group == nullptr ? usual : number(*group);
}

std::vector<double> DxfValues::numbers(const DxfEntity& entity, int code) const {
    std::vector<double> numbers;
    for (const DxfGroup& group : entity.groups) {
        if (group.code == code) {
            numbers.push_back(number(group));
        }
    }
    return numbers;
}

bool DxfValues::has_flag(const DxfEntity& entity, int code, int flag) const {
    const double flags = number(entity, code, 0.0);
    return std::abs(flags) <= 0x1p30 && (static_cast<int>(flags) & flag) != 0;
}

Vector2 DxfValues::point(const DxfEntity& entity, int code) const {
    return {number(entity, code), number(entity, code + 10)};
}

double DxfValues::direction(const DxfEntity& entity) const {
    constexpr double rounding = 1e-9;
    const double z = number(entity, 230, 1.0);
    if (std::abs(number(entity, 210, 0.0)) > rounding ||
        std::abs(number(entity, 220, 0.0)) > rounding || std::abs(std::abs(z) - 1.0) > rounding) {
        fail(entity, "does not lie in the plane of x and y");
    }
    return z < 0.0 ? -1.0 : 1.0;
}

double DxfValues::radius(const DxfEntity& entity) const {
    const double radius = number(entity, 40);
    if (!(radius >= 0.0)) {
        fail(entity, "its radius is below 0");
    }
    return radius;
}

/// The point a part of the way from one to another.
Vector2 between(const Vector2& from, const Vector2& to, double part) {
    return {(1.0 - part) * from.x + part * to.x, (1.0 - part) * from.y + part * to.y};
}

/// A polynomial B-spline.
struct Spline {
    std::size_t degree = 3;
    std::vector<double> knots;  // degree + 1 more than points, ascending
    std::vector<Vector2> points;

    /// The polar form of the polynomial between knots `span` and `span` + 1, at as many parameters
    /// as the degree says (Ramshaw 1987; de Boor's algorithm with another parameter in each step).
    [[nodiscard]] Vector2 polar(std::size_t span, const std::array<double, 3>& parameters) const {
        std::array<Vector2, 4> d;
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(span - degree), degree + 1,
                    d.begin());
        for (std::size_t step = 1; step <= degree; ++step) {
            for (std::size_t j = degree; j >= step; --j) {
                const double left = knots[span - degree + j];
                const double right = knots[span + 1 + j - step];
                d[j] = between(d[j - 1], d[j], (parameters[step - 1] - left) / (right - left));
            }
        }
        return d[degree];
    }

    /// The k-th point of the Bézier curve between two knots.
    [[nodiscard]] Vector2 control(std::size_t span, std::size_t k) const {
        std::array<double, 3> parameters{knots[span], knots[span], knots[span]};
        std::fill_n(parameters.begin(), k, knots[span + 1]);
        return polar(span, parameters);
    }
};

Spline read_spline(const DxfValues& values, const DxfEntity& entity) {
    Spline spline;
    const double degree = values.number(entity, 71);
    spline.knots = values.numbers(entity, 40);
    const std::vector<double> x = values.numbers(entity, 10);
    const std::vector<double> y = values.numbers(entity, 20);
    const std::vector<double> z = values.numbers(entity, 30);
    const std::vector<double> weights = values.numbers(entity, 41);
    if (x.empty() && entity.find(11) != nullptr) {
        values.fail(entity, "has points to go through, and no control points");
    }
    if (!(degree == 1.0 || degree == 2.0 || degree == 3.0)) {
        values.fail(entity, "is not of degree 1, 2 or 3; convert it to polylines");
    }
    spline.degree = static_cast<std::size_t>(degree);
    const auto differs = [](const std::vector<double>& numbers) {
        return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) !=
               numbers.end();
    };
    if (differs(weights)) {
        values.fail(entity, "is rational: its weights differ; convert it to polylines");
    }
    if (differs(z)) {
        values.fail(entity, "does not lie in the plane of x and y");
    }
    if (y.size() != x.size() || x.size() <= spline.degree ||
        spline.knots.size() != x.size() + spline.degree + 1) {
        values.fail(entity, "has " + std::to_string(x.size()) + " control points and " +
                                std::to_string(spline.knots.size()) + " knots; degree " +
                                std::to_string(spline.degree) +
                                " needs more points than that, and as many knots and " +
                                std::to_string(spline.degree + 1) + " more");
    }
    if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) {
        values.fail(entity, "its knots do not ascend");
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        spline.points.push_back({x[i], y[i]});
    }
    return spline;
}

/// A SPLINE: a polynomial B-spline of degree 1 to 3, as the Bézier curves that it consists of.
/// Throws InputError for any other.
ArcChain dxf_spline(const DxfValues& values, const DxfEntity& entity) {
    static_cast<void>(values.direction(entity));  // its points are not seen from behind
    const Spline spline = read_spline(values, entity);
    ArcChain chain{.points = {}, .offset = entity.offset};
    double magnitude = 0.0;
    for (const Vector2& point : spline.points) {
        magnitude = std::max({magnitude, std::abs(point.x), std::abs(point.y)});
    }
    Vector2 end;
    for (std::size_t span = spline.degree; span < spline.points.size(); ++span) {
        if (spline.knots[span] == spline.knots[span + 1]) {
            continue;
        }
        const Vector2 start = spline.control(span, 0);
        const Vector2 second = spline.control(span, 1);
        if (!chain.points.empty() &&
            std::max(std::abs(start.x - end.x), std::abs(start.y - end.y)) > 1e-9 * magnitude) {
            values.fail(entity, "is in several pieces: a knot is repeated too often");
        }
        end = spline.control(span, spline.degree);
        ArcChain::Point& from = chain.points.emplace_back();
        from.at = start;
        if (spline.degree == 2) {
            from.controls = {between(second, start, 1.0 / 3.0), between(second, end, 1.0 / 3.0)};
        } else if (spline.degree == 3) {
            from.controls = {second, spline.control(span, 2)};
        }
    }
    if (!chain.points.empty()) {
        chain.points.push_back({.at = end});
    }
    return chain;
}

DxfEllipse dxf_ellipse(const DxfValues& values, const DxfEntity& entity) {
    constexpr double turn = 2.0 * std::numbers::pi;
    const Vector2 axis = values.point(entity, 11);
    DxfEllipse ellipse{.centre = values.point(entity, 10), .length = std::hypot(axis.x, axis.y)};
    ellipse.width = values.number(entity, 40) * ellipse.length;
    ellipse.rotation = arc_tangent(axis.y, axis.x);
    if (!(ellipse.length > 0.0 && ellipse.width > 0.0)) {
        values.fail(entity, "its axes are not above 0");
    }
    const double way = values.direction(entity);
    const double first = values.number(entity, 41, 0.0);
    double sweep = std::fmod(values.number(entity, 42, turn) - first, turn);
    sweep += sweep <= 0.0 ? turn : 0.0;
    constexpr double rounding = 1e-4;  // of files with few digits
    if (turn - sweep <= rounding || sweep <= rounding) {
        return ellipse;
    }
    const double ratio = ellipse.width / ellipse.length;
    const auto at = [&](double angle) {
        const auto [sine, cosine] = sine_cosine(angle);
        return Vector2{ellipse.centre.x + cosine * axis.x - way * ratio * sine * axis.y,
                       ellipse.centre.y + cosine * axis.y + way * ratio * sine * axis.x};
    };
    // None is near half a turn, where ends say little about the way between.
    const std::size_t parts = 1 + static_cast<std::size_t>(sweep / 2.0);
    ArcChain& chain = ellipse.arc.emplace(ArcChain{.points = {}, .offset = entity.offset});
    for (std::size_t i = 0; i <= parts; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(parts);
        ArcChain::Point& point = chain.points.emplace_back();
        point.at = at(first + part * sweep);
        if (i < parts) {
            point.ellipse = EllipticArc{.radius_x = ellipse.length,
                                        .radius_y = ellipse.width,
                                        .rotation = ellipse.rotation,
                                        .counter_clockwise = way > 0.0};
        }
    }
    return ellipse;
}

/// Entities that stand together: a block, or model space.
struct DxfBlock {
    std::vector<DxfEntity> entities = {};
    Vector2 base = {};  ///< the point that an INSERT puts at its place
    enum class State { unread, in_progress, done } state = State::unread;
    CurvePath path = {};
    std::size_t segments = 0;  ///< of the path
};

class DxfReader : private DxfValues {
    // Blocks in blocks multiply: a small file must not take all memory.
    static constexpr std::size_t most_segments = std::size_t{1} << 18U;

public:
    DxfReader(const std::string& text, const std::string& file, SkippedParts& skipped)
        : DxfValues(text, file), skipped_(skipped) {}

    CurvePath read(LengthUnit unit) {
        const std::vector<DxfEntity> all = read_dxf_entities(groups());
        if (all.empty() || all.front().type != "SECTION") {
            fail(0, "a DXF file begins with a section");
        }
        sort_into_blocks(all);
        CurvePath path = path_of(model_, 0);
        if (path.contours().empty()) {
            fail(0, "has no outline" + (skipped_.empty() ? "" : ", only " + skipped_.text()));
        }
        if (unit != LengthUnit::user) {
            const double scale = pixels_ / pixels_per(unit);
            if (scale == 0.0) {
                fail(0, "states no unit ($INSUNITS 1 to 14); --units needs one");
            }
            path.transform({{scale, 0.0}, {0.0, scale}, {}});
        }
        return path;
    }

private:
    /// A number of copies, at least 1; of those that are too many, as many as are refused.
    [[nodiscard]] std::size_t count(const DxfEntity& entity, int code) const {
        const double most = static_cast<double>(most_segments) + 1.0;
        return static_cast<std::size_t>(std::clamp(number(entity, code, 1.0), 1.0, most));
    }

    void sort_into_blocks(const std::vector<DxfEntity>& all) {
        std::string_view section;
        DxfBlock* block = nullptr;
        for (const DxfEntity& entity : all) {
            if (entity.type == "SECTION") {
                section = entity.text(2);
                block = section == "ENTITIES" ? &model_ : nullptr;
                if (section == "HEADER") {
                    read_unit(entity);
                }
            } else if (entity.type == "ENDSEC") {
                section = {};
                block = nullptr;
            } else if (section == "TABLES" && entity.type == "LAYER") {
                read_layer(entity);
            } else if (section == "BLOCKS" && entity.type == "BLOCK") {
                block = &blocks_[entity.name(2)];
                *block = {.base = point(entity, 10)};
            } else if (section == "BLOCKS" && entity.type == "ENDBLK") {
                block = nullptr;
            } else if (block != nullptr) {
                block->entities.push_back(entity);
            }
        }
        if (!section.empty()) {
            fail(all.back().offset,
                 "the file ends within its section " + std::string(section.substr(0, 40)));
        }
    }

    void read_unit(const DxfEntity& header) {
        for (std::size_t i = 0; i + 1 < header.groups.size(); ++i) {
            if (header.groups[i].code == 9 && header.groups[i].value == "$INSUNITS") {
                pixels_ = pixels_of_insunits(number(header.groups[i + 1]));
            }
        }
    }

    void read_layer(const DxfEntity& layer) {
        if (number(layer, 62, 7.0) < 0.0 || has_flag(layer, 70, 1)) {
            hidden_layers_.insert(layer.name(2));
        }
    }

    /// The outlines of a block, for which no block may be needed that needs it.
    const CurvePath& path_of(DxfBlock& block, std::size_t offset) {
        if (block.state == DxfBlock::State::in_progress) {
            fail(offset, "INSERT: the block holds itself");
        }
        if (block.state == DxfBlock::State::unread) {
            block.state = DxfBlock::State::in_progress;
            std::vector<ArcChain> chains;
            for (std::size_t i = 0; i < block.entities.size(); ++i) {
                read_entity(block, i, chains);
            }
            close(chains);
            for (const ArcChain& chain : chains) {
                block.segments += chain.points.size();
                append_chain(chain, block.path);
            }
            block.state = DxfBlock::State::done;
        }
        return block.path;
    }

    void close(std::vector<ArcChain>& chains) {
        const double gap = 1e-6 * extent_of(chains);
        std::optional<LooseEnd> end = close_chains(chains, gap);
        if (const std::size_t repeated = end ? remove_repeated(chains) : 0; repeated > 0) {
            skipped_.add("line drawn twice", repeated);
            end = close_chains(chains, gap);
        }
        if (end) {
            char text[120];
            std::snprintf(text, sizeof text,
                          "the outline is open: nothing continues it at (%.17g, %.17g)", end->at.x,
                          end->at.y);
            fail(end->offset, text);
        }
    }

    void read_entity(DxfBlock& block, std::size_t& index, std::vector<ArcChain>& chains) {
        const DxfEntity& entity = block.entities[index];
        const std::string_view type = entity.type;
        if (has_flag(entity, 67, 1) || has_flag(entity, 60, 1)) {
            return skip(block, index, "of paper space, or invisible");
        }
        if (hidden_layers_.contains(entity.name(8))) {
            return skip(block, index, "on a layer that is off or frozen");
        }
        if (is_dxf_annotation(type)) {
            skipped_.add(type);
        } else if (type == "LWPOLYLINE") {
            add(lightweight(entity), chains);
        } else if (type == "POLYLINE") {
            add(polyline(block, index), chains);
        } else if (type == "LINE") {
            if (number(entity, 30, 0.0) != number(entity, 31, 0.0)) {
                fail(entity, "does not lie in the plane of x and y");
            }
            add({.points = {{point(entity, 10), 0.0}, {point(entity, 11), 0.0}},
                 .offset = entity.offset},
                chains);
        } else if ((type == "ARC" || type == "CIRCLE") && radius(entity) == 0.0) {
            skipped_.add(empty_part);
        } else if (type == "ARC") {
            add_arc(block, entity, chains);
        } else if (type == "CIRCLE") {
            add_circle(block, entity);
        } else if (type == "ELLIPSE") {
            add_ellipse(block, entity, chains);
        } else if (type == "SPLINE") {
            add(dxf_spline(*this, entity), chains);
        } else if (type == "INSERT") {
            insert(block, entity);
        } else {
            fail(entity, "is not read; convert it to polylines, or remove it");
        }
    }

    /// Passes an entity, with the vertices that follow it.
    void skip(const DxfBlock& block, std::size_t& index, std::string_view why) {
        skipped_.add(why);
        const auto next_is = [&](std::string_view type) {
            return index + 1 < block.entities.size() && block.entities[index + 1].type == type;
        };
        while (next_is("VERTEX") || next_is("SEQEND")) {
            ++index;
        }
    }

    /// Adds a chain that goes somewhere.
    void add(ArcChain chain, std::vector<ArcChain>& chains) {
        if (chain.points.size() >= 2) {
            return chains.push_back(std::move(chain));
        }
        skipped_.add(empty_part);
    }

    void add_circle(DxfBlock& block, const DxfEntity& entity) const {
        block.path.circle(placed(entity, point(entity, 10)), radius(entity));
        ++block.segments;
    }

    [[nodiscard]] Vector2 placed(const DxfEntity& entity, const Vector2& point) const {
        return {direction(entity) * point.x, point.y};
    }

    [[nodiscard]] ArcChain lightweight(const DxfEntity& entity) const {
        ArcChain chain{.points = {}, .closed = has_flag(entity, 70, 1), .offset = entity.offset};
        const double way = direction(entity);
        for (const DxfGroup& group : entity.groups) {
            if (group.code == 10) {
                chain.points.push_back({{way * number(group), 0.0}, 0.0});
            } else if (!chain.points.empty() && group.code == 20) {
                chain.points.back().at.y = number(group);
            } else if (!chain.points.empty() && group.code == 42) {
                chain.points.back().bulge = way * number(group);
            }
        }
        return chain;
    }

    /// A POLYLINE and the VERTEX entities that follow it, which `index` then has passed.
    [[nodiscard]] ArcChain polyline(const DxfBlock& block, std::size_t& index) const {
        const DxfEntity& entity = block.entities[index];
        constexpr int in_space_or_mesh = 8 | 16 | 64;
        constexpr int frame_of_spline = 16;
        if (has_flag(entity, 70, in_space_or_mesh)) {
            fail(entity, "is a mesh, or lies in space");
        }
        ArcChain chain{.points = {}, .closed = has_flag(entity, 70, 1), .offset = entity.offset};
        const double way = direction(entity);
        while (index + 1 < block.entities.size() && block.entities[index + 1].type == "VERTEX") {
            const DxfEntity& vertex = block.entities[++index];
            if (!has_flag(vertex, 70, frame_of_spline)) {
                const Vector2 at = point(vertex, 10);
                chain.points.push_back({{way * at.x, at.y}, way * number(vertex, 42, 0.0)});
            }
        }
        if (index + 1 < block.entities.size() && block.entities[index + 1].type == "SEQEND") {
            ++index;
        }
        return chain;
    }

    void add_arc(DxfBlock& block, const DxfEntity& entity, std::vector<ArcChain>& chains) const {
        constexpr double degree = std::numbers::pi / 180.0;
        const Vector2 centre = point(entity, 10);
        const double first = std::fmod(number(entity, 50), 360.0);
        double sweep = std::fmod(number(entity, 51) - first, 360.0);
        sweep += sweep <= 0.0 ? 360.0 : 0.0;
        if (sweep == 360.0) {
            return add_circle(block, entity);
        }
        const double way = direction(entity);
        const auto at = [&](double degrees) {
            const auto [sine, cosine] = sine_cosine(degree * degrees);
            return Vector2{way * (centre.x + radius(entity) * cosine),
                           centre.y + radius(entity) * sine};
        };
        const auto [sine, cosine] = sine_cosine(0.25 * degree * sweep);
        chains.push_back({.points = {{at(first), way * (sine / cosine)}, {at(first + sweep), 0.0}},
                          .offset = entity.offset});
    }

    void add_ellipse(DxfBlock& block, const DxfEntity& entity,
                     std::vector<ArcChain>& chains) const {
        const DxfEllipse ellipse = dxf_ellipse(*this, entity);
        if (ellipse.arc) {
            chains.push_back(*ellipse.arc);
            return;
        }
        block.path.ellipse(ellipse.centre, ellipse.length, ellipse.width, ellipse.rotation);
        ++block.segments;
    }

    void insert(DxfBlock& block, const DxfEntity& entity) {
        const auto found = blocks_.find(entity.name(2));
        if (found == blocks_.end()) {
            fail(entity, "there is no block \"" + std::string(entity.text(2).substr(0, 40)) + "\"");
        }
        const CurvePath& content = path_of(found->second, entity.offset);
        const std::size_t columns = count(entity, 70);
        const std::size_t copies = columns * count(entity, 71);
        block.segments += copies * std::max<std::size_t>(found->second.segments, 1);
        if (block.segments > most_segments) {
            fail(entity,
                 "the blocks place more than " + std::to_string(most_segments) + " segments");
        }
        const Vector2 scale{number(entity, 41, 1.0), number(entity, 42, 1.0)};
        const Vector2& base = found->second.base;
        const Vector2 at = point(entity, 10);
        const double way = direction(entity);
        const auto [sine, cosine] = sine_cosine(std::numbers::pi / 180.0 * number(entity, 50, 0.0));
        AffineMap map{{way * scale.x * cosine, scale.x * sine},
                      {-way * scale.y * sine, scale.y * cosine},
                      {}};
        const Vector2 first{way * at.x - base.x * map.x_axis.x - base.y * map.y_axis.x,
                            at.y - base.x * map.x_axis.y - base.y * map.y_axis.y};
        const double between_columns = number(entity, 44, 0.0);
        const double between_rows = number(entity, 45, 0.0);
        for (std::size_t i = 0; i < copies; ++i) {
            const std::size_t row = i / columns;
            const double right = static_cast<double>(i % columns) * between_columns;
            const double up = static_cast<double>(row) * between_rows;
            map.origin = {first.x + way * (right * cosine - up * sine),
                          first.y + right * sine + up * cosine};
            block.path.append(CurvePath(content).transform(map));
        }
    }

    SkippedParts& skipped_;
    std::map<std::string, DxfBlock> blocks_;
    std::set<std::string> hidden_layers_;  ///< off or frozen
    DxfBlock model_;
    double pixels_ = 0.0;  ///< in a unit of the file; 0 if it states none
};

}  // namespace

CurvePath parse_dxf(const std::string& text, const std::string& file, SkippedParts& skipped,
                    LengthUnit unit) {
    return DxfReader(text, file, skipped).read(unit);
}

}  // namespace nearfield::tools
