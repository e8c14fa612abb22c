#include <tests/query/check.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::test {

void check_field(const oracle::ShapeOracle& b, double tolerance, const DistanceFieldResult& result,
                 std::size_t max_cells) {
    Report report("distance field");
    check_summary(report, result, tolerance);
    if (!result.status.ok()) {
        return;
    }
    const double cell = tolerance * std::numbers::sqrt2;
    const std::size_t cells = std::size_t{result.width} * result.height;
    report.require(result.values.size() == cells, result.values.size(), " values for ",
                   result.width, " x ", result.height, " cells");
    report.require(std::abs(result.cell - cell) <= 1e-9 * cell, "cell ", result.cell);
    if (!report.clean() || cells == 0) {
        return;
    }
    Random random(cells);
    const std::size_t checked = std::min(cells, max_cells);
    const double most = result.error_bound * (1 + 1e-6) + b.rounding();
    for (std::size_t i = 0; i < checked; ++i) {
        const std::size_t index =
            checked == cells
                ? i
                : static_cast<std::size_t>(random.between(0.0, 1.0) * static_cast<double>(cells));
        const double column = static_cast<double>(index % result.width);
        const double row = static_cast<double>(index / result.width);
        const Vector2 centre{result.origin.x + (column + 0.5) * result.cell,
                             result.origin.y + (row + 0.5) * result.cell};
        const double truth = b.signed_distance(centre);
        const double value = static_cast<double>(result.values[index]);
        report.require(std::abs(value - truth) <= most, "cell ", column, ", ", row, " at ",
                       centre.x, ", ", centre.y, " is ", value, ", should be ", truth, " within ",
                       result.error_bound);
    }
}

}  // namespace nearfield::test
