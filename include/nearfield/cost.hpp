#pragma once

/// \file
/// What Technique::automatic goes by: how long each technique takes for what is asked, as measured.

namespace nearfield {

/// Times of one kind of query by one technique, microseconds. A query takes `query` + `edge` * its
/// edges + `sample` * its samples.
struct WorkCost {
    double query = 0.0;   ///< each query
    double edge = 0.0;    ///< each edge of the shapes that take part
    double sample = 0.0;  ///< each boundary point that is resolved, or each cell of a grid
};

/// Times of one technique, microseconds.
struct TechniqueCost {
    double submission = 0.0;     ///< once a batch that uses the technique at all
    WorkCost points = {};        ///< penetration and contacts; a sample is a point of a boundary
    WorkCost closest = {};       ///< closest point, separation, intersection test; without samples
    WorkCost intersection = {};  ///< a sample is a cell
    WorkCost field = {};         ///< distance fields but those below; a sample is a cell
    WorkCost features = {};      ///< fields with features, analytic gradients or points; likewise
};

/// What each technique costs on one machine. Few numbers, since it only has to tell apart what
/// differs by factors; Context::measure_costs finds them by running all techniques.
struct CostModel {
    TechniqueCost raster = {};   ///< of Technique::raster
    TechniqueCost compute = {};  ///< of Technique::compute
    TechniqueCost cpu = {};      ///< of Technique::cpu
};

}  // namespace nearfield
