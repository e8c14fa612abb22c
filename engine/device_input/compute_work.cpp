#include <engine/device_input/compute_work.hpp>

#include <cmath>
#include <span>

namespace nearfield::device_input {

double bytes_of_masks(const queries::Regions& regions, int masks, double largest_tile) {
    double bytes = 0.0;
    for (const queries::Grid& grid : regions.grids()) {
        const double across = std::ceil(static_cast<double>(grid.width) / largest_tile);
        const double rows = across * static_cast<double>(grid.height);
        bytes += masks * (grid.cells() / 8.0 + sizeof(std::uint32_t) * rows);
    }
    return bytes;
}

void ComputeWork::clear() {
    mask_shapes.clear();
    overlaps.clear();
    fields.clear();
    shapes = nullptr;
    mask_threads = overlap_rows = 0;
    mask_words = edge_words = 0;
}

std::uint64_t ComputeWork::shape_bytes() const {
    return shapes == nullptr
               ? 0
               : shapes->units().size_bytes() + std::span(fields.tiles).size_bytes() +
                     std::span(fields.points).size_bytes() + std::span(mask_shapes).size_bytes() +
                     std::span(overlaps).size_bytes();
}

}  // namespace nearfield::device_input
