#include <tests/support/degenerate_polygons.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace nearfield::support {

namespace {

using geometry::Vector;
using Ring = std::vector<Vector>;

class Generator {
public:
    Generator(std::uint32_t width, std::uint32_t height, std::uint32_t seed)
        : width_(width), height_(height), random_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    std::size_t count(std::size_t low, std::size_t high) {
        return std::uniform_int_distribution<std::size_t>(low, high)(random_);
    }
    // A random point in the tile scaled about its centre.
    Vector point(double scale) {
        return centre() + scale * Vector(uniform(-0.5, 0.5) * width_, uniform(-0.5, 0.5) * height_);
    }
    [[nodiscard]] Vector centre() const { return {0.5 * width_, 0.5 * height_}; }

    Ring soup(std::size_t size, double scale) {
        Ring ring(size);
        std::generate(ring.begin(), ring.end(), [&] { return point(scale); });
        return ring;
    }
    // Radii as fractions of half the tile's smaller side.
    Ring star(std::size_t size, double least, double most) {
        Ring ring;
        for (std::size_t i = 0; i < size; ++i) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size);
            const double radius = 0.5 * std::min(width_, height_) * uniform(least, most);
            ring.push_back(centre() + radius * Vector(std::cos(angle), std::sin(angle)));
        }
        return ring;
    }
    // Teeth from a fraction of a sub-pixel step to several cells wide, with zero-width tips.
    Ring comb() {
        Ring ring = {{0.1 * width_, 0.1 * height_}};
        double x = 0.1 * width_;
        while (x < 0.9 * width_) {
            ring.emplace_back(x, 0.9 * height_);
            x += std::exp2(uniform(-11.0, 1.0));
            ring.emplace_back(x, 0.9 * height_);
            ring.emplace_back(x, 0.1 * height_ + 1e-3);
            x += std::exp2(uniform(-11.0, 1.0));
            ring.emplace_back(x, 0.1 * height_ + 1e-3);
        }
        ring.emplace_back(x, 0.1 * height_);
        return ring;
    }
    // Every vertex, or only its y, on a pixel centre; with many horizontal and vertical edges.
    Ring on_centres(bool x_too) {
        Ring ring = {point(1.2)};
        for (std::size_t i = count(3, 40); i > 0; --i) {
            const Vector next = point(1.2);
            ring.emplace_back(ring.back().x(), next.y());
            ring.emplace_back(next.x(), count(0, 1) == 0 ? next.y() : ring.back().y());
        }
        for (Vector& vertex : ring) {
            vertex.y() = std::floor(vertex.y()) + 0.5;
            vertex.x() = x_too ? std::floor(vertex.x()) + 0.5 : vertex.x();
        }
        return ring;
    }
    // A star with repeated vertices, runs of collinear vertices, and spikes out and back.
    Ring disturbed() {
        Ring ring;
        const Ring plain = star(count(4, 20), 0.2, 1.0);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            const Vector& a = plain[i];
            const Vector& b = plain[(i + 1) % plain.size()];
            ring.push_back(a);
            switch (count(0, 4)) {
                case 0:
                    ring.insert(ring.end(), 2, a);
                    break;
                case 1:
                    for (const double t : {0.25, 0.5, 0.75}) {
                        ring.push_back(a + t * (b - a));
                    }
                    break;
                case 2:
                    ring.push_back(point(1.0));
                    ring.push_back(a);
                    break;
                case 3:
                    ring.push_back(a + Vector(1e-9, 0.0));
                    break;
                default:
                    break;
            }
        }
        return ring;
    }
    Ring sliver() {
        const Vector a = point(1.0);
        const Vector b = point(1.0);
        return {a, b, b + Vector(uniform(-1e-2, 1e-2), uniform(-1e-2, 1e-2))};
    }
    Ring moved(Ring ring, double x, double y) {
        for (Vector& vertex : ring) {
            vertex += Vector(x * width_, y * height_);
        }
        return ring;
    }
    // Some in the tile, some beside it, in any order; with too many vertices for brute force.
    std::vector<Ring> islands() {
        std::vector<Ring> rings;
        for (std::size_t i = count(32, 60); i > 0; --i) {
            rings.push_back(
                moved(star(count(3, 20), 0.02, 0.3), uniform(-0.6, 0.6), uniform(-0.6, 0.6)));
        }
        return rings;
    }
    Ring around() {
        return {{-2.0 * width_, -3.0 * height_},
                {3.0 * width_, -2.0 * height_},
                {4.0 * width_, 3.0 * height_},
                {-width_, 4.0 * height_}};
    }

private:
    double width_;
    double height_;
    std::mt19937 random_;
};

std::vector<DegeneratePolygon> named(std::vector<DegeneratePolygon> polygons, std::uint32_t width,
                                     std::uint32_t height, std::uint32_t seed) {
    for (DegeneratePolygon& polygon : polygons) {
        polygon.name += " " + std::to_string(width) + "x" + std::to_string(height) + " seed " +
                        std::to_string(seed);
    }
    return polygons;
}

}  // namespace

std::vector<DegeneratePolygon> degenerate_polygons(std::uint32_t width, std::uint32_t height,
                                                   std::uint32_t seed) {
    Generator make(width, height, seed);
    return named({{"soup", {make.soup(make.count(3, 40), 1.0)}},
                  {"big soup", {make.soup(make.count(3, 20), 3.0)}},
                  {"star", {make.star(make.count(5, 200), 0.1, 1.0)}},
                  {"round", {make.star(make.count(50, 300), 0.7999, 0.8)}},
                  {"comb", {make.comb()}},
                  {"rows", {make.on_centres(false)}},
                  {"centres", {make.on_centres(true)}},
                  {"disturbed", {make.disturbed()}},
                  {"sliver", {make.sliver()}},
                  {"holes", {make.star(30, 0.8, 1.2), make.star(9, 0.2, 0.5), make.sliver()}},
                  {"tiny", {make.soup(5, 1e-4), make.soup(5, 1e-2)}},
                  {"around", {make.around()}},
                  {"around with hole", {make.around(), make.star(12, 0.3, 0.9)}},
                  {"right", {make.moved(make.star(20, 0.3, 1.0), 1.2, 0.0)}},
                  {"left", {make.moved(make.star(20, 0.3, 1.0), -1.2, 0.0)}},
                  {"below", {make.moved(make.star(20, 0.3, 1.0), 0.3, -1.1)}},
                  {"above", {make.moved(make.star(20, 0.3, 1.0), 0.0, 1.1)}},
                  {"islands", make.islands()}},
                 width, height, seed);
}

std::vector<DegeneratePolygon> huge_polygons(std::uint32_t width, std::uint32_t height,
                                             std::uint32_t seed) {
    Generator make(width, height, seed);
    const double scale = 2e6 / std::max(width, height);
    Ring mixed = make.soup(10, 1.0);
    for (std::size_t i = 0; i < mixed.size(); i += 2) {
        mixed[i] = make.point(scale);
    }
    return named(
        {{"huge soup", {make.soup(6, scale)}},
         {"huge and small", {mixed}},
         {"fan to afar", {make.moved(make.star(40, 0.5 * scale, 0.5 * scale), 0.01, 0.0)}}},
        width, height, seed);
}

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
    const Vector along = b - a;
    const double squared_length = along.squaredNorm();
    const double parameter =
        squared_length > 0.0 ? std::clamp((p - a).dot(along) / squared_length, 0.0, 1.0) : 0.0;
    return (p - (a + parameter * along)).norm();
}

}  // namespace nearfield::support
