#include <passes/search_shaders.hpp>

#include <shaders/pair_boxes_comp.hpp>
#include <shaders/pair_contacts_comp.hpp>
#include <shaders/pair_counts_comp.hpp>
#include <shaders/pair_crossings_comp.hpp>
#include <shaders/pair_directions_comp.hpp>
#include <shaders/pair_levels_comp.hpp>
#include <shaders/pair_lists_comp.hpp>
#include <shaders/pair_rows_comp.hpp>
#include <shaders/pair_summaries_comp.hpp>
#include <shaders/pair_verdicts_comp.hpp>
#include <shaders/search_edges_comp.hpp>
#include <shaders/search_items_comp.hpp>
#include <shaders/search_pack_comp.hpp>
#include <shaders/search_points_comp.hpp>
#include <shaders/search_scan_comp.hpp>
#include <shaders/search_spread_comp.hpp>

namespace nearfield::passes {
InstanceShaders::InstanceShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : boxes(device, layout, shaders::pair_boxes_comp, "nearfield pair boxes"),
      levels(device, layout, shaders::pair_levels_comp, "nearfield pair levels") {}

SearchShaders::SearchShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : items(device, layout, shaders::search_items_comp, "nearfield pair items"),
      scan(device, layout, shaders::search_scan_comp, "nearfield pair scan"),
      spread(device, layout, shaders::search_spread_comp, "nearfield pair spread"),
      edges(device, layout, shaders::search_edges_comp, "nearfield pair edges"),
      points(device, layout, shaders::search_points_comp, "nearfield pair points"),
      summaries(device, layout, shaders::pair_summaries_comp, "nearfield pair summaries"),
      pack(device, layout, shaders::search_pack_comp, "nearfield pair packing"),
      rows(device, layout, shaders::pair_rows_comp, "nearfield pair rows") {}

FoundPairShaders::FoundPairShaders(const gpu::Device& device, const graph::ComputeLayout& layout,
                                   const InstanceShaders* instance_shaders)
    : instances(*instance_shaders),
      counts(device, layout, shaders::pair_counts_comp, "nearfield pair counts"),
      lists(device, layout, shaders::pair_lists_comp, "nearfield pair lists"),
      directions(device, layout, shaders::pair_directions_comp, "nearfield pair directions"),
      contacts(device, layout, shaders::pair_contacts_comp, "nearfield pair contacts"),
      crossings(device, layout, shaders::pair_crossings_comp, "nearfield pair crossings"),
      verdicts(device, layout, shaders::pair_verdicts_comp, "nearfield pair verdicts") {}

}  // namespace nearfield::passes
