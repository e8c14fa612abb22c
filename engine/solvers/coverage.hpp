#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Samples first, ..., end - 1 of a row of a tile; none if end <= first.
struct RowSpan {
    std::uint32_t row = 0;
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Fills a row by parity. A set bit means that an edge passes right after its sample; a sample is
/// inside if the number of set bits from its own on is odd.
void fill_from_crossings(std::span<std::uint64_t> row);

/// The covered samples of a tile, one bit each: the samples that a rasteriser covers whose vertices
/// are on the sub-pixel grid, computed exactly in integers and with the same fill rule. Coordinates
/// are in cells of the tile and on that grid. Reuses its memory.
class Coverage {
public:
    /// Restarts with nothing covered.
    void reset(std::uint32_t width, std::uint32_t height, geometry::SubpixelGrid grid);

    [[nodiscard]] std::uint32_t height() const { return height_; }
    /// Row by row, each starting at a new word; the lowest bit of a row's first word is column 0.
    /// Bits beyond the width are 0.
    [[nodiscard]] std::span<std::uint64_t> words() { return words_; }
    [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }
    [[nodiscard]] std::size_t words_per_row() const { return words_per_row_; }

    /// Inverts the samples left of an upward edge, in the rows it crosses. Takes effect once fill()
    /// is called.
    void invert_left_of(const geometry::Vector& from, const geometry::Vector& to);
    /// Completes a fill by parity, after invert_left_of() was called for all edges.
    void fill();

    /// Appends the rows covered by the fan of triangles of an offset polygon. A sample may be in
    /// several of them.
    void append_fan(const geometry::OffsetPolygon& polygon, std::vector<RowSpan>& spans) const;

    /// Keeps only the samples that `other`, of the same size, covers as well.
    void keep_common(const Coverage& other);

private:
    struct GridPoint {
        std::int64_t x = 0;
        std::int64_t y = 0;
    };

    [[nodiscard]] GridPoint to_grid(const geometry::Vector& point) const;
    /// The first row of the tile whose samples are at or above y; its height if there is none.
    [[nodiscard]] std::int64_t first_row_from(std::int64_t y) const;
    /// Calls `cross(row, count)` for each row of the tile whose samples' height lies between the
    /// two ends, lower end included; `count` samples of the row lie left of the edge.
    template <class Cross>
    void for_crossings(GridPoint low, GridPoint high, const Cross& cross) const;
    [[nodiscard]] static bool is_convex(std::span<const GridPoint> corners);
    void append_convex(std::span<const GridPoint> corners, std::vector<RowSpan>& spans) const;

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::size_t words_per_row_ = 0;
    std::int64_t steps_ = 0;  // sub-pixels per cell: a power of two
    int shift_ = 0;           // log2(steps_)
    std::vector<std::uint64_t> words_;
};

/// Calls `use(bit)` for the set bits of a word, lowest first.
template <class Use>
void for_bits(std::uint64_t word, const Use& use) {
    for (; word != 0; word &= word - 1) {
        use(static_cast<std::uint32_t>(std::countr_zero(word)));
    }
}

/// Returns ones at the bits first, ..., end - 1, restricted to the word that holds bits 64 * word,
/// ....
[[nodiscard]] std::uint64_t bits_between(std::uint32_t first, std::uint32_t end,
                                         std::uint32_t word);

}  // namespace nearfield::solvers
