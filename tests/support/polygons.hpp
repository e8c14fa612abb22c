#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// \file
/// Shapes to try things on, ordinary and nasty. Everything is a function of a seed. Unless said
/// otherwise a shape lies about the origin and reaches about 1 from it.

namespace nearfield::test {

using Rings = std::vector<Ring>;

/// A seeded source of numbers that gives the same ones with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [low, high).
    double between(double low, double high);
    /// Uniform in [low, high], whole.
    int whole(int low, int high);
    /// Uniform on a logarithmic scale; low > 0.
    double scale(double low, double high);

private:
    std::mt19937_64 engine_;
};

/// A star-shaped polygon of n >= 3 vertices with radii between `inner` and 1.
Rings star(Random& random, int n, double inner);
/// A regular n-gon of radius 1.
Rings regular(int n);
/// A band of width `width` wound `turns` times around the origin, 2 n vertices.
Rings spiral(double turns, double width, int n);
/// A bar with `teeth` narrow teeth and gaps of equal width.
Rings comb(int teeth);
/// A triangle of length 2 and height `thickness`.
Rings needle(double thickness);
/// A star with spikes of no width: lines that go out (or in) and come back the same way.
Rings spiky(Random& random, int spikes);
/// A fractal coast line of n >= 3 vertices: midpoint displacement about a circle. It may cross
/// itself where `roughness` (0 to 1) is high.
Rings coast(Random& random, int n, double roughness);
/// One ring of n random points, crossing itself all over.
Rings tangle(Random& random, int n);
/// The five-pointed star drawn in one line; its middle is outside.
Rings pentagram();
/// Two triangles that meet in one vertex, as one ring.
Rings bow_tie();
/// A star with holes; some are tiny.
Rings with_holes(Random& random, int holes);
/// Separate stars, with some islands in holes.
Rings several_parts(Random& random, int parts);
/// Axis-aligned rectangle.
Rings rectangle(const Vector2& low, const Vector2& high);

/// Repeats a share of the vertices, up to three times each, the first or last of a ring too.
Rings with_repeated_vertices(Random& random, Rings rings, double share);
/// Cuts a share of the edges into runs of up to 8 collinear pieces of uneven length.
Rings with_collinear_runs(Random& random, const Rings& rings, double share);
/// Scaled about the origin, then moved.
Rings scaled_and_moved(Rings rings, double factor, const Vector2& by);

/// A shape and what it is called in a failure's message.
struct NamedRings {
    std::string name;
    Rings rings;
};

/// One of each family above, the same ones for the same seed.
std::vector<NamedRings> every_family(std::uint64_t seed);
/// A shape of a random family and size of vertices.
NamedRings any_shape(Random& random);

/// Rings as WKT, for a failure's message; only the number of vertices where there are many.
std::string to_text(const Rings& rings);

}  // namespace nearfield::test
