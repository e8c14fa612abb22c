#pragma once

#include <nearfield/export.hpp>

#include <atomic>
#include <cstdint>
#include <limits>

/// \file
/// Limits of one call: a budget of time, a flag that cancels it, and a callback that sees it
/// proceed.

namespace nearfield {

/// The progress of a call at one of its checkpoints.
struct Progress {
    std::uint64_t checkpoint = 0;  ///< number of the checkpoint in this call, from 1
    /// Queries of the batch that are done, or entries of a world's query. Those answered by the
    /// device are done in collect().
    std::uint64_t done = 0;
    /// Queries, or entries, known so far; it grows where the answers to some need more. Tables of
    /// pairs count the pairs that come near each other; collect() counts the device's queries.
    std::uint64_t count = 0;
};

/// Limits of one call. By default there are none.
///
/// A call looks at its limits at checkpoints: before each query, and inside every stage that can
/// take long, on the calling thread and in each job of Settings::jobs. Once a limit is reached, the
/// call ends at the next checkpoint: milliseconds later, or up to half a second with
/// hundreds of thousands of vertices or records. What is done by then stays, and is the same, bit
/// for bit, as without limits. The rest:
/// - A query of a batch that is not done has StatusCode::cancelled or budget_exhausted as its own
///   status, and no records. The batch itself succeeds.
/// - A separation vector or time of impact that is being searched ends as if its own limit were
///   reached (max_work, max_steps): its status is ok, and its bounds are wider than requested.
/// - A query of a world fails as a whole, with cancelled or budget_exhausted. Later calls answer as
///   if nothing had happened.
///
/// The wait for the device, the upload of a batch and the recording of its commands are not cut. If
/// the time is over when the device is done, its results are not read.
struct Limits {
    /// The call ends once this is true. Borrowed for the call; any thread may set it, and so may
    /// `progress`. Null: the call cannot be cancelled.
    const std::atomic<bool>* cancel = nullptr;
    /// Time budget in seconds from the start of the call, >= 0 (invalid_settings otherwise). Which
    /// queries are done in time depends on the machine; SeparationVectorQuery::max_work and
    /// TimeOfImpactQuery::max_steps are budgets that do not.
    double seconds = std::numeric_limits<double>::infinity();
    void* user = nullptr;  ///< passed to `progress`
    /// Called at every checkpoint, until a limit is reached: many thousand times per second. May be
    /// called by several jobs at the same time; must not throw or call the context.
    void (*progress)(void* user, const Progress& progress) = nullptr;
};

}  // namespace nearfield
