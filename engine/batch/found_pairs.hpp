#pragma once

#include <engine/batch/point_resolver.hpp>
#include <engine/device_input/plan.hpp>

#include <shaders/pairs.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::batch {

/// What the device's search has found out about the queries of a batch, and about the other
/// directions of some, as it lies in the device's memory.
class FoundPairs {
public:
    /// Forgets all. The batch has so many planned queries; 0: none of them is searched.
    void begin(std::size_t queries) {
        queries_.assign(queries, {});
        are_left_to_cpu_ = false;
    }
    /// The rows of a part of the search, and the points that they name; both have to stay.
    void add(std::span<const shaders::PairRowData> rows, const shaders::FoundPointData* points) {
        for (const shaders::PairRowData& row : rows) {
            queries_[row.a] = {&row, points};
        }
    }
    /// The search had no room for what it found, and is not repeated.
    void leave_to_cpu() { are_left_to_cpu_ = true; }
    [[nodiscard]] bool are_left_to_cpu() const { return are_left_to_cpu_; }

    /// Null: there is no point that the query asks for.
    [[nodiscard]] const shaders::PairRowData* row(std::uint32_t query) const {
        return query < queries_.size() ? queries_[query].row : nullptr;
    }
    /// Whether the row tells all that the query asks.
    [[nodiscard]] static bool is_summary(const shaders::PairRowData& row) {
        return (row.count & (shaders::row_undecided | shaders::row_to_resolve)) == 0;
    }
    /// Those that were found, unless the row is a summary.
    [[nodiscard]] QueryPoints points(std::uint32_t query) const {
        if (row(query) == nullptr) {
            return {};
        }
        const Found& found = queries_[query];
        return {.found = {found.points + found.row->first_point, found.row->point_count}};
    }

private:
    struct Found {
        const shaders::PairRowData* row = nullptr;
        const shaders::FoundPointData* points = nullptr;
    };
    std::vector<Found> queries_;  // by planned query
    bool are_left_to_cpu_ = false;
};

}  // namespace nearfield::batch
