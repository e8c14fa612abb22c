#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Test shapes: plain and degenerate ones.
namespace nearfield::samples {

using Rings = std::vector<Ring>;

struct NamedRings {
    std::string name;
    Rings rings;
};

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    std::uint32_t below(std::uint32_t end) {
        return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(engine_);
    }

private:
    std::mt19937 engine_;
};

/// A ring around the origin whose vertices have radii between the two values.
inline Ring star(Random& random, std::uint32_t size, double least, double most) {
    Ring ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / size;
        const double radius = random.between(least, most);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

/// A ring around the origin with variation at all scales, like a coast.
inline Ring coast(Random& random, std::uint32_t size, double radius) {
    std::vector<std::pair<double, double>> waves;  // height, phase
    for (std::uint32_t k = 1; k < size / 3; ++k) {
        waves.emplace_back(0.3 / std::pow(k, 1.3), random.between(0.0, 2.0 * std::numbers::pi));
    }
    Ring ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / size;
        double r = 1.0;
        for (std::size_t k = 0; k < waves.size(); ++k) {
            r += waves[k].first * std::sin(static_cast<double>(k + 1) * angle + waves[k].second);
        }
        ring.push_back({radius * r * std::cos(angle), radius * r * std::sin(angle)});
    }
    return ring;
}

/// A bar of width 2 around the origin with thin upward teeth.
inline Ring comb(std::uint32_t teeth) {
    Ring ring{{1.0, -1.0}, {-1.0, -1.0}};
    const double pitch = 2.0 / teeth;
    for (std::uint32_t i = 0; i < teeth; ++i) {
        const double x = -1.0 + pitch * i;
        ring.insert(
            ring.end(),
            {{x, 1.0}, {x + 0.4 * pitch, 1.0}, {x + 0.4 * pitch, -0.9}, {x + 0.99 * pitch, -0.9}});
    }
    return ring;
}

inline Ring rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Rings moved(Rings rings, double x, double y) {
    for (Ring& ring : rings) {
        for (Vector2& v : ring) {
            v = {v.x + x, v.y + y};
        }
    }
    return rings;
}

/// The vertices in random order.
inline Ring tangle(Random& random, std::uint32_t size) {
    Ring ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        ring.push_back({random.between(-1.0, 1.0), random.between(-1.0, 1.0)});
    }
    return ring;
}

/// Repeats every vertex of a ring a few times, and adds collinear vertices to each edge.
inline Ring stuttering(const Ring& ring) {
    Ring result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 a = ring[i];
        const Vector2 b = ring[(i + 1) % ring.size()];
        result.insert(result.end(), 1 + i % 4, a);
        for (int k = 1; k < 4; ++k) {
            result.push_back({a.x + (b.x - a.x) * k / 4.0, a.y + (b.y - a.y) * k / 4.0});
        }
    }
    return result;
}

/// A line that runs back and forth over itself, each time a little shorter, and closes as a sliver.
inline Ring folding(std::uint32_t size) {
    Ring ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double shrink = 1e-3 * i / size;
        ring.push_back({i % 2 == 0 ? -1.0 + shrink : 1.0 - shrink, 1e-4 * i / size});
    }
    return ring;
}

/// Shapes around the origin with a radius of about 1.
inline std::vector<NamedRings> assorted_shapes(Random& random) {
    std::vector<NamedRings> shapes;
    shapes.push_back({"triangle", {{{-1.0, -0.5}, {1.0, -0.5}, {0.0, 1.0}}}});
    shapes.push_back({"sliver", {{{-1.0, 0.0}, {1.0, 1e-7}, {1.0, 0.0}}}});
    shapes.push_back({"star", {star(random, 61, 0.2, 1.0)}});
    shapes.push_back({"coast", {coast(random, 300, 0.7)}});
    shapes.push_back({"comb", {comb(40)}});
    shapes.push_back({"tangle", {tangle(random, 40)}});
    shapes.push_back({"bow tie", {{{-1.0, -1.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}}}});
    shapes.push_back({"stuttering", {stuttering(star(random, 17, 0.4, 1.0))}});
    shapes.push_back({"folding", {folding(60)}});
    shapes.push_back(
        {"spiked", {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.0}, {1.0, 0.0}, {0.5, 0.0}, {0.0, 0.7}}}});
    shapes.push_back({"with a hole", {star(random, 80, 0.8, 1.0), star(random, 50, 0.5, 0.7)}});
    Rings parts;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            parts.push_back(moved({star(random, 9, 0.05, 0.2)}, 0.4 * i, 0.4 * j).front());
        }
    }
    shapes.push_back({"many parts", parts});
    Rings islands;
    while (islands.size() < 50) {
        const std::uint32_t size = 3 + random.below(18);
        const Ring ring = star(random, size, 0.05, 0.2);
        islands.push_back(
            moved({ring}, random.between(-0.9, 0.9), random.between(-0.9, 0.9)).front());
    }
    shapes.push_back({"islands in any order", islands});
    Rings triangles;
    for (int i = 39; i >= 0; --i) {
        const double x = 0.2 * (i % 8) - 0.8;
        const double y = 0.3 * (i / 8) - 0.7;
        triangles.push_back({{x, y}, {x + 0.1, y}, {x, y + 0.2}});
    }
    shapes.push_back({"many rings of few edges", triangles});
    // Three walls on one line: over different intervals an odd number of them or two coincide.
    shapes.push_back({"walls on each other",
                      {rectangle(0.0, 0.0, 0.8, 0.2), rectangle(0.2, 0.0, 1.0, 0.4),
                       rectangle(-0.2, 0.0, 0.6, 0.6)}});
    return shapes;
}

inline geometry::Polygon polygon(const Rings& rings) {
    geometry::Polygon polygon;
    const Status status = polygon.assign(rings);
    if (!status.ok()) {
        throw std::invalid_argument(status.text());
    }
    return polygon;
}

}  // namespace nearfield::samples
