#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <vector>

/// What measure_costs() runs.
namespace nearfield::calibration {

inline constexpr std::uint32_t few_edges = 16;
inline constexpr std::uint32_t some_edges = 64;
inline constexpr std::uint32_t many_edges = 4096;

/// A shape in the context, and a copy for estimates: a star of five arms, about one in radius, as
/// rough at every scale as a coast line.
struct Star {
    explicit Star(std::uint32_t vertices);

    std::vector<Vector2> ring;
    geometry::Polygon polygon;
    ShapeHandle handle;
};

/// A kind of work: a query at a tolerance, and the tolerances that yield few samples, those at
/// which many edges count and many samples.
struct Kind {
    WorkCost QueryCosts::*cost;
    double coarse;
    double middle;
    double fine;
    bool searches;  ///< cells search for the nearest edge
    AnyQuery (*query)(ShapeHandle shape, double tolerance);
};

/// All kinds.
extern const std::array<Kind, 5> kinds;

/// A distance field around a star.
[[nodiscard]] AnyQuery field(ShapeHandle shape, double tolerance);

inline constexpr double large_field = 0.003;  ///< the tolerance of one with 500,000 cells
inline constexpr double small_field = 0.03;   ///< and with 5,000

}  // namespace nearfield::calibration
