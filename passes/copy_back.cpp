#include <passes/copy_back.hpp>

namespace nearfield::passes {

CopyBack::CopyBack(const gpu::Device& device)
    : words_(graph_.import_buffer({"words"}, {graph::Access::storage_write_in_compute, {}})),
      read_back_(graph_.import_buffer({"read-back", false, true})) {
    graph_.add_pass(
        "copy back", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, graph::Access::transfer_read);
            static_cast<void>(pass.write(read_back_, graph::Access::transfer_write));
        },
        [&device](VkCommandBuffer commands, const Item& item) {
            device.functions().vkCmdCopyBuffer(commands, item.words, item.read_back,
                                               static_cast<std::uint32_t>(item.ranges.size()),
                                               item.ranges.data());
        });
    graph_.compile(device);
}

void CopyBack::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                      const Item& item) const {
    graph_.executor().set_buffer(words_, item.words);
    graph_.executor().set_buffer(read_back_, item.read_back);
    graph_.execute(commands, timestamps, item);
}

}  // namespace nearfield::passes
