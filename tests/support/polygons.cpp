#include "polygons.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

namespace nearfield::test {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vector2 polar(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vector2 mix(const Vector2& a, const Vector2& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

void append(Rings& rings, const Rings& more) {
    rings.insert(rings.end(), more.begin(), more.end());
}

/// Points between a and b without b, displaced in proportion to the length of the bisected segment.
void displace(Random& random, const Vector2& a, const Vector2& b, int count, double roughness,
              Ring& ring) {
    if (count <= 1) {
        ring.push_back(a);
        return;
    }
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double shift = roughness * length * random.between(-0.5, 0.5);
    const Vector2 between = mix(a, b, random.between(0.4, 0.6));
    const Vector2 middle{between.x - (b.y - a.y) / length * shift,
                         between.y + (b.x - a.x) / length * shift};
    displace(random, a, middle, count / 2, roughness, ring);
    displace(random, middle, b, count - count / 2, roughness, ring);
}

}  // namespace

double Random::between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
}

int Random::whole(int low, int high) {
    return low + static_cast<int>(between(0.0, high - low + 1.0));
}

std::uint32_t Random::below(std::uint32_t end) {
    return static_cast<std::uint32_t>(between(0.0, end));
}

double Random::scale(double low, double high) {
    return low * std::pow(high / low, between(0.0, 1.0));
}

Rings star(Random& random, int n, double inner) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        const double angle = full_turn * (i + random.between(-0.4, 0.4)) / n;
        ring.push_back(polar(random.between(inner, 1.0), angle));
    }
    return {ring};
}

Rings regular(int n) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        ring.push_back(polar(1.0, full_turn * i / n));
    }
    return {ring};
}

Rings spiral(double turns, double width, int n) {
    Ring ring;
    const auto along = [&](int i, double side) {
        const double t = static_cast<double>(i) / (n - 1);
        return polar(0.1 + 0.85 * t + side, full_turn * turns * t);
    };
    for (int i = 0; i < n; ++i) {
        ring.push_back(along(i, width / 2));
    }
    for (int i = n; i-- > 0;) {
        ring.push_back(along(i, -width / 2));
    }
    return {ring};
}

Rings comb(int teeth) {
    Ring ring{{-1.0, -0.8}, {1.0, -0.8}};
    const double pitch = 2.0 / (2 * teeth - 1);
    for (int i = teeth; i-- > 0;) {
        const double left = -1.0 + 2 * i * pitch;
        ring.push_back({left + pitch, i + 1 == teeth ? 0.8 : -0.6});
        if (i + 1 < teeth) {
            ring.push_back({left + pitch, 0.8});
        }
        ring.push_back({left, 0.8});
        if (i > 0) {
            ring.push_back({left, -0.6});
        }
    }
    return {ring};
}

Rings needle(double thickness) {
    return {{{-1.0, 0.0}, {1.0, -thickness / 3}, {0.9, thickness * 2 / 3}}};
}

Rings spiky(Random& random, int spikes) {
    Ring ring;
    for (int i = 0; i < 2 * spikes; ++i) {
        const double angle = full_turn * i / (2 * spikes);
        const Vector2 foot = polar(random.between(0.4, 0.6), angle);
        ring.push_back(foot);
        if (i % 2 == 0) {
            ring.push_back(polar(random.between(0.1, 1.0), angle + random.between(-0.1, 0.1)));
            ring.push_back(foot);
        }
    }
    return {ring};
}

Rings coast(Random& random, int n, double roughness) {
    Ring ring;
    const int corners = std::min(n, 8);
    for (int i = 0; i < corners; ++i) {
        const int count = n / corners + (i < n % corners ? 1 : 0);
        displace(random, polar(0.8, full_turn * i / corners),
                 polar(0.8, full_turn * (i + 1) / corners), count, roughness, ring);
    }
    return {ring};
}

Rings tangle(Random& random, int n) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        ring.push_back({random.between(-1.0, 1.0), random.between(-1.0, 1.0)});
    }
    return {ring};
}

Rings pentagram() {
    Ring ring;
    for (int i = 0; i < 5; ++i) {
        ring.push_back(polar(1.0, full_turn * (2 * i % 5) / 5 + 0.1));
    }
    return {ring};
}

Rings nested_pentagons(int rings) {
    Rings all;
    for (int i = 0; i < rings; ++i) {
        all.push_back(scaled_and_moved(regular(5), 1.0 - 0.95 * i / rings, {}).front());
    }
    return all;
}

Rings bow_tie() {
    return {{{-1.0, -0.5}, {0.0, 0.0}, {1.0, -0.5}, {1.0, 0.5}, {0.0, 0.0}, {-1.0, 0.5}}};
}

Rings with_holes(Random& random, int holes) {
    Rings rings = star(random, 24, 0.85);
    for (int i = 0; i < holes; ++i) {
        const Vector2 centre = polar(0.5, full_turn * i / holes);
        const double radius = i % 3 == 2 ? 1e-3 : 0.9 / (holes + 3);
        append(rings, scaled_and_moved(star(random, random.whole(3, 12), 0.5), radius, centre));
    }
    return rings;
}

Rings several_parts(Random& random, int parts) {
    Rings rings;
    for (int i = 0; i < parts; ++i) {
        const Vector2 centre = polar(0.65, full_turn * i / parts);
        const double radius = std::min(0.35, 1.7 / parts);
        append(rings, scaled_and_moved(star(random, random.whole(5, 30), 0.7), radius, centre));
        if (i % 2 == 0) {
            append(rings, scaled_and_moved(star(random, 8, 0.7), radius * 0.6, centre));
            append(rings, scaled_and_moved(star(random, 5, 0.7), radius * 0.3, centre));
        }
    }
    return rings;
}

Rings rectangle(const Vector2& low, const Vector2& high) {
    return {{low, {high.x, low.y}, high, {low.x, high.y}}};
}

Rings with_repeated_vertices(Random& random, Rings rings, double share) {
    for (Ring& ring : rings) {
        Ring longer;
        for (const Vector2& v : ring) {
            const int times = random.between(0.0, 1.0) < share ? random.whole(2, 4) : 1;
            longer.insert(longer.end(), static_cast<std::size_t>(times), v);
        }
        ring = std::move(longer);
    }
    return rings;
}

Rings with_collinear_runs(Random& random, const Rings& rings, double share) {
    Rings result;
    for (const Ring& ring : rings) {
        Ring longer;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            longer.push_back(ring[i]);
            if (random.between(0.0, 1.0) < share) {
                const int pieces = random.whole(2, 8);
                for (int piece = 1; piece < pieces; ++piece) {
                    const double t = (piece + random.between(-0.4, 0.4)) / pieces;
                    longer.push_back(mix(ring[i], ring[(i + 1) % ring.size()], t));
                }
            }
        }
        result.push_back(std::move(longer));
    }
    return result;
}

Rings scaled_and_moved(Rings rings, double factor, const Vector2& by) {
    for (Ring& ring : rings) {
        for (Vector2& v : ring) {
            v = {v.x * factor + by.x, v.y * factor + by.y};
        }
    }
    return rings;
}

std::vector<NamedRings> every_family(std::uint64_t seed) {
    Random random(seed);
    return {
        {"triangle", star(random, 3, 0.7)},
        {"rectangle", rectangle({-0.8, -0.5}, {0.8, 0.5})},
        {"regular 64-gon", regular(64)},
        {"star of 40", star(random, 40, 0.2)},
        {"star of 500", star(random, 500, 0.6)},
        {"spiral", spiral(3.5, 0.12, 150)},
        {"comb of 12", comb(12)},
        {"comb of 300, finer than a cell", comb(300)},
        {"sliver", needle(0.02)},
        {"needle", needle(1e-6)},
        {"spiky", spiky(random, 9)},
        {"coast of 300", coast(random, 300, 0.5)},
        {"coast of 5000", coast(random, 5000, 0.6)},
        {"tangle", tangle(random, 12)},
        {"pentagram", pentagram()},
        {"bow tie", bow_tie()},
        {"with holes", with_holes(random, 7)},
        {"several parts", several_parts(random, 5)},
        {"repeated vertices", with_repeated_vertices(random, star(random, 30, 0.4), 0.5)},
        {"collinear runs", with_collinear_runs(random, star(random, 12, 0.4), 0.7)},
        {"twice the same part moved", {star(random, 9, 0.5)[0], star(random, 9, 0.5)[0]}},
        {"two parts with a shared edge",
         {rectangle({-0.8, -0.5}, {0.1, 0.5})[0], rectangle({0.1, -0.5}, {0.8, 0.5})[0]}},
    };
}

NamedRings any_shape(Random& random) {
    using Make = std::function<Rings()>;
    const std::vector<std::pair<const char*, Make>> families = {
        {"star", [&] { return star(random, random.whole(3, 200), random.between(0.1, 0.9)); }},
        {"spiral",
         [&] { return spiral(random.between(1.0, 4.0), random.between(0.01, 0.15), 90); }},
        {"comb", [&] { return comb(random.whole(2, 150)); }},
        {"needle", [&] { return needle(random.scale(1e-6, 0.1)); }},
        {"spiky", [&] { return spiky(random, random.whole(3, 15)); }},
        {"coast", [&] { return coast(random, random.whole(20, 3000), random.between(0.2, 0.7)); }},
        {"tangle", [&] { return tangle(random, random.whole(4, 16)); }},
        {"with holes", [&] { return with_holes(random, random.whole(1, 9)); }},
        {"several parts", [&] { return several_parts(random, random.whole(2, 8)); }},
        {"repeated vertices",
         [&] { return with_repeated_vertices(random, star(random, 30, 0.4), 0.3); }},
        {"collinear runs", [&] { return with_collinear_runs(random, star(random, 15, 0.4), 0.5); }},
    };
    const auto& [name, make] =
        families[static_cast<std::size_t>(random.whole(0, static_cast<int>(families.size()) - 1))];
    return {name, make()};
}

std::string to_text(const Rings& rings) {
    std::size_t vertices = 0;
    for (const Ring& ring : rings) {
        vertices += ring.size();
    }
    std::ostringstream text;
    text.precision(17);
    if (vertices > 60) {
        text << rings.size() << " rings, " << vertices << " vertices";
        return text.str();
    }
    text << "POLYGON (";
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        text << (ring == 0 ? "(" : ", (");
        for (const Vector2& v : rings[ring]) {
            text << v.x << ' ' << v.y << ", ";
        }
        text << rings[ring].front().x << ' ' << rings[ring].front().y << ')';
    }
    text << ')';
    return text.str();
}

}  // namespace nearfield::test
