#include <passes/color_fill.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fill.hpp>
#include <passes/resolve_field.hpp>

#include <shaders/resolve_field_comp.hpp>

#include <algorithm>
#include <functional>

namespace nearfield::passes {

void FieldImages::declare_reads(graph::PassBuilder& pass) const {
    std::array<graph::Handle, 2 * plan::sign_encodings> seen;
    std::size_t count = 0;
    for (const Pair& pair : by_encoding) {
        for (const graph::Handle handle : {pair.features, pair.sign}) {
            if (handle != graph::Handle{} &&
                std::find(seen.begin(), seen.begin() + count, handle) == seen.begin() + count) {
                seen[count++] = handle;
                pass.read(handle, graph::Access::sampled_in_compute);
            }
        }
    }
}

std::uint32_t sign_mask(SignEncoding encoding) {
    switch (encoding) {
        case SignEncoding::color:
            return white_mask;
        case SignEncoding::feature_bit:
            return plan::feature_bit_mask;
        case SignEncoding::stencil:
            break;
    }
    return filled_mask;
}

ResolveField::ResolveField(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::resolve_field_comp, "nearfield resolve field") {}

graph::Handle ResolveField::declare(TileGraph& graph, graph::Handle input,
                                    const FieldImages& images, graph::Handle field) const {
    graph.add_pass(
        "resolve field", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            images.declare_reads(pass);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        std::bind_front(&ResolveField::record, this));
    return field;
}

void ResolveField::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands);
    for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
        const auto sign = static_cast<SignEncoding>(encoding);
        if (!context.batch->raster.groups[plan::group_list(sign)].empty()) {
            shader_.bind_set(commands, context.field_set(sign));
            shader_.dispatch_groups<plan::ResolveFieldPush>(commands, *context.batch,
                                                            plan::group_list(sign), sign_mask(sign),
                                                            context.batch->resident ? 1U : 0U);
        }
    }
}

}  // namespace nearfield::passes
