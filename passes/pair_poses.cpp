#include <passes/pair_poses.hpp>

#include <shaders/pair_poses_comp.hpp>
#include <shaders/pairs.h>

namespace nearfield::passes {

using graph::Access;

PairPoses::PairPoses(const gpu::Device& device, const graph::ComputeLayout& layout)
    : shader(device, layout, shaders::pair_poses_comp, "nearfield pair poses"),
      poses(graph.import_buffer({"poses of the host"}, {.before = write})),
      shapes(graph.import_buffer({"pair shapes", true, false})),
      // The search before may still read these, and write those.
      instances(
          graph.import_buffer({"pair instances", true, false}, {.before = read, .after = read})),
      taken(graph.import_buffer({"pair poses", false, true}, {.before = write})) {
    graph::Handle placed = instances;
    graph::Handle for_cpu = taken;
    graph.add_pass(
        "clear pair poses", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) { for_cpu = pass.write(for_cpu, Access::transfer_write); },
        [this, functions = &device.functions()](const graph::PassCommands& commands,
                                                const shaders::PosePush&) {
            // So far there is no pose that cannot be used.
            functions->vkCmdFillBuffer(commands, commands.part(taken).buffer, 0,
                                       sizeof(shaders::no_instance), shaders::no_instance);
        });
    add_pass(graph, "pair poses", shader,
             {{1, poses}, {0, shapes}, {2, placed, write}, {3, for_cpu, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const shaders::PosePush& all) {
                 of.dispatch_in_parts(commands, 0, all.instances, all);
             });
    graph.compile(device);
}

}  // namespace nearfield::passes
