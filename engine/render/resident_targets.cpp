#include <engine/graph/access.hpp>
#include <engine/render/resident_targets.hpp>

namespace nearfield::render {
namespace {

graph::ExternalUse use_of(const TargetState& state) {
    return {state.stages, state.access, state.layout};
}

template <class Output>
VkPipelineStageFlags readers_of(const std::vector<Output>& outputs) {
    VkPipelineStageFlags stages = 0;
    for (const Output& output : outputs) {
        if (output.target.buffer != VK_NULL_HANDLE) {
            stages |= output.target.after.stages;
        }
    }
    return stages;
}

}  // namespace

graph::ImportedImage imported_image(const ResidentImageTarget& target, VkImage own) {
    if (target.image == VK_NULL_HANDLE) {
        return {own};
    }
    return {target.image, target.level, target.layer,
            graph::ExternalUses{use_of(target.before), use_of(target.after)}};
}

BufferPart range_of_target(const ResidentBufferTarget& target, const BufferPart& own) {
    return target.buffer == VK_NULL_HANDLE ? own
                                           : BufferPart{target.buffer, target.offset, own.bytes};
}

graph::ImportedBuffer imported_buffer(const ResidentBufferTarget& target, const BufferPart& range) {
    if (target.buffer == VK_NULL_HANDLE) {
        return {range.buffer};
    }
    graph::ExternalUses uses{use_of(target.before), use_of(target.after)};
    const graph::AccessTraits& read = graph::traits(graph::Access::storage_read_in_compute);
    uses.after.stages |= read.stages;
    uses.after.access |= read.access();
    return {range.buffer, range.offset, range.bytes, uses};
}

VkPipelineStageFlags readers_of_targets(const plan::ResidentOutputs& resident) {
    return readers_of(resident.records) | readers_of(resident.samples);
}

}  // namespace nearfield::render
