#pragma once

#include <engine/plan/simplified_boundary.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Simplified boundaries of the shapes of a batch, so that a shape in many queries of one tolerance
/// is simplified once. Nothing outlives the batch: a shape may deform before the next one.
class SimplifiedShapes {
public:
    void clear();

    /// The boundary of `polygon` simplified to `deviation`, runs no longer than `longest_run`.
    /// Valid until the next call.
    [[nodiscard]] SimplifiedBoundary get(const geometry::Polygon& polygon, double deviation,
                                         double longest_run);

private:
    /// A shape, and where its parts start in the arrays that all shapes share.
    struct Entry {
        const geometry::Polygon* polygon = nullptr;
        double deviation = 0.0;
        double longest_run = 0.0;
        std::uint32_t edge = 0, edge_count = 0;
        std::uint32_t ring = 0, ring_count = 0;  // one more than there are rings
        std::uint32_t box = 0, box_count = 0;
    };

    [[nodiscard]] SimplifiedBoundary view(const Entry& entry) const;
    /// The slot of an entry, or the free one where it would stand.
    [[nodiscard]] std::uint32_t& slot(const geometry::Polygon& polygon, double deviation,
                                      double longest_run);
    void add(const geometry::Polygon& polygon, double deviation, double longest_run);
    void add_rings(const geometry::Polygon& polygon, Entry& entry);
    void grow_table();

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> table_;  // open addressing: positions in entries_, a power of two
    std::vector<geometry::SimplifiedEdge> edges_;
    std::vector<std::uint32_t> ring_of_;     // by edge
    std::vector<std::uint32_t> ring_begin_;  // by ring of each shape, and the end of its last
    std::vector<geometry::Box> boxes_;
};

}  // namespace nearfield::plan
