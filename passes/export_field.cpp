#include <engine/gpu/pipeline.hpp>
#include <engine/graph/print.hpp>
#include <passes/export_field.hpp>

#include <shaders/export_field_comp.hpp>

namespace nearfield::passes {
namespace {

constexpr graph::ExternalAccess exported{graph::Access::exported_image,
                                         graph::Access::exported_image};

struct FieldPush {
    std::uint32_t value, feature, stride, width, height;
    std::int32_t column, row;
    std::uint32_t rings, ring_count;
    float cell;
};
static_assert(sizeof(FieldPush) <= ComputeLayout::push_bytes);

}  // namespace

ExportField::ExportField(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::export_field_comp,
                                           "nearfield export field")),
      words_(
          graph_.import_buffer({"field results"}, {graph::Access::storage_write_in_compute, {}})),
      signed_distance_(graph_.import_image({"signed distance", VK_FORMAT_R32_SFLOAT}, exported)),
      feature_(graph_.import_image({"feature id", VK_FORMAT_R32_UINT}, exported)) {
    graph_.add_pass(
        "export field", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, graph::Access::storage_read_in_compute);
            static_cast<void>(
                pass.write(signed_distance_, graph::Access::storage_image_in_compute));
            static_cast<void>(pass.write(feature_, graph::Access::storage_image_in_compute));
        },
        [this](VkCommandBuffer commands) { dispatch(commands); });
    executor_ = graph::make_executor(device, graph_);
}

void ExportField::record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) {
    item_ = item;
    executor_->set_buffer(words_, item.words);
    executor_->set_image(signed_distance_, item.signed_distance);
    executor_->set_image(feature_, item.feature);
    executor_->execute(graph_, commands, timestamps);
}

void ExportField::dispatch(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    for (std::size_t i = 0; i < item_.parts.size(); ++i) {
        const plan::FieldPartOutput& part = item_.parts[i];
        functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                          &item_.sets[i], 0, nullptr);
        const FieldPush push{part.value,
                             part.feature,
                             part.stride,
                             part.width,
                             part.height,
                             static_cast<std::int32_t>(part.column),
                             static_cast<std::int32_t>(part.row),
                             item_.field->rings.first_word,
                             item_.field->rings.count,
                             static_cast<float>(item_.field->cell)};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        dispatch_cells(functions, commands, part.width, part.height);
    }
}

std::string ExportField::print(GraphFormat format) const {
    return graph::print(graph_, executor_->baked(), format);
}

}  // namespace nearfield::passes
