#include <nearfield/query.hpp>

#include <tools/io/input_error.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

/// A vertex of the second list.
struct Corner {
    double x = 0.0;
    std::size_t ring = 0;
    std::size_t vertex = 0;
};

/// True if the vertices of `ring` from the first on are those of `other` from `start` on, whose
/// numbers change by `step`. Precondition: the sizes are equal.
bool match_from(const Ring& ring, const Ring& other, std::size_t start, std::size_t step,
                double distance) {
    std::size_t at = start;
    for (const Vector2& vertex : ring) {
        if (!(std::abs(vertex.x - other[at].x) <= distance &&
              std::abs(vertex.y - other[at].y) <= distance)) {
            return false;
        }
        at = (at + step) % other.size();
    }
    return true;
}

}  // namespace

bool are_same_rings(std::span<const Ring> first, std::span<const Ring> second, double distance) {
    if (first.size() != second.size()) {
        return false;
    }
    std::vector<Corner> corners;
    for (std::size_t ring = 0; ring < second.size(); ++ring) {
        for (std::size_t vertex = 0; vertex < second[ring].size(); ++vertex) {
            corners.push_back({second[ring][vertex].x, ring, vertex});
        }
    }
    std::sort(corners.begin(), corners.end(),
              [](const Corner& a, const Corner& b) { return a.x < b.x; });
    std::vector<bool> is_taken(second.size());
    return std::all_of(first.begin(), first.end(), [&](const Ring& ring) {
        if (ring.empty()) {
            return false;
        }
        auto corner = std::lower_bound(corners.begin(), corners.end(), ring.front().x - distance,
                                       [](const Corner& a, double x) { return a.x < x; });
        for (; corner != corners.end() && corner->x <= ring.front().x + distance; ++corner) {
            const Ring& other = second[corner->ring];
            if (!is_taken[corner->ring] && other.size() == ring.size() &&
                (match_from(ring, other, corner->vertex, 1, distance) ||
                 match_from(ring, other, corner->vertex, other.size() - 1, distance))) {
                is_taken[corner->ring] = true;
                return true;
            }
        }
        return false;
    });
}

namespace {

/// What the coordinates of a shape span, and how large they become.
struct Range {
    double longer_side = 0.0;
    double magnitude = 0.0;
};

Range range_of(const PlacedRings& shape) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Vector2 low{infinite, infinite};
    Vector2 high{-infinite, -infinite};
    double radius = 0.0;
    for (const Ring& ring : shape.rings) {
        for (const Vector2 vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
            radius = std::max(radius, std::hypot(vertex.x, vertex.y));
        }
    }
    const double distance = std::hypot(shape.translation.x, shape.translation.y);
    return {std::max(high.x - low.x, high.y - low.y), radius + distance};
}

}  // namespace

double usual_tolerance(const PlacedRings& a, const PlacedRings& b) {
    const Range range_a = range_of(a);
    const Range range_b = range_of(b);
    // Above what the library demands: 4096 roundings of the coordinates, 1 / max_deviation of the
    // deviations.
    constexpr double roundings = 16384.0 * std::numeric_limits<double>::epsilon();
    constexpr double deviations = 1.001 / max_deviation;
    return std::max({std::max(range_a.longer_side, range_b.longer_side) / 1000.0,
                     roundings * std::max(range_a.magnitude, range_b.magnitude),
                     deviations * (a.deviation + b.deviation)});
}

namespace {

std::string describe(const DroppedRing& dropped) {
    char text[120];
    std::snprintf(text, sizeof text, "ring %zu from (%.17g, %.17g), %.3g wide", dropped.ring,
                  dropped.at.x, dropped.at.y, dropped.width);
    return text;
}

/// "ring 1 from (1, 1), 3e-16 wide; ring 4 ..."
std::string describe(const std::vector<DroppedRing>& dropped) {
    constexpr std::size_t most_listed = 20;
    std::string text;
    for (std::size_t i = 0; i < dropped.size() && i < most_listed; ++i) {
        text += (i == 0 ? "" : "; ") + describe(dropped[i]);
    }
    if (dropped.size() > most_listed) {
        text += "; and " + std::to_string(dropped.size() - most_listed) + " more";
    }
    return text;
}

/// "dropped 1 of 3 rings that ...: ..., 2 vertices (1 repeated, 1 collinear, 0 spikes)"; empty if
/// nothing was dropped. `why`: "that enclose nothing"
std::string describe(const CleanedRings& cleaned, const std::string& why) {
    std::string text;
    if (!cleaned.dropped.empty()) {
        const std::size_t count = cleaned.dropped.size() + cleaned.rings.size();
        text = "dropped " + std::to_string(cleaned.dropped.size()) + " of " +
               std::to_string(count) + (count == 1 ? " ring " : " rings ") + why + ": " +
               describe(cleaned.dropped);
    }
    const std::size_t vertices = cleaned.repeated + cleaned.collinear + cleaned.spikes;
    if (vertices > 0) {
        text += (text.empty() ? "" : "; ") + std::string("dropped ") + std::to_string(vertices) +
                " vertices: " + std::to_string(cleaned.repeated) + " repeated, " +
                std::to_string(cleaned.collinear) + " on straight lines, " +
                std::to_string(cleaned.spikes) + " tips of spikes";
    }
    return text;
}

/// Makes the rings of a shape from those of an outline, step by step.
class Treatment {
public:
    Treatment(const Outline& outline, double deviation, const OutlineTreatment& asked)
        : outline_(outline), asked_(asked) {
        // An offset has arcs of its own.
        const double of_curves =
            outline.curved() ? (asked.offset ? 0.5 * deviation : deviation) : 0.0;
        // Room for the deviation of the fill rule, so that the sum is what the caller allowed.
        const double share = asked.fill_rule || !outline.parts.empty() ? 1.0 - 0x1p-10 : 1.0;
        left_ = share * (deviation - of_curves);
        allowed_ = of_curves;
        OutlineRings rings = tessellate_outline(outline, share * of_curves);
        result_.rings = std::move(rings.rings);
        result_.deviation = rings.deviation;
    }

    ShapeRings run() {
        if (asked_.fill_rule) {
            report_empty_rings();
            fill();
        } else if (!outline_.parts.empty()) {
            report_empty_rings();
            fill_as_drawn();
        }
        if (asked_.clean_width) {
            clean_all(*asked_.clean_width);
        } else if (!asked_.fill_rule && outline_.parts.empty() && !asked_.strict) {
            drop_empty_rings();
        }
        if (asked_.offset) {
            move_boundary(*asked_.offset);
        }
        return std::move(result_);
    }

private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError(outline_.file + ": " + reason);
    }

    void note(const std::string& text) {
        if (!text.empty()) {
            result_.note += (result_.note.empty() ? outline_.file + ": " : "; ") + text;
        }
    }

    /// They vanish with the fill rule, so they are only reported.
    void report_empty_rings() {
        const Expected<CleanedRings> cleaned = clean(result_.rings, {.vertices = false});
        if (!cleaned || cleaned->dropped.empty()) {
            return;
        }
        if (asked_.strict) {
            const std::size_t count = cleaned->dropped.size();
            fail(std::to_string(count) + " of " + std::to_string(result_.rings.size()) +
                 (count == 1 ? " rings encloses nothing: " : " rings enclose nothing: ") +
                 describe(cleaned->dropped));
        }
        note(describe(*cleaned, "that enclose nothing"));
    }

    void fill() {
        FillSettings settings;
        settings.part_sizes = outline_.part_sizes;
        Expected<ResolvedFill> fill = resolve_fill(result_.rings, *asked_.fill_rule, settings);
        if (!fill) {
            fail(fill.error().message());
        }
        if (fill->rings.empty()) {
            fail("nothing is left of it by the fill rule " +
                 std::string(name_of(*asked_.fill_rule)));
        }
        result_.rings = std::move(fill->rings);
        result_.deviation += fill->deviation;
    }

    /// Each element of a drawing by its own rule, and one over the other. Where no edge is inside
    /// of what they cover, the rings stay as they are.
    void fill_as_drawn() {
        std::vector<Ring> drawn;
        std::vector<Ring> regions;
        std::vector<std::uint32_t> sizes;
        double deviation = 0.0;
        auto first = result_.rings.begin();
        for (const FilledPart& part : outline_.parts) {
            const auto end = first + static_cast<std::ptrdiff_t>(part.contours);
            std::vector<Ring> rings = checked(clean({first, end}, {.vertices = false})).rings;
            first = end;
            drawn.insert(drawn.end(), rings.begin(), rings.end());
            if (part.rule != FillRule::odd_even && !rings.empty()) {
                ResolvedFill fill = checked(resolve_fill(rings, part.rule));
                deviation = std::max(deviation, fill.deviation);
                rings = std::move(fill.rings);
            }
            if (!rings.empty()) {
                sizes.push_back(static_cast<std::uint32_t>(rings.size()));
                std::move(rings.begin(), rings.end(), std::back_inserter(regions));
            }
        }
        if (sizes.empty()) {
            fail("nothing that is drawn encloses an area");
        }
        if (sizes.size() > 1) {
            ResolvedFill fill =
                checked(resolve_fill(regions, FillRule::union_of_parts, {.part_sizes = sizes}));
            deviation += fill.deviation;
            regions = std::move(fill.rings);
        }
        const bool is_same = are_same_rings(drawn, regions, deviation);
        result_.rings = std::move(is_same ? drawn : regions);
        result_.deviation = std::max(result_.deviation + deviation, allowed_);
    }

    template <class Value>
    Value checked(Expected<Value> value) {
        if (!value) {
            fail(value.error().message());
        }
        return std::move(*value);
    }

    void drop_empty_rings() {
        Expected<CleanedRings> cleaned = clean(result_.rings, {.vertices = false});
        if (cleaned && !cleaned->rings.empty()) {
            take(*cleaned, "that enclose nothing");
        }
    }

    void clean_all(double width) {
        Expected<CleanedRings> cleaned = clean(result_.rings, {.width = width});
        if (!cleaned) {
            fail(cleaned.error().message());
        }
        char why[80];
        std::snprintf(why, sizeof why, "no wider than %.17g", width);
        if (cleaned->rings.empty()) {
            fail(std::string("all of it is ") + why + ": " + describe(cleaned->dropped));
        }
        take(*cleaned, asked_.fill_rule ? std::string("of the filled region ") + why : why);
    }

    void move_boundary(double distance) {
        // More come of a wrong unit alone, and would take seconds.
        constexpr std::uint32_t most = 1U << 20U;
        ResolvedFill fill = checked(
            offset_fill(result_.rings, FillRule::odd_even, distance, left_, {.most = most}));
        if (fill.rings.empty()) {
            char text[80];
            std::snprintf(text, sizeof text, "nothing is left of it by an offset of %.17g",
                          distance);
            fail(text);
        }
        result_.rings = std::move(fill.rings);
        result_.deviation += fill.deviation;
    }

    void take(CleanedRings& cleaned, const std::string& why) {
        note(describe(cleaned, why));
        result_.rings = std::move(cleaned.rings);
        result_.deviation += cleaned.deviation;
    }

    const Outline& outline_;
    const OutlineTreatment& asked_;
    double allowed_ = 0.0;  ///< deviation, of outlines with curves
    double left_ = 0.0;     ///< deviation, of an offset
    ShapeRings result_;
};

}  // namespace

bool needs_deviation(const Outline& outline, const OutlineTreatment& treatment) {
    return outline.curved() || treatment.offset;
}

ShapeRings make_shape_rings(const Outline& outline, double deviation,
                            const OutlineTreatment& treatment) {
    return Treatment(outline, deviation, treatment).run();
}

}  // namespace nearfield::tools
