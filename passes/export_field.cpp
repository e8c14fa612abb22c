#include <passes/export_field.hpp>

#include <shaders/export_field_comp.hpp>

#include <functional>

namespace nearfield::passes {
namespace {

constexpr graph::ExternalAccess exported{graph::Access::exported_image,
                                         graph::Access::exported_image};

}  // namespace

ExportField::ExportField(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::export_field_comp, "nearfield export field"),
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
        std::bind_front(&ExportField::dispatch, this));
    graph_.compile(device);
}

void ExportField::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                         const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(words_, item.words);
    executor.set_image(signed_distance_, item.signed_distance);
    executor.set_image(feature_, item.feature);
    graph_.execute(commands, timestamps, item);
}

void ExportField::dispatch(VkCommandBuffer commands, const Item& item) const {
    shader_.bind(commands);
    for (std::size_t i = 0; i < item.parts.size(); ++i) {
        const plan::FieldPartOutput& part = item.parts[i];
        shader_.bind_set(commands, item.sets[i]);
        const plan::ExportFieldPush push{part.value,
                                         part.feature,
                                         part.stride,
                                         part.width,
                                         part.height,
                                         static_cast<std::int32_t>(part.column),
                                         static_cast<std::int32_t>(part.row),
                                         item.field->rings.first_word,
                                         item.field->rings.count,
                                         static_cast<float>(item.field->cell)};
        shader_.push(commands, push);
        shader_.dispatch_cells(commands, part.width, part.height);
    }
}

}  // namespace nearfield::passes
