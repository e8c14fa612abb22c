#include <passes/world_queries.hpp>

#include <shaders/world_nearest_comp.hpp>
#include <shaders/world_poses_comp.hpp>
#include <shaders/world_rays_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

struct ShaderOfQuestion {
    gpu::Spirv code;
    const char* pass;
};

ShaderOfQuestion shader_of(plan::WorldQuestion question) {
    switch (question) {
        case plan::WorldQuestion::rays:
            return {shaders::world_rays_comp, "first hits"};
        case plan::WorldQuestion::nearest:
            return {shaders::world_nearest_comp, "nearest instances"};
        case plan::WorldQuestion::poses:
            break;
    }
    return {shaders::world_poses_comp, "pose tests"};
}

ComputeShader make_query_shader(const gpu::Device& device, const ComputeLayout& layout,
                                const ShaderOfQuestion& shader) {
    const std::string name = std::string("nearfield ") + shader.pass;
    return {device, layout, shader.code, name.c_str(), search_constants(device)};
}

/// What the shaders of the instances take of their push constants.
plan::SearchPush push_of_boxes(const plan::WorldQueryPush& push, std::uint32_t first) {
    plan::SearchPush boxes{};
    boxes.first = first;
    boxes.instances = push.instances;
    boxes.boxes = push.boxes;
    return boxes;
}

}  // namespace

WorldQueries::WorldQueries(const gpu::Device& device, const ComputeLayout& layout,
                           const InstanceShaders* instance_shaders, plan::WorldQuestion question)
    : functions_(&device.functions()),
      instance_shaders_(instance_shaders),
      shader_(make_query_shader(device, layout, shader_of(question))),
      shapes_(graph_.import_buffer({"shapes", true, false})),
      instances_(graph_.import_buffer({"instances", true, false})),
      questions_(graph_.import_buffer({"questions", true, false})),
      scratch_(graph_.import_buffer({"scratch"})),
      answers_(graph_.import_buffer({"answers", false, true})) {
    graph_.add_pass(
        "instance boxes", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(shapes_, Access::storage_read_in_compute);
            pass.read(instances_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            const ComputeShader& boxes = instance_shaders_->boxes;
            boxes.bind(commands, item.set);
            boxes.dispatch_in_parts(commands, 0, item.push.instances, [&](std::uint32_t first) {
                boxes.push(commands, push_of_boxes(item.push, first));
            });
        });
    scratch_ = graph_.add_compute_pass("instance levels", {}, scratch_,
                                       [this](VkCommandBuffer commands, const Item& item) {
                                           const ComputeShader& levels = instance_shaders_->levels;
                                           levels.bind(commands, item.set);
                                           levels.push(commands, push_of_boxes(item.push, 0));
                                           levels.dispatch(commands, 1);
                                       });
    graph_.add_pass(
        shader_of(question).pass, graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(shapes_, Access::storage_read_in_compute);
            pass.read(instances_, Access::storage_read_in_compute);
            pass.read(questions_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shader_.bind(commands, item.set);
            shader_.dispatch_in_parts(commands, 0, item.push.count, [&](std::uint32_t first) {
                plan::WorldQueryPush push = item.push;
                push.first = first;
                shader_.push(commands, push);
            });
        });
    graph_.add_pass(
        "copy answers", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(scratch_, Access::transfer_read);
            static_cast<void>(pass.write(answers_, Access::transfer_write));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            functions_->vkCmdCopyBuffer(commands, item.scratch, item.answers, 1, &item.copy);
        });
    graph_.compile(device);
}

void WorldQueries::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                          const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(shapes_, item.shapes);
    executor.set_buffer(instances_, item.instances);
    executor.set_buffer(questions_, item.questions);
    executor.set_buffer(scratch_, item.scratch);
    executor.set_buffer(answers_, item.answers);
    graph_.execute(commands, timestamps, item);
}

}  // namespace nearfield::passes
