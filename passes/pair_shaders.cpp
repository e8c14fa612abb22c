#include <passes/pair_shaders.hpp>

#include <shaders/pair_contacts_comp.hpp>
#include <shaders/pair_counts_comp.hpp>
#include <shaders/pair_crossings_comp.hpp>
#include <shaders/pair_directions_comp.hpp>
#include <shaders/pair_lists_comp.hpp>
#include <shaders/pair_rows_comp.hpp>
#include <shaders/pair_summaries_comp.hpp>
#include <shaders/pair_verdicts_comp.hpp>

namespace nearfield::passes {
namespace {

ComputeShader make_pair_shader(const gpu::Device& device, const ComputeLayout& layout,
                               gpu::Spirv code, const char* name) {
    return {device, layout, code, name, search_constants(device, true)};
}

}  // namespace

PairShaders::PairShaders(const gpu::Device& device, const ComputeLayout& layout,
                         const InstanceShaders* instance_shaders)
    : instances(*instance_shaders),
      search(device, layout, true, "nearfield pair"),
      counts(make_pair_shader(device, layout, shaders::pair_counts_comp, "nearfield pair counts")),
      lists(make_pair_shader(device, layout, shaders::pair_lists_comp, "nearfield pair lists")),
      directions(make_pair_shader(device, layout, shaders::pair_directions_comp,
                                  "nearfield pair directions")),
      summaries(make_pair_shader(device, layout, shaders::pair_summaries_comp,
                                 "nearfield pair summaries")),
      contacts(
          make_pair_shader(device, layout, shaders::pair_contacts_comp, "nearfield pair contacts")),
      crossings(make_pair_shader(device, layout, shaders::pair_crossings_comp,
                                 "nearfield pair crossings")),
      verdicts(
          make_pair_shader(device, layout, shaders::pair_verdicts_comp, "nearfield pair verdicts")),
      rows(make_pair_shader(device, layout, shaders::pair_rows_comp, "nearfield pair rows")) {}

}  // namespace nearfield::passes
