#pragma once

#include <engine/queries/query_limits.hpp>

#include <atomic>
#include <cstdint>

namespace nearfield::queries {

/// The limits with an atlas whose images take at most a quarter of the memory, and no tile larger
/// than that. Smaller images only mean more tile batches.
[[nodiscard]] QueryLimits with_affordable_atlas(QueryLimits limits);

/// The memory that one batch needs, in bytes, added up query by query, possibly in several jobs at
/// once.
class MemoryBudget {
public:
    explicit MemoryBudget(const QueryLimits& limits);

    /// Adds what other parts of the batch need.
    void add(double bytes) { required_ += bytes; }
    /// Bytes that all results may need on the host.
    [[nodiscard]] double result_bytes() const { return required_; }

private:
    friend class QueryMemory;

    double limit_;        // for all
    double images_;       // what the atlas takes of it
    double for_results_;  // the rest
    std::atomic<double> required_ = 0.0;
};

/// What one query adds to the budget of its batch.
class QueryMemory {
public:
    QueryMemory(MemoryBudget& batch, std::uint32_t query, double tolerance)
        : batch_(batch), query_(query), tolerance_(tolerance) {}

    /// Adds bytes. Throws StatusException (too_large), with a tolerance that fits, if the batch has
    /// no room for them. `growth`: memory grows with (1/d)^growth.
    void require(double bytes, double growth);
    /// Adds nothing, but throws as require() does if a batch of this query alone has no room for
    /// its points, or if they are more than can be numbered. `kept`: bytes of a point; `rough`: a
    /// bound on their number; `closely()`: a better bound, which is only asked for if the rough one
    /// is too large.
    template <class Closely>
    void require_alone(double kept, double rough, const Closely& closely) {
        if (!fits_alone(kept, rough)) {
            require_alone(kept, closely());
        }
    }

private:
    [[nodiscard]] bool fits_alone(double kept, double points) const;
    void require_alone(double kept, double points);
    [[noreturn]] void refuse(double required, double growth) const;

    MemoryBudget& batch_;
    std::uint32_t query_;
    double tolerance_;
    double bytes_ = 0.0;
};

}  // namespace nearfield::queries
