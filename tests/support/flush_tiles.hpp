#pragma once

#include <nearfield/shape.hpp>

#include <tests/support/polygons.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Square tiles in rows and columns, edge to edge, turned and moved as a whole. Where numbers are
/// rounded, neighbours overlap a little or leave a gap: they touch, up to that.
struct FlushTiles {
    double pitch = 1.0;
    double angle = 0.0;
    Vector2 offset = {};
    int side = 12;

    [[nodiscard]] Rings tile() const { return {{{0, 0}, {pitch, 0}, {pitch, pitch}, {0, pitch}}}; }
    /// Column by column.
    [[nodiscard]] std::vector<Pose> poses() const {
        std::vector<Pose> poses;
        for (int column = 0; column < side; ++column) {
            for (int row = 0; row < side; ++row) {
                const double x = column * pitch;
                const double y = row * pitch;
                poses.push_back({{offset.x + std::cos(angle) * x - std::sin(angle) * y,
                                  offset.y + std::sin(angle) * x + std::cos(angle) * y},
                                 angle});
            }
        }
        return poses;
    }
    /// Those that share an edge or a corner, the lower number first, in ascending order.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> neighbours() const {
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        const auto add = [&](int i, int column, int row) {
            if (column < side && row >= 0 && row < side) {
                pairs.emplace_back(i, column * side + row);
            }
        };
        for (int i = 0; i < side * side; ++i) {
            add(i, i / side, i % side + 1);
            add(i, i / side + 1, i % side - 1);
            add(i, i / side + 1, i % side);
            add(i, i / side + 1, i % side + 1);
        }
        return pairs;
    }
};

/// At many pitches, angles and offsets, of which few are exact in binary.
[[nodiscard]] inline std::vector<FlushTiles> many_flush_tiles() {
    std::vector<FlushTiles> all;
    for (const double pitch : {0.1, 1.0 / 3.0, 1e-3, 40.1}) {
        for (const double angle : {0.0, 0.7853981633974483, 2.0}) {
            for (const Vector2 offset :
                 {Vector2{}, Vector2{0.3, -0.7}, Vector2{-1e3 / 7.0, 1e4 / 3.0},
                  Vector2{1e6, -1e6 / 3.0}}) {
                all.push_back({pitch, angle, offset});
            }
        }
    }
    return all;
}

}  // namespace nearfield::test
