#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/simplify.hpp>

#include <shaders/search.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace nearfield::device_input {

/// Sixteen bytes of the search's input.
using SearchUnit = std::array<std::uint32_t, 4>;

/// The unit of lengths in a shape's own frame: a power of two near its radius, so that products of
/// lengths stay within the range of floats.
[[nodiscard]] double unit_length_of(const geometry::Polygon& polygon);

/// A float that is not below the value.
[[nodiscard]] float rounded_up(double value);

/// Shapes as the device's searches read them (shaders/search.h), one after the other. Keeps what it
/// makes of a shape until the shape changes.
class SearchShapes {
public:
    /// Forgets all shapes; those of the present batch have to be placed again.
    void clear();
    /// Begins a batch: what most recent ones did not use may go, and places with it.
    void begin_batch();
    /// The first unit of a shape, until the next batch begins.
    [[nodiscard]] std::uint32_t place(const geometry::Polygon& polygon) {
        return find_or_make({&polygon, Content::shape, 0.0});
    }
    /// The same for a field: a boundary simplified to `deviation` (0: the shape's own edges), with
    /// what the coordinates lack to twice the precision.
    [[nodiscard]] std::uint32_t place_for_field(const geometry::Polygon& polygon,
                                                double deviation) {
        return find_or_make({&polygon, Content::field, deviation});
    }
    /// The first word of the numbers of samples on a shape's edges; likewise.
    [[nodiscard]] std::uint32_t place_parts(const geometry::Polygon& polygon, double spacing) {
        return 4 * find_or_make({&polygon, Content::parts, spacing});
    }

    [[nodiscard]] std::span<const SearchUnit> units() const { return units_; }
    /// Differs if a unit may have changed; never 0 where there are any.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    /// Copies to the memory of all units those that have changed since a revision. 0: all of them.
    void copy_changes(std::uint64_t since, std::span<std::byte> memory) const;

private:
    enum class Content : std::uint8_t { shape, field, parts };
    struct Key {
        const geometry::Polygon* polygon = nullptr;
        Content content{};
        double length = 0.0;  ///< deviation of a field's boundary; spacing of samples

        [[nodiscard]] bool operator==(const Key&) const = default;
    };
    struct Hash {
        [[nodiscard]] std::size_t operator()(const Key& key) const;
    };
    struct Entry {
        std::uint64_t revision = 0;
        std::uint32_t first = 0;  ///< unit
        std::uint32_t room = 0;   ///< units that it may take; 0: not made yet
        std::uint64_t batch = 0;  ///< that used it last
    };

    /// An entry that was found; most shapes are those of few queries before.
    struct Recent {
        Key key;
        Entry* entry = nullptr;
    };

    /// Units that were written.
    struct Change {
        std::uint64_t revision = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    void note_change(std::uint32_t first, std::uint32_t count);
    void forget_changes();
    void drop_unused();
    [[nodiscard]] Entry& entry_of(const Key& key);
    [[nodiscard]] std::uint32_t find_or_make(const Key& key);
    void make_shape(const geometry::Polygon& polygon);
    void list_edges(const geometry::Polygon& polygon, double deviation);
    void order_rings(const geometry::Polygon& polygon);
    void add_chunks(const geometry::Polygon& polygon, std::uint32_t edges, std::uint32_t infos);
    void add_low_parts(const geometry::Polygon& polygon);
    void add_level(std::uint32_t first);
    void make_parts(const geometry::Polygon& polygon, double spacing);

    std::unordered_map<Key, Entry, Hash> entries_;
    std::array<Recent, 4096> recent_;  // by the low bits of the hash
    std::vector<SearchUnit> units_;
    std::vector<SearchUnit> made_;  // of one shape
    std::vector<std::array<float, 4>> boxes_;
    std::vector<geometry::SimplifiedEdge> edges_;  // of that shape
    std::vector<std::uint32_t> ring_begin_;        // in edges_; then the end of the last ring
    /// Of a ring: its place on a Hilbert curve, its number, its first chunk along the rings.
    struct OrderedRing {
        std::uint32_t on_curve;
        std::uint32_t ring;
        std::uint32_t first_chunk;
    };
    std::vector<OrderedRing> rings_;
    std::uint64_t revision_ = 0;
    std::array<Change, 256> changes_;  // the last ones, in order
    std::size_t change_count_ = 0;
    std::uint64_t changes_since_ = 0;  // the revision before the first of them
    std::uint64_t batch_ = 0;
    std::size_t units_in_use_ = 0;  // by the present batch
};

}  // namespace nearfield::device_input
