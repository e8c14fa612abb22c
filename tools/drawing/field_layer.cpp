#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Marching squares. A crossing is identified by its lattice edge: the edge from node n to the
/// right is 2n, the edge to the next row 2n + 1. Each crossing is linked to at most two others, one
/// in each cell beside its edge.
class Tracer {
public:
    Tracer(const Lattice& lattice, double level)
        : lattice_(lattice),
          level_(level),
          links_(2 * lattice.width * lattice.height, {none, none}) {}

    std::vector<std::vector<Vector2>> trace() {
        for (std::size_t row = 0; row + 1 < lattice_.height; ++row) {
            for (std::size_t column = 0; column + 1 < lattice_.width; ++column) {
                link_cell(column, row);
            }
        }
        // Open lines first, from an end; the remaining lines are closed.
        for (const bool closed : {false, true}) {
            for (std::size_t crossing = 0; crossing < links_.size(); ++crossing) {
                if (links_[crossing][0] != none && (closed || links_[crossing][1] == none)) {
                    follow(crossing);
                }
            }
        }
        return std::move(lines_);
    }

private:
    [[nodiscard]] bool above(std::size_t column, std::size_t row) const {
        return lattice_.at(column, row) >= level_;
    }

    void link(std::size_t from, std::size_t to) {
        links_[from][links_[from][0] == none ? 0 : 1] = to;
        links_[to][links_[to][0] == none ? 0 : 1] = from;
    }

    void link_cell(std::size_t column, std::size_t row) {
        const bool corners[4] = {above(column, row), above(column + 1, row),
                                 above(column + 1, row + 1), above(column, row + 1)};
        const std::size_t node = row * lattice_.width + column;
        const std::size_t edges[4] = {2 * node, 2 * (node + 1) + 1, 2 * (node + lattice_.width),
                                      2 * node + 1};
        std::size_t crossed[4] = {};
        std::size_t count = 0;
        for (std::size_t side = 0; side < 4; ++side) {
            if (corners[side] != corners[(side + 1) % 4]) {
                crossed[count++] = edges[side];
            }
        }
        if (count == 2) {
            link(crossed[0], crossed[1]);
        } else if (count == 4) {
            // A saddle: the value at the centre decides which two opposite corners are connected.
            const double middle =
                (lattice_.at(column, row) + lattice_.at(column + 1, row) +
                 lattice_.at(column + 1, row + 1) + lattice_.at(column, row + 1)) /
                4.0;
            const bool first_corner_alone = (middle >= level_) != corners[0];
            link(edges[0], edges[first_corner_alone ? 3 : 1]);
            link(edges[2], edges[first_corner_alone ? 1 : 3]);
        }
    }

    [[nodiscard]] Vector2 point(std::size_t crossing) const {
        const std::size_t node = crossing / 2;
        const std::size_t column = node % lattice_.width;
        const std::size_t row = node / lattice_.width;
        const bool down = crossing % 2 == 1;
        const double from = lattice_.at(column, row);
        const double to = lattice_.at(column + (down ? 0 : 1), row + (down ? 1 : 0));
        const double along = (level_ - from) / (to - from);
        return {static_cast<double>(column) + (down ? 0.0 : along),
                static_cast<double>(row) + (down ? along : 0.0)};
    }

    /// Follows the links from crossing to crossing and removes them.
    void follow(std::size_t crossing) {
        std::vector<Vector2> line;
        std::size_t next = crossing;
        while (next != none) {
            const std::size_t here = next;
            line.push_back(point(here));
            next = links_[here][0] != none ? links_[here][0] : links_[here][1];
            if (next != none) {
                unlink(here, next);
                unlink(next, here);
            }
        }
        lines_.push_back(std::move(line));
    }

    void unlink(std::size_t from, std::size_t to) {
        auto& [first, second] = links_[from];
        if (first == to) {
            first = second;
        }
        second = none;
    }

    const Lattice& lattice_;
    double level_;
    std::vector<std::array<std::size_t, 2>> links_;
    std::vector<std::vector<Vector2>> lines_;
};

}  // namespace

std::vector<std::vector<Vector2>> contour_lines(const Lattice& lattice, double level) {
    return Tracer(lattice, level).trace();
}

namespace {

constexpr double arrow_spacing = 46.0;  // pixels
constexpr double arrow_length = 30.0;

Vector2 gradient_at(const DistanceFieldResult& field, std::size_t cell) {
    return {static_cast<double>(field.gradients[2 * cell]),
            static_cast<double>(field.gradients[2 * cell + 1])};
}

/// The cell that contains a point in world coordinates, or the nearest cell.
std::size_t cell_at(const DistanceFieldResult& field, Vector2 world) {
    const auto along = [&](double coordinate, double origin, std::uint32_t count) {
        return static_cast<std::size_t>(std::clamp(std::floor((coordinate - origin) / field.cell),
                                                   0.0, static_cast<double>(count - 1)));
    };
    return along(world.y, field.origin.y, field.height) * field.width +
           along(world.x, field.origin.x, field.width);
}

/// The part of a view's page rectangle that a field covers, in whole pixels.
Rectangle covered_page(const DistanceFieldResult& field, const View& view) {
    const Vector2 high{field.origin.x + field.cell * field.width,
                       field.origin.y + field.cell * field.height};
    const Vector2 low_corner = view.to_page(field.origin);
    const Vector2 high_corner = view.to_page(high);
    return {{std::max(view.page().min.x, std::floor(low_corner.x)),
             std::max(view.page().min.y, std::floor(high_corner.y))},
            {std::min(view.page().max.x, std::ceil(high_corner.x)),
             std::min(view.page().max.y, std::ceil(low_corner.y))}};
}

/// Draws every cell of a field in its own colour. `color` takes the index of the cell in the
/// result's arrays.
void draw_cells(Canvas& canvas, const DistanceFieldResult& field, const View& view,
                const std::function<Color(std::size_t)>& color) {
    const Rectangle page = covered_page(field, view);
    const auto width = static_cast<int>(std::max(page.max.x - page.min.x, 0.0));
    const auto height = static_cast<int>(std::max(page.max.y - page.min.y, 0.0));
    std::vector<std::uint32_t> pixels;
    pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const Vector2 world =
                view.to_world({page.min.x + column + 0.5, page.min.y + row + 0.5});
            pixels.push_back(pixel_of(color(cell_at(field, world))));
        }
    }
    canvas.image(pixels, width, height, page.min);
}

}  // namespace

Color feature_color(Feature feature) {
    // Positions along the boundary in order: a vertex, its edge, the next vertex. Golden-ratio
    // steps keep neighbouring features far apart on the hue circle.
    const bool vertex = feature.kind == Feature::Kind::vertex;
    const double place = 2.0 * feature.index + (vertex ? 0.0 : 1.0);
    const double hue = std::fmod(place * (std::numbers::phi - 1.0), 1.0);
    return vertex ? hue_color(hue, 0.06, 0.90) : hue_color(hue, 0.11, 0.72);
}

void draw_voronoi(Canvas& canvas, const DistanceFieldResult& field, const View& view) {
    draw_cells(canvas, field, view,
               [&](std::size_t cell) { return feature_color(field.features[cell]); });
}

Color direction_color(Vector2 direction) {
    const double length = std::min(std::hypot(direction.x, direction.y), 1.0);
    const double turns = std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi);
    return hue_color(turns, 0.10 * length, 0.82);
}

void draw_gradient_arrow(Canvas& canvas, Vector2 middle, Vector2 direction) {
    // The page's y axis points down.
    const Vector2 half{0.5 * arrow_length * direction.x, -0.5 * arrow_length * direction.y};
    canvas.arrow({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y},
                 9.0, {palette::arrow.with_alpha(0.75), 1.6});
}

void draw_gradient(Canvas& canvas, const DistanceFieldResult& field, const View& view) {
    draw_cells(canvas, field, view,
               [&](std::size_t cell) { return direction_color(gradient_at(field, cell)); });
    const Rectangle page = covered_page(field, view);
    const auto places = [](double low, double high) {
        return static_cast<int>(std::ceil((high - low) / arrow_spacing - 0.5));
    };
    for (int row = 0; row < places(page.min.y, page.max.y); ++row) {
        for (int column = 0; column < places(page.min.x, page.max.x); ++column) {
            const Vector2 middle{page.min.x + (column + 0.5) * arrow_spacing,
                                 page.min.y + (row + 0.5) * arrow_spacing};
            draw_gradient_arrow(canvas, middle,
                                gradient_at(field, cell_at(field, view.to_world(middle))));
        }
    }
}

namespace {

constexpr double iso_lattice_step = 2.0;  // pixels; small enough for smooth lines

}  // namespace

double FieldScale::position(double value) const {
    return value / std::max({-lowest, highest, 1e-300});
}

FieldLayer::FieldLayer(const DistanceFieldResult& field, const View& view)
    : field_(field), view_(view), page_(covered_page(field, view)) {
    const Lattice lattice = sample(iso_lattice_step);
    const auto [lowest, highest] =
        std::minmax_element(lattice.values.begin(), lattice.values.end());
    scale_.lowest = static_cast<double>(*lowest);
    scale_.highest = static_cast<double>(*highest);
    constexpr double wanted_lines = 14.0;
    scale_.iso_step = round_step(std::max(scale_.highest - scale_.lowest, 1e-300), wanted_lines);
}

double FieldLayer::value_at(Vector2 world) const {
    // Bilinear between cell centres, constant beyond the outermost ones.
    const double column = std::clamp((world.x - field_.origin.x) / field_.cell - 0.5, 0.0,
                                     static_cast<double>(field_.width - 1));
    const double row = std::clamp((world.y - field_.origin.y) / field_.cell - 0.5, 0.0,
                                  static_cast<double>(field_.height - 1));
    const auto left = static_cast<std::size_t>(column);
    const auto low = static_cast<std::size_t>(row);
    const std::size_t right = std::min<std::size_t>(left + 1, field_.width - 1);
    const std::size_t high = std::min<std::size_t>(low + 1, field_.height - 1);
    const auto value = [this](std::size_t x, std::size_t y) {
        return static_cast<double>(field_.values[y * field_.width + x]);
    };
    const double across = column - static_cast<double>(left);
    return std::lerp(std::lerp(value(left, low), value(right, low), across),
                     std::lerp(value(left, high), value(right, high), across),
                     row - static_cast<double>(low));
}

Lattice FieldLayer::sample(double step) const {
    Lattice lattice;
    const auto nodes = [step](double length) {
        return static_cast<std::size_t>(std::max(length, 0.0) / step) + 1;
    };
    lattice.width = nodes(page_.max.x - page_.min.x);
    lattice.height = nodes(page_.max.y - page_.min.y);
    lattice.values.reserve(lattice.width * lattice.height);
    for (std::size_t row = 0; row < lattice.height; ++row) {
        for (std::size_t column = 0; column < lattice.width; ++column) {
            const Vector2 page{page_.min.x + step * static_cast<double>(column),
                               page_.min.y + step * static_cast<double>(row)};
            lattice.values.push_back(static_cast<float>(value_at(view_.to_world(page))));
        }
    }
    return lattice;
}

void FieldLayer::draw_colors(Canvas& canvas) const {
    const Lattice lattice = sample(1.0);
    std::vector<std::uint32_t> table(1024);
    const double last = static_cast<double>(table.size() - 1);
    for (std::size_t index = 0; index < table.size(); ++index) {
        table[index] = pixel_of(diverging_color(2.0 * static_cast<double>(index) / last - 1.0));
    }
    std::vector<std::uint32_t> pixels;
    pixels.reserve(lattice.values.size());
    for (const float value : lattice.values) {
        const double position = std::clamp(scale_.position(static_cast<double>(value)), -1.0, 1.0);
        pixels.push_back(
            table[static_cast<std::size_t>(std::lround((position + 1.0) / 2.0 * last))]);
    }
    canvas.image(pixels, static_cast<int>(lattice.width), static_cast<int>(lattice.height),
                 page_.min);
}

std::vector<std::vector<Vector2>> FieldLayer::lines_at(const Lattice& lattice, double level) const {
    std::vector<std::vector<Vector2>> lines = contour_lines(lattice, level);
    for (std::vector<Vector2>& line : lines) {
        for (Vector2& point : line) {
            point = {page_.min.x + iso_lattice_step * point.x,
                     page_.min.y + iso_lattice_step * point.y};
        }
    }
    return lines;
}

void FieldLayer::draw_iso_lines(Canvas& canvas) const {
    const Lattice lattice = sample(iso_lattice_step);
    const auto first = std::lround(std::ceil(scale_.lowest / scale_.iso_step));
    const auto last = std::lround(std::floor(scale_.highest / scale_.iso_step));
    for (auto index = first; index <= last; ++index) {
        if (index != 0) {
            const double level = static_cast<double>(index) * scale_.iso_step;
            canvas.stroke_open(lines_at(lattice, level), {palette::text.with_alpha(0.32), 1.1});
        }
    }
    canvas.stroke_open(lines_at(lattice, 0.0), {palette::shape_b.with_alpha(0.8), 2.4});
}

}  // namespace nearfield::tools
