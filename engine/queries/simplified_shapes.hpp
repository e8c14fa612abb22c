#pragma once

#include <engine/queries/simplified_boundary.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::queries {

/// Cache of the simplified boundaries of a batch, so that a shape in many queries with the same
/// tolerance is simplified once. Nothing outlives the batch: a shape may deform before the next
/// one.
class SimplifiedShapes {
public:
    void clear();

    /// The boundary of `polygon` simplified to `deviation`, with runs no longer than `longest_run`.
    /// Valid until the next call.
    [[nodiscard]] SimplifiedBoundary get(const geometry::Polygon& polygon, double deviation,
                                         double longest_run);

    /// The same for a caller that only looks at a window of the world, as geometry::simplify_near()
    /// does it: inside the window always the same edges, outside it those or fewer.
    [[nodiscard]] SimplifiedBoundary get_near(const geometry::TransformedPolygon& placed,
                                              const geometry::Box& window, double deviation,
                                              double longest_run);

private:
    struct Key {
        const geometry::Polygon* polygon = nullptr;
        double deviation = 0.0;
        double longest_run = 0.0;
        bool in_blocks = false;  // for windows

        [[nodiscard]] bool operator==(const Key&) const = default;
    };
    /// Where the parts of a simplified boundary start in the shared arrays.
    struct Place {
        std::uint32_t edge = 0, edge_count = 0;  // no edges: nothing made yet
        std::uint32_t ring = 0, ring_count = 0;  // one more than there are rings
        std::uint32_t box = 0, box_count = 0;
    };
    struct Entry {
        Key key;
        Place whole;
        std::size_t edges_of_windows = 0;  // edges made for single windows
    };

    [[nodiscard]] SimplifiedBoundary view(const geometry::Polygon& polygon,
                                          const Place& place) const;
    [[nodiscard]] Entry& find_or_add(const Key& key);
    /// The slot of an entry, or the free slot where it belongs.
    [[nodiscard]] std::uint32_t& slot(const Key& key);
    /// Appends the edges that `simplify(edges)` appends, and everything derived from them.
    template <class Simplify>
    [[nodiscard]] Place append(const geometry::Polygon& polygon, const Simplify& simplify);
    void append_rings(const geometry::Polygon& polygon, Place& place);
    void grow_table();

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> table_;  // open addressing: positions in entries_, a power of two
    std::vector<geometry::SimplifiedEdge> edges_;
    std::vector<std::uint32_t> ring_of_;     // by edge
    std::vector<std::uint32_t> ring_begin_;  // by ring of each shape, and the end of its last
    std::vector<geometry::Box> boxes_;
};

}  // namespace nearfield::queries
