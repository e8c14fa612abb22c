// A host with Vulkan-Hpp and an allocator of its own, which nearfield uses too: nearfield's
// contacts stay on the device, and a shader of the host counts them, as many as there are, in the
// same command buffer.
#include "arena.hpp"

#include <nearfield/vulkan.hpp>

#include <count_contacts.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t frames_in_flight = 2;

template <class Value>
Value value_of(nearfield::Expected<Value> expected) {
    if (!expected) {
        throw std::runtime_error(expected.error().text());
    }
    return std::move(*expected);
}

/// The device and everything that the host made before it knew of nearfield.
struct Engine {
    vk::raii::Context loader;
    vk::raii::Instance instance = nullptr;
    vk::raii::PhysicalDevice physical_device = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    std::uint32_t family = 0;

    Engine() {
        const vk::ApplicationInfo application("host", 1, nullptr, 0, VK_API_VERSION_1_1);
        instance = vk::raii::Instance(loader, vk::InstanceCreateInfo({}, &application));
        choose_device();
        const float priority = 1.0F;
        const vk::DeviceQueueCreateInfo queues({}, family, 1, &priority);
        device = vk::raii::Device(physical_device, vk::DeviceCreateInfo({}, queues));
        queue = device.getQueue(family, 0);
    }

    /// The first device that nearfield can use, and a queue family.
    void choose_device() {
        for (vk::raii::PhysicalDevice& each : vk::raii::PhysicalDevices(instance)) {
            nearfield::PhysicalDevice asked;
            asked.instance = *instance;
            asked.physical_device = *each;
            asked.get_instance_proc_addr = vkGetInstanceProcAddr;
            asked.api_version = VK_API_VERSION_1_1;
            const nearfield::Requirements needed = value_of(nearfield::requirements(asked));
            if (needed.met()) {
                family = *needed.queue_family;
                physical_device = std::move(each);
                return;
            }
        }
        throw std::runtime_error("no device meets the requirements");
    }

    [[nodiscard]] nearfield::HostDevice host() const {
        nearfield::HostDevice host;
        host.instance = *instance;
        host.physical_device = *physical_device;
        host.device = *device;
        host.queue = *queue;
        host.queue_family = family;
        host.get_instance_proc_addr = vkGetInstanceProcAddr;
        return host;
    }
};

/// A mapped storage buffer of the host's.
struct Buffer {
    vk::raii::Buffer buffer = nullptr;
    std::byte* data = nullptr;

    Buffer() = default;
    Buffer(const Engine& engine, Arena& arena, std::uint64_t bytes)
        : buffer(engine.device,
                 vk::BufferCreateInfo({}, bytes, vk::BufferUsageFlagBits::eStorageBuffer)) {
        const Arena::Piece piece = arena.take(
            buffer.getMemoryRequirements(),
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 0, false);
        buffer.bindMemory(*piece.block->memory, piece.offset);
        data = piece.data();
    }
};

struct Counts {
    std::uint32_t all = 0;
    std::uint32_t inside = 0;
};

/// What the host has of each frame in flight.
struct Frame {
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::Fence fence = nullptr;
    nearfield::Ticket ticket;
    nearfield::QueryHandle<nearfield::ContactQuery> contacts;
    std::uint32_t slot = 0;  // that the ticket's results lie in
};

/// What the host has of each of nearfield's slots, which need not come in the order of the frames.
struct Slot {
    vk::raii::DescriptorSet set = nullptr;
    Buffer counts;
    std::uint64_t revision = 0;
};

/// The host's pass over the contacts.
class CountingPass {
public:
    explicit CountingPass(const Engine& engine)
        : device_(&engine.device),
          layout_(make_layout(engine.device)),
          pipeline_layout_(engine.device, vk::PipelineLayoutCreateInfo({}, *layout_)),
          pipeline_(make_pipeline(engine.device)),
          pool_(make_pool(engine.device)) {}

    [[nodiscard]] vk::raii::DescriptorSet make_set() const {
        return std::move(
            vk::raii::DescriptorSets(*device_, vk::DescriptorSetAllocateInfo(*pool_, *layout_))
                .front());
    }
    void write(Slot& slot, const nearfield::PointsOnDevice& contacts) const {
        // The size is that of one frame's records; the set outlasts it.
        const vk::DescriptorBufferInfo records(contacts.buffer, contacts.offset, VK_WHOLE_SIZE);
        const vk::DescriptorBufferInfo counts(*slot.counts.buffer, 0, sizeof(Counts));
        constexpr auto storage = vk::DescriptorType::eStorageBuffer;
        device_->updateDescriptorSets(
            {{*slot.set, 0, 0, storage, {}, records}, {*slot.set, 1, 0, storage, {}, counts}}, {});
        slot.revision = contacts.slot.revision;
    }
    /// No barrier comes before it: nearfield's last one makes the records visible.
    void record(const vk::raii::CommandBuffer& commands, const vk::raii::DescriptorSet& set,
                const nearfield::HeaderOnDevice& header) const {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pipeline_layout_, 0, *set,
                                    {});
        commands.dispatchIndirect(header.buffer,
                                  header.offset + offsetof(nearfield::HeaderData, groups));
        const vk::MemoryBarrier to_host(vk::AccessFlagBits::eShaderWrite,
                                        vk::AccessFlagBits::eHostRead);
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader,
                                 vk::PipelineStageFlagBits::eHost, {}, to_host, {}, {});
    }

private:
    static vk::raii::DescriptorSetLayout make_layout(const vk::raii::Device& device) {
        constexpr auto storage = vk::DescriptorType::eStorageBuffer;
        constexpr auto compute = vk::ShaderStageFlagBits::eCompute;
        const std::array bindings{vk::DescriptorSetLayoutBinding(0, storage, 1, compute),
                                  vk::DescriptorSetLayoutBinding(1, storage, 1, compute)};
        return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    }
    static vk::raii::DescriptorPool make_pool(const vk::raii::Device& device) {
        const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, 2 * frames_in_flight);
        constexpr auto freed = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet;
        return {device, vk::DescriptorPoolCreateInfo(freed, frames_in_flight, size)};
    }
    [[nodiscard]] vk::raii::Pipeline make_pipeline(const vk::raii::Device& device) const {
        const vk::raii::ShaderModule shader(
            device, vk::ShaderModuleCreateInfo({}, sizeof(count_contacts), count_contacts));
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute,
                                                      *shader, "main");
        return {device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *pipeline_layout_)};
    }

    const vk::raii::Device* device_;
    vk::raii::DescriptorSetLayout layout_;
    vk::raii::PipelineLayout pipeline_layout_;
    vk::raii::Pipeline pipeline_;
    vk::raii::DescriptorPool pool_;
};

nearfield::ContactQuery contacts_at(nearfield::ShapeHandle a, nearfield::ShapeHandle b, double x) {
    nearfield::ContactQuery query;
    query.a = {a, {}};
    query.b = {b, {.translation = {x, 0.2}, .angle = 0.3}};
    query.tolerance = 0.01;
    query.contact_distance = 0.02;
    query.on_device = true;
    return query;
}

/// Prints what the host's shader counted, which has to be what came back to the CPU.
bool report(const Slot& slot, std::uint64_t number, const nearfield::ContactResult& result) {
    Counts counts;
    std::memcpy(&counts, slot.counts.data, sizeof(counts));
    std::printf("frame %u: %u contacts, %u inside\n", static_cast<unsigned>(number), counts.all,
                counts.inside);
    return result.status.ok() && counts.all == result.points.size() && counts.all > 0;
}

int run() {
    const Engine engine;
    nearfield::Settings settings;
    settings.batches_in_flight = frames_in_flight;
    settings.techniques = {.raster = false};
    Arena arena(engine.physical_device, engine.device);
    nearfield::HostDevice host = engine.host();
    host.memory = arena.functions();
    nearfield::Context context = value_of(nearfield::Context::create(host, settings));
    // The host's vertices, in single precision.
    const std::array square{0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.0F, 1.0F};
    const nearfield::RingView ring(square);
    const nearfield::ShapeHandle a = value_of(context.add_shape(std::span(&ring, 1)));
    const nearfield::ShapeHandle b = value_of(context.add_shape(std::span(&ring, 1)));

    const CountingPass pass(engine);
    const vk::raii::CommandPool pool(
        engine.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                 engine.family));
    vk::raii::CommandBuffers buffers(
        engine.device,
        vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, frames_in_flight));
    // Descriptor sets are written here, and again only when a revision changes.
    nearfield::Batch batch;
    const auto layout =
        value_of(context.layout_on_device(batch, batch.add(contacts_at(a, b, 0.5))));
    std::array<Frame, frames_in_flight> frames;
    std::array<Slot, frames_in_flight> slots;
    for (std::uint32_t i = 0; i < frames_in_flight; ++i) {
        frames[i].commands = std::move(buffers[i]);
        frames[i].fence =
            vk::raii::Fence(engine.device, vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled));
        slots[i].set = pass.make_set();
        slots[i].counts = Buffer(engine, arena, sizeof(Counts));
        pass.write(slots[i], layout[i]);
    }

    nearfield::Results results;
    bool agrees = true;
    constexpr std::uint64_t last = 6;
    for (std::uint64_t number = 0; number < last + frames_in_flight; ++number) {
        Frame& frame = frames[number % frames_in_flight];
        (void)engine.device.waitForFences(*frame.fence, VK_TRUE, UINT64_MAX);
        if (number >= frames_in_flight) {
            context.frame_completed(number - frames_in_flight);
            if (nearfield::Status status = context.collect(frame.ticket, results); !status.ok()) {
                throw std::runtime_error(status.text());
            }
            agrees =
                report(slots[frame.slot], number - frames_in_flight, results[frame.contacts]) &&
                agrees;
        }
        if (number >= last) {
            continue;
        }
        frame.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        batch.clear();
        frame.contacts = batch.add(contacts_at(a, b, 0.5 + 0.05 * static_cast<double>(number)));
        frame.ticket =
            value_of(context.record(batch, {.commands = *frame.commands, .frame = number}));
        const auto contacts = value_of(context.on_device(frame.ticket, frame.contacts));
        frame.slot = contacts.slot.index;
        Slot& slot = slots[frame.slot];
        if (contacts.slot.revision != slot.revision) {
            pass.write(slot, contacts);
        }
        const Counts none;
        std::memcpy(slot.counts.data, &none, sizeof(none));
        pass.record(frame.commands, slot.set, contacts.header);
        frame.commands.end();
        engine.device.resetFences(*frame.fence);
        engine.queue.submit(vk::SubmitInfo({}, {}, *frame.commands), *frame.fence);
    }
    std::printf(agrees ? "device and CPU agree\n" : "device and CPU differ\n");
    return agrees ? 0 : 1;
}

}  // namespace

int main() {
    try {
        return run();
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
