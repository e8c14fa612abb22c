#include <passes/copy_back.hpp>

namespace nearfield::passes {

CopyBack::CopyBack(const gpu::Device& device)
    : device_(&device),
      words_(graph_.import_buffer({"words"}, {graph::Access::storage_write_in_compute, {}})),
      read_back_(graph_.import_buffer({"read-back", false, true})) {
    graph_.add_pass(
        "copy back", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, graph::Access::transfer_read);
            static_cast<void>(pass.write(read_back_, graph::Access::transfer_write));
        },
        [this](VkCommandBuffer commands) {
            device_->functions().vkCmdCopyBuffer(
                commands, from_, to_, static_cast<std::uint32_t>(ranges_.size()), ranges_.data());
        });
    executor_ = graph::make_executor(device, graph_);
}

void CopyBack::record(VkCommandBuffer commands, gpu::Timestamps& timestamps, VkBuffer words,
                      VkBuffer read_back, std::span<const VkBufferCopy> ranges) {
    from_ = words;
    to_ = read_back;
    ranges_ = ranges;
    executor_->set_buffer(words_, words);
    executor_->set_buffer(read_back_, read_back);
    executor_->execute(graph_, commands, timestamps);
}

}  // namespace nearfield::passes
