#include <tests/support/scanline.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearfield::support {

namespace {

using geometry::Mesh;
using geometry::MeshVertex;

// In sub-pixel steps.
struct GridPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

GridPoint to_grid(double x, double y, const geometry::SubpixelGrid& grid) {
    return {std::llround(grid.snap(x) * grid.steps), std::llround(grid.snap(y) * grid.steps)};
}

GridPoint sample(const geometry::SubpixelGrid& grid, std::int64_t column, std::int64_t row) {
    const auto half = std::llround(grid.steps / 2.0);
    return {(2 * column + 1) * half, (2 * row + 1) * half};
}

// Twice the signed area of (a, b, p).
std::int64_t orientation(const GridPoint& a, const GridPoint& b, const GridPoint& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// For triangles of positive orientation, y downwards: the inside is right of edges that go up, and
// below edges that go right.
bool is_top_or_left(const GridPoint& a, const GridPoint& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

// Pixels whose centre may lie between low and high: first to last, limited to `count`.
std::pair<std::int64_t, std::int64_t> pixel_range(std::int64_t low, std::int64_t high,
                                                  std::uint32_t count, double steps) {
    const double first = std::ceil(static_cast<double>(low) / steps - 0.5);
    const double last = std::floor(static_cast<double>(high) / steps - 0.5);
    return {static_cast<std::int64_t>(std::max(first, 0.0)),
            static_cast<std::int64_t>(std::min(last, count - 1.0))};
}

}  // namespace

void rasterise(const Tile& tile, std::span<const MeshVertex, 3> triangle, const Fragment& visit) {
    std::array<GridPoint, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = to_grid(triangle[i].x, triangle[i].y, tile.grid);
    }
    std::array<std::size_t, 3> order = {0, 1, 2};
    const std::int64_t area = orientation(corners[0], corners[1], corners[2]);
    if (area == 0) {
        return;
    }
    if (area < 0) {
        std::swap(order[1], order[2]);
    }
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto [first_row, last_row] = pixel_range(top, bottom, tile.height, tile.grid.steps);
    const auto [first_column, last_column] = pixel_range(left, right, tile.width, tile.grid.steps);
    for (std::int64_t row = first_row; row <= last_row; ++row) {
        for (std::int64_t column = first_column; column <= last_column; ++column) {
            const GridPoint p = sample(tile.grid, column, row);
            std::array<double, 3> weights;
            bool covered = true;
            for (std::size_t i = 0; i < 3 && covered; ++i) {
                const GridPoint& a = corners[order[(i + 1) % 3]];
                const GridPoint& b = corners[order[(i + 2) % 3]];
                const std::int64_t value = orientation(a, b, p);
                covered = value > 0 || (value == 0 && is_top_or_left(a, b));
                weights[order[i]] =
                    static_cast<double>(value) / static_cast<double>(std::abs(area));
            }
            if (covered) {
                visit(static_cast<std::size_t>(row) * tile.width + static_cast<std::size_t>(column),
                      weights);
            }
        }
    }
}

std::vector<std::uint8_t> draw_parity(const Tile& tile, const Mesh& mesh) {
    std::vector<std::uint8_t> image(std::size_t{tile.width} * tile.height, 0);
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
        rasterise(tile, std::span<const MeshVertex, 3>(&mesh[i], 3),
                  [&image](std::size_t index, const auto&) { image[index] ^= 1U; });
    }
    return image;
}

std::vector<Nearest> draw_nearest(const Tile& tile, const Mesh& mesh) {
    std::vector<Nearest> image(std::size_t{tile.width} * tile.height);
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
        const std::span<const MeshVertex, 3> triangle(&mesh[i], 3);
        rasterise(tile, triangle, [&](std::size_t index, const std::array<double, 3>& weights) {
            double sum = 0.0;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                sum += weights[corner] * static_cast<double>(triangle[corner].distance);
            }
            const auto distance = static_cast<float>(sum);
            if (distance < image[index].distance) {
                image[index] = {.distance = distance, .id = triangle[0].id};
            }
        });
    }
    return image;
}

std::vector<std::uint8_t> scan_parity(const Tile& tile, const Rings& rings) {
    std::vector<std::uint8_t> image(std::size_t{tile.width} * tile.height, 0);
    const auto scan_edge = [&tile, &image](GridPoint low, GridPoint high) {
        if (low.y > high.y) {
            std::swap(low, high);
        }
        const auto [first_row, last_row] = pixel_range(low.y, high.y, tile.height, tile.grid.steps);
        for (std::int64_t row = first_row; row <= last_row; ++row) {
            for (std::int64_t column = 0; column < tile.width; ++column) {
                const GridPoint p = sample(tile.grid, column, row);
                // For upward edges, samples at smaller x have positive orientation.
                if (low.y <= p.y && p.y < high.y && orientation(low, high, p) > 0) {
                    const std::size_t index = static_cast<std::size_t>(row) * tile.width +
                                              static_cast<std::size_t>(column);
                    image[index] ^= 1U;
                }
            }
        }
    };
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const geometry::Vector& a = ring[i];
            const geometry::Vector& b = ring[(i + 1) % ring.size()];
            scan_edge(to_grid(a.x(), a.y(), tile.grid), to_grid(b.x(), b.y(), tile.grid));
        }
    }
    return image;
}

}  // namespace nearfield::support
