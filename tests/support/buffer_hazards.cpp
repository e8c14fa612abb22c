#include <tests/support/buffer_hazards.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace nearfield::test_support {
namespace {

constexpr VkAccessFlags on_attachments =
    VK_ACCESS_INPUT_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags any_write = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;

Dependency dependency_of(const VkMemoryBarrier& memory) {
    return {VK_NULL_HANDLE, memory.srcAccessMask, memory.dstAccessMask};
}

Dependency dependency_of(const VkBufferMemoryBarrier& buffer) {
    return {buffer.buffer, buffer.srcAccessMask, buffer.dstAccessMask};
}

std::vector<Dependency> dependencies_of(const RecordedBarrier& barrier) {
    std::vector<Dependency> all;
    const auto add = [&](const auto& each) { all.push_back(dependency_of(each)); };
    std::for_each(barrier.memory.begin(), barrier.memory.end(), add);
    std::for_each(barrier.buffers.begin(), barrier.buffers.end(), add);
    return all;
}

/// One without writes to make visible orders by the barrier's stages, as all of that barrier do.
bool goes_without(const RecordedBarrier& barrier, const Dependency* left_out) {
    const std::vector<Dependency> all = dependencies_of(barrier);
    return left_out != nullptr && left_out->source == 0 &&
           std::find(all.begin(), all.end(), *left_out) != all.end();
}

/// A past access, and the effect of later barriers on it.
struct Event {
    BufferAccess access;
    bool available = false;
    VkPipelineStageFlags before = 0;                        // it happens before these stages
    std::map<VkPipelineStageFlags, VkAccessFlags> visible;  // by stage bit

    void pass(const RecordedBarrier& barrier, const Dependency* left_out) {
        const bool is_source = (barrier.source & access.stage) != 0;
        if ((!is_source && (barrier.source & before) == 0) || goes_without(barrier, left_out)) {
            return;
        }
        bool remains = barrier.has_images;
        const auto pass_by = [&](const Dependency& dependency, bool concerns) {
            const bool is_left_out = left_out != nullptr && dependency == *left_out;
            remains = remains || !is_left_out;
            if (!is_left_out && concerns) {
                apply(barrier.destination, dependency, is_source);
            }
        };
        for (const VkMemoryBarrier& memory : barrier.memory) {
            pass_by(dependency_of(memory), true);
        }
        for (const VkBufferMemoryBarrier& buffer : barrier.buffers) {
            pass_by(dependency_of(buffer), access.range.overlaps(BufferAccesses::range_of(buffer)));
        }
        before |= remains ? barrier.destination : 0;
    }

    void apply(VkPipelineStageFlags stages, const Dependency& dependency, bool is_source) {
        available = available || (is_source && access.writes &&
                                  (dependency.source & access.flags & any_write) != 0);
        for (VkPipelineStageFlags stage = 1; available && stage != 0; stage <<= 1U) {
            if ((stages & stage) != 0) {
                visible[stage] |= dependency.destination;
            }
        }
    }

    [[nodiscard]] bool is_settled_for(VkPipelineStageFlags stage, VkAccessFlags flags) const {
        if ((before & stage) == 0) {
            return false;
        }
        const auto seen = visible.find(stage);
        return !access.writes || (seen != visible.end() && (seen->second & flags) == flags);
    }

    [[nodiscard]] bool is_one_with(const BufferAccess& next) const {
        return access.command == next.command ||
               (access.pipeline != VK_NULL_HANDLE && access.pipeline == next.pipeline &&
                access.barriers_before == next.barriers_before);
    }
};

bool is_for_shaders_of_host(const std::string& name) {
    return name.starts_with("nearfield resident records") ||
           name.starts_with("nearfield resident pair");
}

/// Who reads the buffer after the commands, and how.
std::map<VkPipelineStageFlags, VkAccessFlags> readers_of(VkBuffer buffer) {
    const std::string name = BufferAccesses::name_of(buffer);
    if (name == "nearfield read-back" || name == "nearfield found points" ||
        name == "nearfield search arguments" || name == "nearfield long searches" ||
        name == "nearfield pair points" || name == "nearfield pair rows" ||
        name == "nearfield pair counts" || name == "nearfield pair poses" ||
        name == "nearfield world answers" || name == "nearfield stamp") {
        return {{VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT}};
    }
    if (is_for_shaders_of_host(name)) {
        return {{VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT},
                {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT},
                {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT}};
    }
    return {};
}

std::string described(const BufferAccess& access) {
    return BufferAccesses::name_of(access.range.buffer) + " [" +
           std::to_string(access.range.first) + ", " + std::to_string(access.range.end) + ")";
}

/// The host's draws and dispatches may still read the results of the batch before.
std::vector<Event> reads_of_results(const Recording& recording) {
    std::vector<Event> events;
    std::set<VkBuffer> seen;
    for (const auto& command : recording.commands) {
        const auto* const access = std::get_if<BufferAccess>(&command);
        if (access == nullptr || !seen.insert(access->range.buffer).second ||
            !is_for_shaders_of_host(BufferAccesses::name_of(access->range.buffer))) {
            continue;
        }
        for (const VkPipelineStageFlags stage :
             {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
              VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT}) {
            // Which kind of read it is does not matter to a write after it.
            BufferAccess read{
                {access->range.buffer, 0, VK_WHOLE_SIZE}, stage, VK_ACCESS_SHADER_READ_BIT};
            read.command = UINT32_MAX;
            events.push_back({read, false, 0, {}});
        }
    }
    return events;
}

/// Those of one execution, after the events before it. `number`: of the execution.
void find_in(const Recording& recording, std::uint32_t number, const Dependency* left_out,
             std::vector<Event>& events, std::vector<std::string>& hazards) {
    for (const auto& command : recording.commands) {
        if (const auto* const passed = std::get_if<RecordedBarrier>(&command)) {
            for (Event& event : events) {
                event.pass(*passed, left_out);
            }
            continue;
        }
        BufferAccess next = std::get<BufferAccess>(command);
        next.command += number * recording.next_command;
        next.barriers_before += number * (std::size_t{1} << 32U);
        for (const Event& event : events) {
            if (next.range.overlaps(event.access.range) && (next.writes || event.access.writes) &&
                !event.is_one_with(next) && !event.is_settled_for(next.stage, next.flags)) {
                hazards.push_back(described(next) + ": stage " + std::to_string(next.stage) +
                                  " after " + std::to_string(event.access.stage));
            }
        }
        events.push_back({next, false, 0, {}});
    }
}

void find_in(const Recording& recording, const Dependency* left_out,
             std::vector<std::string>& hazards) {
    std::vector<Event> events = reads_of_results(recording);
    find_in(recording, 0, left_out, events, hazards);
    if (recording.is_submitted_again) {
        find_in(recording, 1, left_out, events, hazards);
    }
    for (const Event& event : events) {
        for (const auto& [stage, flags] : readers_of(event.access.range.buffer)) {
            if (event.access.writes && !event.is_settled_for(stage, flags)) {
                hazards.push_back(described(event.access) + ": stage " + std::to_string(stage) +
                                  " does not see it afterwards");
            }
        }
    }
}

}  // namespace

std::vector<std::string> find_hazards(std::span<const Recording> recordings,
                                      const Dependency* left_out) {
    std::vector<std::string> hazards;
    for (const Recording& recording : recordings) {
        find_in(recording, left_out, hazards);
    }
    return hazards;
}

std::vector<Dependency> dependencies(std::span<const Recording> recordings) {
    std::vector<Dependency> all;
    for (const Recording& recording : recordings) {
        for (const auto& command : recording.commands) {
            const auto* const barrier = std::get_if<RecordedBarrier>(&command);
            if (barrier == nullptr) {
                continue;
            }
            for (const Dependency& dependency : dependencies_of(*barrier)) {
                if (((dependency.source | dependency.destination) & ~on_attachments) != 0 &&
                    std::find(all.begin(), all.end(), dependency) == all.end()) {
                    all.push_back(dependency);
                }
            }
        }
    }
    return all;
}

}  // namespace nearfield::test_support
