#include <passes/instance_shaders.hpp>

#include <shaders/pair_boxes_comp.hpp>
#include <shaders/pair_levels_comp.hpp>

namespace nearfield::passes {

InstanceShaders::InstanceShaders(const gpu::Device& device, const ComputeLayout& layout)
    : boxes(device, layout, shaders::pair_boxes_comp, "nearfield pair boxes",
            search_constants(device, true)),
      levels(device, layout, shaders::pair_levels_comp, "nearfield pair levels",
             search_constants(device, true)) {}

}  // namespace nearfield::passes
