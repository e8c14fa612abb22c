#pragma once

#include <engine/plan/plan_limits.hpp>

#include <cstdint>

namespace nearfield::plan {

/// The limits with an atlas whose images take at most a quarter of the memory, and no tile larger
/// than that. Smaller images only mean more tile batches.
[[nodiscard]] PlanLimits with_affordable_atlas(PlanLimits limits);

/// The memory that one batch needs, in bytes, added up query by query while it is planned.
class MemoryBudget {
public:
    /// `counts_closely`: no query is answered by brute force before localisation shows how many
    /// records it can have.
    MemoryBudget(const PlanLimits& limits, bool counts_closely);

    /// Whether more is needed than there is, because records were estimated roughly.
    [[nodiscard]] bool is_exceeded() const { return result_bytes() > for_results_; }
    /// Bytes that all results may need on the host.
    [[nodiscard]] double result_bytes() const { return required_ + rough_; }
    /// Number of jobs that can run at the same time; at least 1.
    [[nodiscard]] std::uint32_t jobs_with_room() const;

private:
    friend class QueryMemory;

    double limit_;        // for all
    double images_;       // what the atlas takes of it
    double for_results_;  // the rest
    double max_to_keep_;  // samples of a query, at once
    bool counts_closely_;
    double max_kept_ = 0.0;  // samples of any query of the batch
    double required_ = 0.0;
    double rough_ = 0.0;  // that records may take of queries that were not localised
};

/// What one query adds to the budget of its batch.
class QueryMemory {
public:
    QueryMemory(MemoryBudget& batch, std::uint32_t query, double tolerance)
        : batch_(batch), query_(query), tolerance_(tolerance) {}

    /// Adds bytes. Throws StatusException (too_large), with a tolerance that fits, if the batch has
    /// no room for them. `growth`: memory grows with (1/d)^growth.
    void require(double bytes, double growth);
    /// Returns whether the query may be answered from whole boundaries, with so many samples kept
    /// at once and results of at most so many bytes, which are a rough estimate.
    [[nodiscard]] bool fits_roughly(double samples_at_once, double bytes);
    /// The same for what localisation leaves. Throws StatusException (too_large) if the results do
    /// not fit.
    [[nodiscard]] bool fits(double samples_at_once, double bytes);

private:
    /// Returns whether this many boundary samples, and what is derived from them, may be kept at
    /// once.
    [[nodiscard]] bool can_keep(double samples);

    MemoryBudget& batch_;
    std::uint32_t query_;
    double tolerance_;
    double bytes_ = 0.0;
};

}  // namespace nearfield::plan
