#include <engine/graph/access.hpp>

#include <array>
#include <cstddef>

namespace nearfield::graph {

namespace {

// The stages that every device has without a feature.
constexpr VkPipelineStageFlags shaders_of_users = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                                  VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                                  VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;

// What a queue family lacks that does not draw.
constexpr VkPipelineStageFlags stages_of_drawing =
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
    VK_PIPELINE_STAGE_TESSELLATION_CONTROL_SHADER_BIT |
    VK_PIPELINE_STAGE_TESSELLATION_EVALUATION_SHADER_BIT | VK_PIPELINE_STAGE_GEOMETRY_SHADER_BIT |
    VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
    VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
    VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
constexpr VkAccessFlags accesses_of_drawing =
    VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT |
    VK_ACCESS_INPUT_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

bool draws(VkQueueFlags queue) {
    return (queue & VK_QUEUE_GRAPHICS_BIT) != 0;
}

// Attachments are read as well as written: load operations, blending, logic operations and tests
// depend on the previous content. All reads of images share one layout, and all reads of one kind
// of resource differ in their stages; so a read after a read needs no check of the layout.
constexpr std::array<AccessTraits, 14> accesses = {{
    {.name = "color_attachment",
     .stages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     .read_access = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT,
     .write_access = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
     .writes = true,
     .of_image = true,
     .pass_kind = PassKind::graphics},
    {.name = "depth_stencil_attachment",
     .stages =
         VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
     .read_access = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     .write_access = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
     .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
     .writes = true,
     .of_image = true,
     .pass_kind = PassKind::graphics},
    {.name = "sampled_in_compute",
     .stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     .read_access = VK_ACCESS_SHADER_READ_BIT,
     .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
     .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
     .of_image = true,
     .pass_kind = PassKind::compute},
    {.name = "storage_read_in_compute",
     .stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     .read_access = VK_ACCESS_SHADER_READ_BIT,
     .pass_kind = PassKind::compute},
    {.name = "storage_write_in_compute",
     .stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     .read_access = VK_ACCESS_SHADER_READ_BIT,
     .write_access = VK_ACCESS_SHADER_WRITE_BIT,
     .writes = true,
     .pass_kind = PassKind::compute},
    {.name = "vertex_buffer",
     .stages = VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
     .read_access = VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT,
     .pass_kind = PassKind::graphics},
    {.name = "transfer_write",
     .stages = VK_PIPELINE_STAGE_TRANSFER_BIT,
     .write_access = VK_ACCESS_TRANSFER_WRITE_BIT,
     .writes = true,
     .pass_kind = PassKind::compute},
    {.name = "storage_read_in_fragment",
     .stages = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
     .read_access = VK_ACCESS_SHADER_READ_BIT,
     .pass_kind = PassKind::graphics},
    {.name = "transfer_read",
     .stages = VK_PIPELINE_STAGE_TRANSFER_BIT,
     .read_access = VK_ACCESS_TRANSFER_READ_BIT,
     .pass_kind = PassKind::compute},
    {.name = "storage_image_in_compute",
     .stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     .write_access = VK_ACCESS_SHADER_WRITE_BIT,
     .layout = VK_IMAGE_LAYOUT_GENERAL,
     .usage = VK_IMAGE_USAGE_STORAGE_BIT,
     .writes = true,
     .of_image = true,
     .pass_kind = PassKind::compute},
    {.name = "indirect_arguments",
     .stages = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
     .read_access = VK_ACCESS_INDIRECT_COMMAND_READ_BIT,
     .pass_kind = PassKind::compute},
    {.name = "written_arguments",
     .stages = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     .read_access = VK_ACCESS_INDIRECT_COMMAND_READ_BIT,
     .write_access = VK_ACCESS_SHADER_WRITE_BIT,
     .writes = true,
     .pass_kind = PassKind::compute},
    {.name = "exported_buffer",
     .stages = shaders_of_users | VK_PIPELINE_STAGE_VERTEX_INPUT_BIT |
               VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
     .read_access = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT |
                    VK_ACCESS_INDIRECT_COMMAND_READ_BIT},
    {.name = "exported_image",
     .stages = shaders_of_users,
     .read_access = VK_ACCESS_SHADER_READ_BIT,
     .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
     .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
     .of_image = true},
}};

}  // namespace

const AccessTraits& traits(Access access) noexcept {
    return accesses[static_cast<std::size_t>(access)];
}

AccessTraits traits(Access access, VkQueueFlags queue) noexcept {
    AccessTraits on_queue = traits(access);
    on_queue.stages = stages_on(on_queue.stages, queue);
    on_queue.read_access = access_on(on_queue.read_access, queue);
    on_queue.write_access = access_on(on_queue.write_access, queue);
    return on_queue;
}

VkPipelineStageFlags stages_on(VkPipelineStageFlags stages, VkQueueFlags queue) noexcept {
    return draws(queue) ? stages : stages & ~stages_of_drawing;
}

VkAccessFlags access_on(VkAccessFlags access, VkQueueFlags queue) noexcept {
    return draws(queue) ? access : access & ~accesses_of_drawing;
}

}  // namespace nearfield::graph
