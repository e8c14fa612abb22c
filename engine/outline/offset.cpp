#include <engine/base/catch_to_status.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/fill.hpp>
#include <nearfield/portable_math.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace nearfield {
namespace {

/// What a ring with the region to its left grows by: a rectangle to the right of each edge and a
/// sector of a disc at each vertex. All run counter-clockwise and lie within the radius of the
/// ring. Neighbours have the vertices they share in common, bit for bit.
class GrowingPieces {
public:
    GrowingPieces(double radius, double sagitta, std::uint32_t most)
        : radius_(radius), most_(most) {
        const double ratio = std::min(sagitta / radius, 1.0 - std::numbers::sqrt2 / 2.0);
        // Half a step of the arc; 1 - cos(h) = 2 sin^2(h / 2), which stays exact for small ratios.
        step_ = 4.0 * geometry::arc_sine(std::sqrt(ratio / 2.0));
    }

    void add(const Ring& ring) {
        const std::size_t count = ring.size();
        std::vector<Vector2> normals(count);
        for (std::size_t i = 0; i < count; ++i) {
            normals[i] = outward(ring[i], ring[(i + 1) % count]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t next = (i + 1) % count;
            const Vector2& a = ring[i];
            const Vector2& b = ring[next];
            add_piece({a, beside(a, normals[i]), beside(b, normals[i]), b});
            add_sector(b, normals[i], normals[next]);
        }
    }

    [[nodiscard]] std::vector<Ring> take() { return std::move(pieces_); }

private:
    static Vector2 outward(const Vector2& a, const Vector2& b) {
        const double x = b.x - a.x;
        const double y = b.y - a.y;
        const double length = geometry::Vector(x, y).stableNorm();
        return {y / length, -x / length};
    }

    [[nodiscard]] Vector2 beside(const Vector2& at, const Vector2& direction) const {
        return {at.x + radius_ * direction.x, at.y + radius_ * direction.y};
    }

    void add_piece(Ring piece) {
        count_ += piece.size();
        if (count_ > most_) {
            throw StatusException({StatusCode::too_large, "the offset needs more than " +
                                                              std::to_string(most_) + " vertices"});
        }
        pieces_.push_back(std::move(piece));
    }

    void add_sector(const Vector2& at, const Vector2& first, const Vector2& last) {
        const double sine = first.x * last.y - first.y * last.x;
        const double cosine = first.x * last.x + first.y * last.y;
        double turn = arc_tangent(sine, cosine);
        if (turn == 0.0) {
            return;  // the rectangles have a side in common
        }
        constexpr double nearly_straight = 0.1;
        if (turn < 0.0) {
            // The rectangles overlap, but where the ring hardly turns rounding could leave a slit.
            if (turn > -nearly_straight) {
                add_piece({at, beside(at, last), beside(at, first)});
            }
            return;
        }
        const auto steps = static_cast<std::size_t>(std::ceil(turn / step_));
        Ring sector{at, beside(at, first)};
        for (std::size_t i = 1; i < steps; ++i) {
            const double angle = turn * static_cast<double>(i) / static_cast<double>(steps);
            const auto [s, c] = sine_cosine(angle);
            sector.push_back(beside(at, {c * first.x - s * first.y, s * first.x + c * first.y}));
            if (sector.size() > most_) {
                break;  // refused by add_piece
            }
        }
        sector.push_back(beside(at, last));
        add_piece(std::move(sector));
    }

    double radius_;
    std::uint32_t most_;
    double step_ = 0.0;
    std::size_t count_ = 0;
    std::vector<Ring> pieces_;
};

ResolvedFill taken(Expected<ResolvedFill> fill) {
    if (!fill.has_value()) {
        throw StatusException(fill.error());
    }
    return std::move(*fill);
}

void check_offset(double distance, double deviation) {
    if (!(std::abs(distance) <= largest_coordinate)) {
        geometry::refuse_shape("the offset is " + geometry::number(distance) +
                               "; it must be finite and at most " +
                               geometry::number(largest_coordinate));
    }
    if (!(deviation > 0.0 && deviation <= largest_coordinate)) {
        geometry::refuse_shape("the deviation of the offset is " + geometry::number(deviation) +
                               "; it must be above 0 and at most " +
                               geometry::number(largest_coordinate));
    }
}

void require_deviation(double deviation, double least) {
    if (least > deviation) {
        geometry::refuse_shape("the deviation " + geometry::number(deviation) +
                               " is below that of the offset, " + geometry::number(least));
    }
}

ResolvedFill offset(std::span<const Ring> rings, FillRule rule, double distance, double deviation,
                    const FillSettings& settings) {
    check_offset(distance, deviation);
    ResolvedFill region = taken(resolve_fill(rings, rule, settings));
    require_deviation(deviation, region.deviation);
    if (distance == 0.0 || region.rings.empty()) {
        return region;
    }
    const double radius = std::abs(distance);
    const double magnitude = std::max(radius, geometry::largest_coordinate_of(region.rings));
    const double sagitta = 0.5 * deviation;
    // Of the region, the arcs and the vertices of pieces.
    const double before = region.deviation + sagitta + 0x1p-48 * magnitude;
    require_deviation(deviation, before + region.deviation);  // the second grid is no finer
    const bool grows = distance > 0.0;
    GrowingPieces growing(radius, sagitta, settings.most);
    for (const Ring& ring : region.rings) {
        // To shrink, what is outside grows.
        growing.add(grows ? ring : Ring(ring.rbegin(), ring.rend()));
    }
    std::vector<Ring> all = growing.take();
    if (!grows) {
        for (Ring& piece : all) {
            std::reverse(piece.begin(), piece.end());
        }
    }
    all.insert(all.end(), region.rings.begin(), region.rings.end());
    ResolvedFill result = taken(resolve_fill(all, FillRule::positive, settings));
    result.deviation += before;
    require_deviation(deviation, result.deviation);
    return result;
}

}  // namespace

Expected<ResolvedFill> offset_fill(std::span<const Ring> rings, FillRule rule, double distance,
                                   double deviation, const FillSettings& settings) {
    return catch_to_expected([&] { return offset(rings, rule, distance, deviation, settings); });
}

}  // namespace nearfield
