#include <engine/geometry/morton.hpp>
#include <engine/simd/morton_order.hpp>

#include <array>
#include <numeric>

namespace nearfield::simd {
namespace {

using geometry::Box;
using geometry::Vector;

double part_of(double from_low, double length) {
    return length > 0.0 ? from_low / length : 0.0;
}

}  // namespace

std::span<const std::uint32_t> MortonOrder::find(const geometry::Polygon& polygon,
                                                 const EdgeArrays& edges, const Box& box) {
    const Vector size = box.sizes();
    on_curve_.resize(polygon.ring_count());
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t edge = polygon.ring_begin(ring);
        const std::uint32_t place =
            geometry::on_morton_curve(part_of(edges.start_x[edge] - box.min().x(), size.x()),
                                      part_of(edges.start_y[edge] - box.min().y(), size.y()));
        // Of 256 x 256 cells: smaller differences are ignored.
        on_curve_[ring] = static_cast<std::uint16_t>(place >> 16U);
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
