#pragma once

#include <nearfield/export.hpp>

/// \file
/// The cost model of Technique::automatic: measured times of each technique for each kind of query.

namespace nearfield {

/// Times of one kind of query, in microseconds. A query takes `query` + `edge` * its edges +
/// `sample` * its samples + `search` * what its cells search; the queries of a batch that a
/// technique answers take `shape` * the edges of all their shapes beside, each shape counted once.
struct WorkCost {
    double query = 0.0;   ///< per query
    double edge = 0.0;    ///< per edge of the two shapes
    double sample = 0.0;  ///< per boundary point resolved, or per cell of a grid
    /// Of distance fields: per cell and doubling of the edges about as near to it as the nearest.
    double search = 0.0;
    /// Per edge of a shape, once for all queries of the kind that have it: it is put into trees, or
    /// handed to the device.
    double shape = 0.0;
};

/// Times of each kind of query.
struct QueryCosts {
    WorkCost points = {};  ///< penetration and contacts; a sample is a boundary point
    /// Closest point, separation, intersection test; no samples. Unused of Technique::compute,
    /// which leaves them to the CPU.
    WorkCost closest = {};
    WorkCost intersection = {};  ///< intersections; a sample is a cell
    WorkCost field = {};         ///< distance fields except those of `features`; a sample is a cell
    /// Distance fields with features, analytic gradients or points; a sample is a cell.
    WorkCost features = {};
};

/// Times of a technique that uses the device, in microseconds. The calling thread plans the queries
/// and submits them; the device works; then the calling thread reads the results.
struct DeviceCosts {
    double submission = 0.0;  ///< of the calling thread, once per batch that uses the technique
    double latency = 0.0;     ///< of the device, once per batch that uses the technique
    QueryCosts plan = {};     ///< before the submission
    QueryCosts device = {};   ///< of the device, of each of several queries
    QueryCosts read = {};     ///< of the calling thread, after the device; of what is read back
};

/// Times of Technique::cpu, in microseconds, of the calling thread.
struct CpuCosts {
    QueryCosts plan = {};    ///< before a submission
    QueryCosts answer = {};  ///< after it, while the device works
};

/// Costs of every technique on one machine, as measured by measure_costs() of diagnostics.hpp. The
/// model is coarse: it only has to separate techniques that differ by factors.
///
/// A batch takes: what is planned, submitted and read, + what the device does + what the calling
/// thread answers, - `overlap` * the lesser of these two.
struct CostModel {
    DeviceCosts raster = {};   ///< Technique::raster
    DeviceCosts compute = {};  ///< Technique::compute
    CpuCosts cpu = {};         ///< Technique::cpu
    /// From 0 to 1. 1: device and calling thread do not slow each other down, as with a GPU; 0: one
    /// waits for the other. In between: a device that is software shares the cores.
    double overlap = 0.0;
};

}  // namespace nearfield
