#pragma once

#include <nearfield/result.hpp>

#include <tools/picture/canvas.hpp>
#include <tools/picture/contour.hpp>
#include <tools/picture/view.hpp>

#include <vector>

namespace nearfield::tools {

/// How the values of a field become colours and lines. Both sides of zero have the same scale, so
/// that equal colours strength means equal distance.
struct FieldScale {
    double lowest = 0.0;
    double highest = 0.0;
    double iso_step = 0.0;

    [[nodiscard]] double position(double value) const;  ///< for diverging_color
};

/// A signed distance field as it stands in a view: resampled to its pixels, so that drawing costs
/// the same for every size of field.
class FieldLayer {
public:
    FieldLayer(const DistanceFieldResult& field, const View& view);

    [[nodiscard]] const FieldScale& scale() const noexcept { return scale_; }

    void draw_colors(Canvas& canvas) const;
    /// Lines at multiples of the step other than zero, and the zero line.
    void draw_iso_lines(Canvas& canvas) const;

private:
    [[nodiscard]] double value_at(Vector2 world) const;
    [[nodiscard]] Lattice sample(double step) const;
    [[nodiscard]] std::vector<std::vector<Vector2>> lines_at(const Lattice& lattice,
                                                             double level) const;

    const DistanceFieldResult& field_;
    const View& view_;
    Rectangle page_;  ///< what the field covers of the view's page rectangle, in whole pixels
    FieldScale scale_;
};

}  // namespace nearfield::tools
