#include <engine/plan/compute_work.hpp>

namespace nearfield::plan {

void ComputeWork::clear() {
    mask_shapes.clear();
    field_rows.clear();
    overlaps.clear();
    fields.clear();
    shapes = nullptr;
    mask_threads = overlap_rows = 0;
    mask_words = edge_words = 0;
}

}  // namespace nearfield::plan
