#include <passes/search_shaders.hpp>

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

ComputeShader make_shader(const gpu::Device& device, const ComputeLayout& layout, gpu::Spirv code,
                          const std::string& name, bool finds_pairs) {
    return {device, layout, code, name.c_str(), search_constants(device, finds_pairs)};
}

}  // namespace

std::array<VkBool32, 2> search_constants(const gpu::Device& device, bool finds_pairs) {
    return {reads_texels(device) ? VK_TRUE : VK_FALSE, finds_pairs ? VK_TRUE : VK_FALSE};
}

SearchShaders::SearchShaders(const gpu::Device& device, const ComputeLayout& layout,
                             bool finds_pairs, const std::string& prefix)
    : items(
          make_shader(device, layout, shaders::search_items_comp, prefix + " items", finds_pairs)),
      scan(make_shader(device, layout, shaders::search_scan_comp, prefix + " scan", finds_pairs)),
      spread(make_shader(device, layout, shaders::search_spread_comp, prefix + " spread",
                         finds_pairs)),
      edges(
          make_shader(device, layout, shaders::search_edges_comp, prefix + " edges", finds_pairs)),
      points(make_shader(device, layout, shaders::search_points_comp, prefix + " points",
                         finds_pairs)),
      pack(make_shader(device, layout, shaders::search_pack_comp, prefix + " packing",
                       finds_pairs)) {}

}  // namespace nearfield::passes
