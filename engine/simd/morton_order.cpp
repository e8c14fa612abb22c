#include <engine/simd/morton_order.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace nearfield::simd {
namespace {

using geometry::Box;
using geometry::Vector;

/// Moves bits 0, 1, ... 7 to bits 0, 2, ... 14.
std::uint32_t spread_bits(std::uint32_t bits) {
    bits = (bits | bits << 4U) & 0x0f0fU;
    bits = (bits | bits << 2U) & 0x3333U;
    return (bits | bits << 1U) & 0x5555U;
}

}  // namespace

std::span<const std::uint32_t> MortonOrder::find(const geometry::Polygon& polygon,
                                                 const EdgeArrays& edges, const Box& box) {
    // Morton order on 256 x 256 cells. Smaller coordinate differences are ignored.
    constexpr double cells = 256.0;
    const Vector size = box.sizes();
    const auto cell_of = [&](double from_low, double length) {
        const double part = length > 0.0 ? from_low / length : 0.0;
        return static_cast<std::uint32_t>(std::clamp(cells * part, 0.0, cells - 1.0));
    };
    on_curve_.resize(polygon.ring_count());
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t edge = polygon.ring_begin(ring);
        const std::uint32_t column = cell_of(edges.start_x[edge] - box.min().x(), size.x());
        const std::uint32_t row = cell_of(edges.start_y[edge] - box.min().y(), size.y());
        on_curve_[ring] = static_cast<std::uint16_t>(spread_bits(column) | spread_bits(row) << 1U);
    }
    rings_.resize(polygon.ring_count());
    std::iota(rings_.begin(), rings_.end(), 0U);
    sort_by_byte(0);
    sort_by_byte(1);
    return rings_;
}

/// One stable counting-sort pass: rings with the same byte keep their order.
void MortonOrder::sort_by_byte(std::uint32_t byte) {
    const auto byte_of = [&](std::uint32_t ring) -> std::size_t {
        return std::uint32_t{on_curve_[ring]} >> (8U * byte) & 0xffU;
    };
    std::array<std::uint32_t, 257> begin{};
    for (const std::uint32_t ring : rings_) {
        ++begin[byte_of(ring) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    others_.resize(rings_.size());
    for (const std::uint32_t ring : rings_) {
        others_[begin[byte_of(ring)]++] = ring;
    }
    rings_.swap(others_);
}

}  // namespace nearfield::simd
