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

ShaderOfQuestion shader_of(device_input::WorldQuestion question) {
    switch (question) {
        case device_input::WorldQuestion::rays:
            return {shaders::world_rays_comp, "first hits"};
        case device_input::WorldQuestion::nearest:
            return {shaders::world_nearest_comp, "nearest instances"};
        case device_input::WorldQuestion::poses:
            break;
    }
    return {shaders::world_poses_comp, "pose tests"};
}

ComputeShader make_query_shader(const gpu::Device& device, const graph::ComputeLayout& layout,
                                const ShaderOfQuestion& shader) {
    const std::string name = std::string("nearfield ") + shader.pass;
    return {device, layout, shader.code, name.c_str()};
}

/// What the shaders of the instances take of their push constants.
shaders::SearchPush push_of_boxes(const shaders::WorldQueryPush& push) {
    shaders::SearchPush boxes{};
    boxes.instances = push.instances;
    boxes.boxes = push.boxes;
    return boxes;
}

}  // namespace

WorldQueries::WorldQueries(const gpu::Device& device, const graph::ComputeLayout& layout,
                           const InstanceShaders* instance_shaders,
                           device_input::WorldQuestion question)
    : shader(make_query_shader(device, layout, shader_of(question))),
      shapes(graph.import_buffer({"shapes", true, false})),
      instances(graph.import_buffer({"instances", true, false})),
      questions(graph.import_buffer({"questions", true, false})),
      scratch(graph.import_buffer({"scratch"})),
      answers(graph.import_buffer({"answers", false, true})) {
    graph::Handle boxes_and_answers = scratch;
    add_pass(graph, "instance boxes", instance_shaders->boxes,
             {{0, shapes}, {2, instances}, {1, boxes_and_answers, write}},
             [](const ComputeShader& boxes, VkCommandBuffer commands, const Input& input) {
                 boxes.dispatch_in_parts(commands, 0, input.push.instances,
                                         push_of_boxes(input.push));
             });
    add_pass(graph, "instance levels", instance_shaders->levels, {{1, boxes_and_answers, write}},
             [](const ComputeShader& levels, VkCommandBuffer commands, const Input& input) {
                 levels.push(commands, push_of_boxes(input.push));
                 levels.dispatch(commands, 1);
             });
    add_pass(graph, shader_of(question).pass, shader,
             {{0, shapes}, {2, instances}, {3, questions}, {1, boxes_and_answers, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const Input& input) {
                 of.dispatch_in_parts(commands, 0, input.push.count, input.push);
             });
    graph.add_pass(
        "copy answers", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(boxes_and_answers, Access::transfer_read);
            static_cast<void>(pass.write(answers, Access::transfer_write));
        },
        [this, functions = &device.functions()](const graph::PassCommands& commands,
                                                const Input& input) {
            functions->vkCmdCopyBuffer(commands, commands.part(scratch).buffer,
                                       commands.part(answers).buffer, 1, &input.copy);
        });
    graph.compile(device);
}

}  // namespace nearfield::passes
