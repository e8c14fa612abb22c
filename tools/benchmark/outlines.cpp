#include <nearfield/portable_math.hpp>

#include <tools/benchmark/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::benchmark {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vector2 polar(double radius, double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {radius * cosine, radius * sine};
}

double share(std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

/// Periodic piecewise linear interpolation of random heights at a fraction of a full turn.
double noise_at(const std::vector<double>& heights, double turn) {
    const double place = turn * static_cast<double>(heights.size());
    const auto before = static_cast<std::size_t>(place) % heights.size();
    const double t = place - std::floor(place);
    return std::lerp(heights[before], heights[(before + 1) % heights.size()], t);
}

/// The centre line of a link at t in [0, 1], offset to its left by `side`.
Vector2 link_point(double t, double side) {
    constexpr double arc = 200.0 / 360.0 * full_turn;
    if (t < 0.5) {  // the left hook, clockwise over the top: its left is outward
        const Vector2 p = polar(1.0 + side, arc * (1.0 - 2.0 * t));
        return {p.x - 1.0, p.y};
    }
    const Vector2 p = polar(1.0 - side, full_turn / 2.0 + arc * (2.0 * t - 1.0));
    return {p.x + 1.0, p.y};
}

}  // namespace

Ring coast(std::uint64_t seed, std::size_t n) {
    std::vector<double> radii(n, 1.0);
    double amplitude = 0.2;
    Random random(seed);
    for (std::size_t heights = 6; heights <= n; heights *= 2) {
        std::vector<double> octave(heights);
        for (double& height : octave) {
            height = random.between(-amplitude, amplitude);
        }
        for (std::size_t i = 0; i < n; ++i) {
            radii[i] += noise_at(octave, share(i, n));
        }
        amplitude *= 0.55;
    }
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        ring.push_back(polar(radii[i], full_turn * share(i, n)));
    }
    return ring;
}

Ring gear(std::size_t teeth) {
    struct Corner {
        double part;
        double radius;
    };
    constexpr Corner corners[] = {{0.0, 0.75}, {0.2, 1.0}, {0.45, 1.0}, {0.65, 0.75}};
    Ring ring;
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
        for (const Corner& corner : corners) {
            const double turn =
                (static_cast<double>(tooth) + corner.part) / static_cast<double>(teeth);
            ring.push_back(polar(corner.radius, full_turn * turn));
        }
    }
    return ring;
}

Ring link(std::size_t n) {
    constexpr double half_width = 0.2;
    const std::size_t left = n - n / 2;
    const std::size_t right = n / 2;
    Ring ring;
    for (std::size_t i = 0; i < left; ++i) {
        ring.push_back(link_point(share(i, left - 1), half_width));
    }
    for (std::size_t i = right; i-- > 0;) {
        ring.push_back(link_point(share(i, right - 1), -half_width));
    }
    return ring;
}

Ring car(std::size_t n) {
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2 p = polar(1.0, full_turn * (share(i, n) + 0.5 / static_cast<double>(n)));
        const double x = p.x * p.x;
        const double y = 4.0 * p.y * p.y;
        const double radius = 1.0 / std::sqrt(std::sqrt(x * x + y * y));
        ring.push_back({radius * p.x, radius * p.y});
    }
    return ring;
}

Ring wavy_bar(std::size_t n, double back, double shift) {
    constexpr double length = 4.0;
    constexpr double waves = 5.0;
    constexpr double amplitude = 0.2;
    Ring ring{{0.0, back}, {length, back}};
    const std::size_t count = n - 2;
    for (std::size_t i = count; i-- > 0;) {
        const double along = share(i, count - 1);
        ring.push_back(
            {length * along, shift + amplitude * sine_cosine(full_turn * waves * along).sine});
    }
    return ring;
}

Ring star(Random& random, std::size_t n) {
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        ring.push_back(polar(random.between(0.6, 1.0), full_turn * share(i, n)));
    }
    return ring;
}

Ring refined(Random& random, const Ring& ring, std::size_t factor) {
    constexpr double steepest = 0.1;
    Ring finer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 from = ring[i];
        const Vector2 to = ring[(i + 1) % ring.size()];
        for (std::size_t piece = 0; piece < factor; ++piece) {
            const double t = share(piece, factor);
            const double aside = random.between(-steepest, steepest) * std::min(t, 1.0 - t);
            finer.push_back({std::lerp(from.x, to.x, t) - aside * (to.y - from.y),
                             std::lerp(from.y, to.y, t) + aside * (to.x - from.x)});
        }
    }
    return finer;
}

}  // namespace nearfield::benchmark
