#pragma once

#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/view.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace nearfield::tools {

/// Values at the nodes of a lattice, row by row.
struct Lattice {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;

    [[nodiscard]] double at(std::size_t column, std::size_t row) const {
        return static_cast<double>(values[row * width + column]);
    }
};

/// The contour lines of a lattice at a value (marching squares, linear between nodes), in node
/// units: node (column, row) is the point (column, row). Closed lines end where they begin.
[[nodiscard]] std::vector<std::vector<Vector2>> contour_lines(const Lattice& lattice, double level);

/// Draws the Voronoi diagram in false colour: every feature of B has a colour far from those of its
/// neighbours along the boundary; vertices are light, edges saturated.
void draw_voronoi(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color feature_color(Feature feature);

/// Draws the gradient: its direction as a hue, with arrows on a coarse grid.
void draw_gradient(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color direction_color(Vector2 direction);
void draw_gradient_arrow(Canvas& canvas, Vector2 middle, Vector2 direction);

/// Maps the values of a field to colours and contour lines. Both signs share one scale, so that
/// equal colour intensity means equal distance.
struct FieldScale {
    double lowest = 0.0;
    double highest = 0.0;
    double iso_step = 0.0;

    [[nodiscard]] double position(double value) const;  ///< for diverging_color
};

/// A signed distance field in a view, resampled to its pixels, so that drawing costs the same for
/// every size of field.
class FieldLayer {
public:
    FieldLayer(const DistanceFieldResult& field, const View& view);

    [[nodiscard]] const FieldScale& scale() const noexcept { return scale_; }

    void draw_colors(Canvas& canvas) const;
    /// Draws the zero line and lines at the other multiples of the step.
    void draw_iso_lines(Canvas& canvas) const;

private:
    [[nodiscard]] double value_at(Vector2 world) const;
    [[nodiscard]] Lattice sample(double step) const;
    [[nodiscard]] std::vector<std::vector<Vector2>> lines_at(const Lattice& lattice,
                                                             double level) const;

    const DistanceFieldResult& field_;
    const View& view_;
    Rectangle page_;  ///< the part of the view's page rectangle that the field covers, in whole
                      ///< pixels
    FieldScale scale_;
};

}  // namespace nearfield::tools
