#pragma once

#include <nearfield/export.hpp>

/// \file
/// The cost model of Technique::automatic: measured times of each technique for each kind of query.

namespace nearfield {

/// Times of one kind of query by one technique, in microseconds. A query takes `query` + `edge` *
/// its edges + `sample` * its samples.
struct WorkCost {
    double query = 0.0;   ///< per query
    double edge = 0.0;    ///< per edge of the two shapes
    double sample = 0.0;  ///< per boundary point resolved, or per cell of a grid
};

/// Times of one technique, in microseconds.
struct TechniqueCost {
    double submission = 0.0;     ///< once per batch that uses the technique
    WorkCost points = {};        ///< penetration and contacts; a sample is a boundary point
    WorkCost closest = {};       ///< closest point, separation, intersection test; no samples
    WorkCost intersection = {};  ///< intersections; a sample is a cell
    WorkCost field = {};         ///< distance fields except those of `features`; a sample is a cell
    /// Distance fields with features, analytic gradients or points; a sample is a cell.
    WorkCost features = {};
};

/// Costs of every technique on one machine, as measured by measure_costs() of diagnostics.hpp. The
/// model is coarse: it only has to separate techniques that differ by factors.
struct CostModel {
    TechniqueCost raster = {};   ///< Technique::raster
    TechniqueCost compute = {};  ///< Technique::compute
    TechniqueCost cpu = {};      ///< Technique::cpu
};

}  // namespace nearfield
