#pragma once

#include <nearfield/result.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/contour.hpp>
#include <tools/drawing/view.hpp>

#include <vector>

namespace nearfield::tools {

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
