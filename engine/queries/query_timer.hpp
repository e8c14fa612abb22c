#pragma once

#include <engine/base/stopwatch.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace nearfield::queries {

/// Adds the time from construction to destruction to one part of a query's time. Does nothing, and
/// reads no clock, if there are no times.
class QueryTimer {
public:
    QueryTimer(std::span<QueryTime> times, std::size_t query, double QueryTime::*part)
        : time_(times.empty() ? nullptr : &(times[query].*part)) {
        if (time_ != nullptr) {
            start_.emplace();
        }
    }
    ~QueryTimer() {
        if (time_ != nullptr) {
            *time_ += start_->milliseconds();
        }
    }
    QueryTimer(const QueryTimer&) = delete;
    QueryTimer& operator=(const QueryTimer&) = delete;

private:
    double* time_;
    std::optional<Stopwatch> start_;
};

}  // namespace nearfield::queries
