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
namespace {

// Shaders read the input as texels where these can address as much as a storage buffer.
bool reads_texels(const gpu::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    return limits.maxTexelBufferElements >= limits.maxStorageBufferRange / plan::bytes_of_unit;
}

ComputeShader make_search_shader(const gpu::Device& device, const graph::ComputeLayout& layout,
                                 gpu::Spirv code, const char* name) {
    return {device, layout, code, name, search_constants(device)};
}

}  // namespace

std::array<VkBool32, 1> search_constants(const gpu::Device& device) {
    return {reads_texels(device) ? VK_TRUE : VK_FALSE};
}

InstanceShaders::InstanceShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : boxes(make_search_shader(device, layout, shaders::pair_boxes_comp, "nearfield pair boxes")),
      levels(
          make_search_shader(device, layout, shaders::pair_levels_comp, "nearfield pair levels")) {}

SearchShaders::SearchShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : items(make_search_shader(device, layout, shaders::search_items_comp, "nearfield pair items")),
      scan(make_search_shader(device, layout, shaders::search_scan_comp, "nearfield pair scan")),
      spread(
          make_search_shader(device, layout, shaders::search_spread_comp, "nearfield pair spread")),
      edges(make_search_shader(device, layout, shaders::search_edges_comp, "nearfield pair edges")),
      points(
          make_search_shader(device, layout, shaders::search_points_comp, "nearfield pair points")),
      summaries(make_search_shader(device, layout, shaders::pair_summaries_comp,
                                   "nearfield pair summaries")),
      pack(make_search_shader(device, layout, shaders::search_pack_comp, "nearfield pair packing")),
      rows(make_search_shader(device, layout, shaders::pair_rows_comp, "nearfield pair rows")) {}

FoundPairShaders::FoundPairShaders(const gpu::Device& device, const graph::ComputeLayout& layout,
                                   const InstanceShaders* instance_shaders)
    : instances(*instance_shaders),
      counts(
          make_search_shader(device, layout, shaders::pair_counts_comp, "nearfield pair counts")),
      lists(make_search_shader(device, layout, shaders::pair_lists_comp, "nearfield pair lists")),
      directions(make_search_shader(device, layout, shaders::pair_directions_comp,
                                    "nearfield pair directions")),
      contacts(make_search_shader(device, layout, shaders::pair_contacts_comp,
                                  "nearfield pair contacts")),
      crossings(make_search_shader(device, layout, shaders::pair_crossings_comp,
                                   "nearfield pair crossings")),
      verdicts(make_search_shader(device, layout, shaders::pair_verdicts_comp,
                                  "nearfield pair verdicts")) {}

}  // namespace nearfield::passes
