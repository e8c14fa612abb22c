#pragma once

#include <engine/geometry/simplify.hpp>

#include <vector>

namespace nearfield::plan {

/// Simplified boundaries of the shapes of a batch, so that a shape in many queries of one tolerance
/// is simplified once. Nothing outlives the batch: a shape may deform before the next one.
class SimplifiedShapes {
public:
    void clear() { used_ = 0; }

    /// The boundary of `polygon` simplified to `deviation`, runs no longer than `longest_run`.
    /// Valid until the next call.
    const std::vector<geometry::SimplifiedEdge>& get(const geometry::Polygon& polygon,
                                                     double deviation, double longest_run);

private:
    struct Entry {
        const geometry::Polygon* polygon = nullptr;
        double deviation = 0.0;
        double longest_run = 0.0;
        std::vector<geometry::SimplifiedEdge> edges;
    };
    // A ring: queries on one shape come close together, so the oldest entry is the one to replace.
    std::vector<Entry> entries_;
    std::size_t used_ = 0;
};

}  // namespace nearfield::plan
