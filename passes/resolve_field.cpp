#include <passes/color_fill.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fill.hpp>
#include <passes/resolve_field.hpp>

#include <shaders/resolve_field_comp.hpp>

#include <algorithm>
#include <functional>
#include <utility>

namespace nearfield::passes {

graph::Handle FieldImages::add_pass(TileGraph& graph, const char* name, graph::Handle input,
                                    graph::Handle field, TileGraph::Record record) const {
    graph.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            std::array<graph::Handle, 2 * plan::sign_encodings> seen;
            std::size_t count = 0;
            for (const Pair& pair : by_encoding) {
                for (const graph::Handle handle : {pair.features, pair.sign}) {
                    const auto end = seen.begin() + count;
                    if (handle != graph::Handle{} && std::find(seen.begin(), end, handle) == end) {
                        seen[count++] = handle;
                        pass.read(handle, graph::Access::sampled_in_compute);
                    }
                }
            }
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        std::move(record));
    return field;
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
    return images.add_pass(graph, "resolve field", input, field,
                           std::bind_front(&ResolveField::record, this));
}

void ResolveField::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands);
    for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
        const auto sign = static_cast<SignEncoding>(encoding);
        if (!context.batch.raster.groups[plan::group_list(sign)].empty()) {
            shader_.bind_set(commands, context.sets.field_by(sign));
            shader_.dispatch_groups<plan::ResolveFieldPush>(commands, context.batch,
                                                            plan::group_list(sign), sign_mask(sign),
                                                            context.batch.resident ? 1U : 0U);
        }
    }
}

}  // namespace nearfield::passes
