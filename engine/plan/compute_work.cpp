#include <engine/plan/compute_work.hpp>

namespace nearfield::plan {

void ComputeWork::clear() {
    masks.clear();
    edges.clear();
    rows.clear();
    polygons_a.clear();
    polygons_b.clear();
    overlaps.clear();
    overlap_rows.clear();
    fields.clear();
    mask_words = run_words = 0;
}

ComputeWork::Ranges ComputeWork::ranges() const {
    Ranges ranges;
    const auto place = [&](const auto& elements, WorkRange& range) {
        range = {static_cast<std::uint32_t>(ranges.words),
                 static_cast<std::uint32_t>(elements.size())};
        ranges.words += elements.size() * (sizeof(elements[0]) / sizeof(std::uint32_t));
    };
    place(masks, ranges.masks);
    place(edges, ranges.edges);
    place(rows, ranges.rows);
    place(polygons_a, ranges.polygons_a);
    place(polygons_b, ranges.polygons_b);
    place(overlaps, ranges.overlaps);
    place(overlap_rows, ranges.overlap_rows);
    return ranges;
}

}  // namespace nearfield::plan
