#include <engine/plan/compute_work.hpp>

#include <span>

namespace nearfield::plan {

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

}  // namespace nearfield::plan
