#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// \file Test shapes, ordinary and degenerate. Each is determined by a seed. Unless noted, a shape
/// is centred on the origin with a radius of about 1.

namespace nearfield::test {

using Rings = std::vector<Ring>;

/// A seeded random number generator that is identical with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [low, high).
    double between(double low, double high);
    /// An integer, uniform in [low, high].
    int whole(int low, int high);
    /// An integer, uniform in [0, end).
    std::uint32_t below(std::uint32_t end);
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
/// A star with zero-width spikes: lines that go out (or in) and return the same way.
Rings spiky(Random& random, int spikes);
/// A fractal coast line of n >= 3 vertices: midpoint displacement about a circle. It may cross
/// itself if `roughness` (0 to 1) is high.
Rings coast(Random& random, int n, double roughness);
/// One ring of n random points with many self-crossings.
Rings tangle(Random& random, int n);
/// The five-pointed star drawn in one line; its middle is outside.
Rings pentagram();
/// Regular pentagons inside each other: boxes do not tell their edges apart.
Rings nested_pentagons(int rings);
/// Two triangles that share one vertex, as one ring.
Rings bow_tie();
/// A star with holes; some are tiny.
Rings with_holes(Random& random, int holes);
/// Separate stars, with some islands in holes.
Rings several_parts(Random& random, int parts);
/// Axis-aligned rectangle.
Rings rectangle(const Vector2& low, const Vector2& high);

/// Repeats a fraction of the vertices up to three times each, including the first or last of a
/// ring.
Rings with_repeated_vertices(Random& random, Rings rings, double share);
/// Divides a fraction of the edges into up to 8 collinear pieces of uneven length.
Rings with_collinear_runs(Random& random, const Rings& rings, double share);
/// Scaled about the origin, then moved.
Rings scaled_and_moved(Rings rings, double factor, const Vector2& by);

/// A shape and its name in failure messages.
struct NamedRings {
    std::string name;
    Rings rings;
};

/// One of each family above, the same ones for the same seed.
std::vector<NamedRings> every_family(std::uint64_t seed);
/// A shape of a random family and number of vertices.
NamedRings any_shape(Random& random);

/// Rings as WKT for failure messages; only the number of vertices if there are many.
std::string to_text(const Rings& rings);

}  // namespace nearfield::test
