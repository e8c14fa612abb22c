#pragma once

#include <nearfield/shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Random and degenerate rings: crossing, overlapping, coinciding, nearly coinciding, with tiny
/// loops, spikes and repeated vertices, near and far from the origin. All coordinates are multiples
/// of a unit, and less than 2^60 of it.
class TangledRings {
public:
    static constexpr int kinds = 12;

    explicit TangledRings(std::uint64_t seed) : random_(seed) {}

    std::vector<Ring> make(int kind) {
        std::vector<Ring> rings = make_exactly(kind);
        double largest = 0.0;
        for (const Ring& ring : rings) {
            for (const Vector2& vertex : ring) {
                largest = std::max({largest, std::abs(vertex.x), std::abs(vertex.y)});
            }
        }
        unit_ = std::ldexp(1.0, std::ilogb(std::max(largest, 1e-3)) - 59);
        for (Ring& ring : rings) {
            for (Vector2& vertex : ring) {
                vertex = {quantized(vertex.x), quantized(vertex.y)};
            }
        }
        return rings;
    }

    /// The unit of the rings that were made last.
    [[nodiscard]] double unit() const { return unit_; }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

private:
    [[nodiscard]] double quantized(double value) const {
        return std::nearbyint(value / unit_) * unit_;
    }

    std::vector<Ring> make_exactly(int kind) {
        switch (kind) {
            case 0:
                return several([this] { return polygon(1e6); });
            case 1:
                return several([this] { return on_small_grid(); });
            case 2:
                return several([this] { return rectangle(); });
            case 3:
                return seams();
            case 4:
                return with_tiny_loops();
            case 5:
                return moved(several([this] { return polygon(whole(0, 1) == 0 ? 1.0 : 1e-4); }),
                             uniform(-1e6, 1e6), uniform(-1e6, 1e6));
            case 6:
                return several([this] { return with_spikes(polygon(10.0)); });
            case 7:
                return {star(), star()};
            case 8:
                return several([this] { return thin(); });
            case 9:
                return repeated(several([this] { return polygon(1e3); }));
            case 10:
                return nearly_repeated(several([this] { return polygon(1e3); }));
            default:
                return several([this] { return near_cells(); });
        }
    }

    template <class Make>
    std::vector<Ring> several(const Make& make) {
        std::vector<Ring> rings(static_cast<std::size_t>(whole(1, 4)));
        for (Ring& ring : rings) {
            ring = make();
        }
        return rings;
    }

    Ring polygon(double size) {
        Ring ring(static_cast<std::size_t>(whole(3, 9)));
        for (Vector2& vertex : ring) {
            vertex = {uniform(-size, size), uniform(-size, size)};
        }
        return ring;
    }

    Ring on_small_grid() {
        Ring ring(static_cast<std::size_t>(whole(1, 10)));
        const double step = whole(0, 1) == 0 ? 1.0 : 1e5;
        for (Vector2& vertex : ring) {
            vertex = {step * whole(0, 4), step * whole(0, 4)};
        }
        return ring;
    }

    Ring rectangle() {
        const double x = whole(0, 4);
        const double y = whole(0, 4);
        const double to_x = x + whole(0, 3);
        const double to_y = y + whole(0, 3);
        return whole(0, 1) == 0 ? Ring{{x, y}, {to_x, y}, {to_x, to_y}, {x, to_y}}
                                : Ring{{x, y}, {x, to_y}, {to_x, to_y}, {to_x, y}, {x, y}};
    }

    /// Parts on both sides of a slanted line, with vertices on it that rounding moves off it.
    std::vector<Ring> seams() {
        const Vector2 a{uniform(-100, 100), uniform(-100, 100)};
        const Vector2 b{uniform(-100, 100), uniform(-100, 100)};
        const auto side = [&](double way) {
            Ring ring{a};
            for (int i = whole(0, 4), part = 0; part < i; ++part) {
                const double at = (part + uniform(0.0, 1.0)) / i;
                ring.push_back({a.x + at * (b.x - a.x), a.y + at * (b.y - a.y)});
            }
            ring.push_back(b);
            const double out = way * uniform(0.1, 1.0);
            ring.push_back({b.x - out * (b.y - a.y), b.y + out * (b.x - a.x)});
            ring.push_back({a.x - out * (b.y - a.y), a.y + out * (b.x - a.x)});
            return ring;
        };
        return {side(1.0), side(-1.0), side(whole(0, 1) == 0 ? 1.0 : -1.0)};
    }

    std::vector<Ring> with_tiny_loops() {
        std::vector<Ring> rings = several([this] { return polygon(1e6); });
        const std::vector<Ring> large = rings;
        for (const Ring& ring : large) {
            const double size = std::exp2(-whole(0, 38));
            const Vector2 at = ring[static_cast<std::size_t>(whole(0, 2))];
            rings.push_back(moved({polygon(size)}, at.x, at.y).front());
        }
        return rings;
    }

    static std::vector<Ring> moved(std::vector<Ring> rings, double x, double y) {
        for (Ring& ring : rings) {
            for (Vector2& vertex : ring) {
                vertex = {vertex.x + x, vertex.y + y};
            }
        }
        return rings;
    }

    Ring with_spikes(const Ring& ring) {
        Ring result;
        for (const Vector2& vertex : ring) {
            result.push_back(vertex);
            switch (whole(0, 4)) {
                case 0:
                    result.push_back(vertex);
                    break;
                case 1:
                    result.push_back({uniform(-10, 10), uniform(-10, 10)});
                    result.push_back(vertex);
                    break;
                case 2:
                    result.push_back({vertex.x + uniform(-1, 1), vertex.y + uniform(-1, 1)});
                    result.push_back({vertex.x + uniform(-1e-11, 1e-11), vertex.y});
                    break;
                default:
                    break;
            }
        }
        return result;
    }

    /// Edges that cross near one point, many of them exactly there.
    Ring star() {
        Ring ring;
        const double step = std::numbers::pi / whole(2, 8);
        for (int i = 0; i < 8; ++i) {
            const double radius = whole(0, 1) == 0 ? 8.0 : uniform(1, 8);
            const double angle = step * i;
            ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
            ring.push_back({-radius * std::cos(angle), -radius * std::sin(angle)});
        }
        return ring;
    }

    /// A long polygon that is hardly wider than a cell.
    Ring thin() {
        const double slope = uniform(-1, 1);
        const double width = std::exp2(-whole(28, 40));
        Ring ring;
        for (int i = whole(2, 5); i >= 0; --i) {
            const double x = uniform(-16, 16);
            ring.push_back({x, slope * x + uniform(-width, width)});
        }
        return ring;
    }

    /// Rings given twice, in either orientation, some of them beginning elsewhere.
    std::vector<Ring> repeated(std::vector<Ring> rings) {
        const std::size_t count = rings.size();
        for (std::size_t i = 0; i < count; ++i) {
            Ring copy = rings[i];
            if (whole(0, 1) == 0) {
                copy = Ring(copy.rbegin(), copy.rend());
            }
            copy.push_back(copy.front());
            rings.push_back(std::move(copy));
        }
        return rings;
    }

    std::vector<Ring> nearly_repeated(std::vector<Ring> rings) {
        rings = repeated(std::move(rings));
        const double by = std::exp2(-whole(28, 40));
        for (Ring& ring : rings) {
            for (Vector2& vertex : ring) {
                vertex = {vertex.x + by * whole(-1, 1), vertex.y + by * whole(-1, 1)};
            }
        }
        return rings;
    }

    /// Vertices at corners, middles and inner points of cells of a size near the finest grid's.
    Ring near_cells() {
        const double cell = std::exp2(-whole(26, 36));
        Ring ring(static_cast<std::size_t>(whole(3, 8)));
        for (Vector2& vertex : ring) {
            vertex = {whole(0, 20) * 0.25 * cell, whole(0, 20) * 0.25 * cell};
        }
        if (whole(0, 1) == 0) {
            ring[0] = {uniform(4000, 8000), uniform(-8000, 8000)};
        }
        if (whole(0, 1) == 0) {
            ring[1] = {uniform(-8000, -4000), uniform(-8000, 8000)};
        }
        return ring;
    }

    std::mt19937_64 random_;
    double unit_ = 1.0;
};

}  // namespace nearfield::test
