#pragma once

#include <nearfield/export.hpp>

#include <optional>
#include <string>
#include <vector>

/// \file
/// The times of a batch.

namespace nearfield {

/// The time of one pass on the device.
struct PassTime {
    std::string name;           ///< as in the render graph and in debuggers
    double milliseconds = 0.0;  ///< from its first command to the end of its last
};

/// The time of one query, in milliseconds. Work that the queries of a batch share counts for none
/// of them: the selection of techniques, packing and upload, recording, and the lists of points and
/// samples that come back from the device.
struct QueryTime {
    double plan = 0.0;  ///< in submit() and record(): checks, localisation, tiles and points
    /// On the CPU, in the thread that answered: the whole answer if Technique::cpu gave it,
    /// otherwise making the results from what the device found.
    double answer = 0.0;
    /// The sum of Timings::passes, where this query alone had work on the device. Unset if it had
    /// none there, if other queries of the batch did too (their work is in the same dispatches and
    /// draws, which only the batch's passes time), or if there are no timestamps.
    std::optional<double> device = std::nullopt;
};

/// The times of a batch, in milliseconds. Device and CPU work in parallel, so the parts may add up
/// to more than the total. Pipelines that a call has to make (Settings::pipelines_on_demand) are in
/// none of them; the log has their times.
struct Timings {
    double localize = 0.0;  ///< hierarchies on the CPU, for what a device answers
    double plan = 0.0;      ///< technique selection, simplification, meshes, atlas, upload
    double record = 0.0;    ///< recording of commands
    /// From submission until its fence was seen signalled, by is_ready() or at the end of the wait
    /// in collect(); may include the caller's own work in between. 0 for recorded batches, which
    /// the host submits; their `passes` are measured all the same.
    double device = 0.0;
    double decode = 0.0;  ///< reading results and refining them; queries answered by the CPU
    double total = 0.0;   ///< inside submit() and collect(), or run(): work and waiting
    std::vector<PassTime> passes;  ///< if Settings::timestamps; empty if the queue has none
    /// One per query, in order; empty unless requested (Batch::time_queries).
    std::vector<QueryTime> queries;
};

}  // namespace nearfield
