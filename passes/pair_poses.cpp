#include <passes/pair_poses.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/pair_poses_comp.hpp>
#include <shaders/pairs.h>

namespace nearfield::passes {

using graph::Access;

PairPoses::PairPoses(const gpu::Device& device, const ComputeLayout& layout)
    : functions_(&device.functions()),
      shader_(device, layout, shaders::pair_poses_comp, "nearfield pair poses",
              search_constants(device)),
      poses_(graph_.import_buffer({"poses of the host"},
                                  {.before = Access::storage_write_in_compute})),
      shapes_(graph_.import_buffer({"pair shapes", true, false})),
      // The search before may still read these, and write those.
      instances_(graph_.import_buffer(
          {"pair instances", true, false},
          {.before = Access::storage_read_in_compute, .after = Access::storage_read_in_compute})),
      taken_(graph_.import_buffer({"pair poses", false, true},
                                  {.before = Access::storage_write_in_compute})) {
    graph_.add_pass(
        "clear pair poses", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) { taken_ = pass.write(taken_, Access::transfer_write); },
        [this](VkCommandBuffer commands, const Item& item) {
            // So far there is no pose that cannot be used.
            functions_->vkCmdFillBuffer(commands, item.taken, 0, sizeof(plan::no_instance),
                                        plan::no_instance);
        });
    graph_.add_pass(
        "pair poses", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(poses_, Access::storage_read_in_compute);
            pass.read(shapes_, Access::storage_read_in_compute);
            instances_ = pass.write(instances_, Access::storage_write_in_compute);
            taken_ = pass.write(taken_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shader_.bind(commands, item.set);
            shader_.dispatch_in_parts(commands, 0, item.push.instances, [&](std::uint32_t first) {
                plan::PosePush push = item.push;
                push.first = first;
                shader_.push(commands, push);
            });
        });
    graph_.compile(device);
}

void PairPoses::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                       const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(poses_, item.poses);
    executor.set_buffer(shapes_, item.shapes);
    executor.set_buffer(instances_, item.instances);
    executor.set_buffer(taken_, item.taken);
    graph_.execute(commands, timestamps, item);
}

}  // namespace nearfield::passes
