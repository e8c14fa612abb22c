#include <engine/gpu/functions.hpp>

#include <tests/support/allocations.hpp>
#include <tests/support/mock_driver_state.hpp>

#include <algorithm>
#include <cstring>
#include <tuple>
#include <type_traits>

/// The entry points of the mock driver. What is in engine/gpu/functions.hpp is here by itself:
/// vkCreate and vkDestroy count objects and vkCmd refers to them, as their signatures say. An entry
/// point that does more, or is called otherwise, has an overload of perform() below.

namespace nearfield::test_support {
namespace {

#define NEARFIELD_TAG(function)                             \
    struct Tag_##function {                                 \
        static constexpr std::string_view name = #function; \
    };
NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_TAG)
#undef NEARFIELD_TAG

MockDriver::State& driver() {
    return *mock_driver;
}

// The memory there is: the device's own; what both see, without coherence; the host's.
constexpr std::uint32_t memory_types = 3;
constexpr VkMemoryPropertyFlags memory_flags[memory_types]{
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
        VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
};

// Of physical devices.

void perform(Tag_vkGetPhysicalDeviceProperties, VkPhysicalDevice,
             VkPhysicalDeviceProperties* properties) {
    *properties = {};
    properties->apiVersion = VK_API_VERSION_1_1;
    properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    std::strcpy(properties->deviceName, "nearfield mock driver");
    VkPhysicalDeviceLimits& limits = properties->limits;
    limits.maxImageDimension2D = 16384;
    limits.maxStorageBufferRange = 1U << 30U;
    limits.maxPerStageDescriptorStorageBuffers = 16;
    limits.maxComputeWorkGroupInvocations = 1024;
    limits.subPixelPrecisionBits = 8;
    limits.minStorageBufferOffsetAlignment = 16;
    limits.nonCoherentAtomSize = 64;
    limits.timestampPeriod = 1.0F;
}

void perform(Tag_vkGetPhysicalDeviceMemoryProperties, VkPhysicalDevice,
             VkPhysicalDeviceMemoryProperties* properties) {
    *properties = {};
    properties->memoryTypeCount = memory_types;
    for (std::uint32_t i = 0; i < memory_types; ++i) {
        properties->memoryTypes[i] = {memory_flags[i], 0};
    }
    properties->memoryHeapCount = 1;
    properties->memoryHeaps[0] = {VkDeviceSize{1} << 34U, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

void perform(Tag_vkGetPhysicalDeviceQueueFamilyProperties, VkPhysicalDevice, std::uint32_t* count,
             VkQueueFamilyProperties* families) {
    *count = 1;
    if (families != nullptr) {
        *families = {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT, 1, 64, {1, 1, 1}};
    }
}

void perform(Tag_vkGetPhysicalDeviceFormatProperties, VkPhysicalDevice, VkFormat,
             VkFormatProperties* properties) {
    constexpr VkFormatFeatureFlags all = 0x7FFFFFFF;
    *properties = {all, all, all};
}

PFN_vkVoidFunction device_function(const char* name);
PFN_vkVoidFunction perform(Tag_vkGetDeviceProcAddr, VkDevice, const char* name) {
    return device_function(name);
}

// Memory.

VkResult perform(Tag_vkAllocateMemory tag, VkDevice device, const VkMemoryAllocateInfo* info,
                 const VkAllocationCallbacks*, VkDeviceMemory* memory) {
    *memory = driver().make<VkDeviceMemory>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *memory);
    object.bytes = info->allocationSize;
    object.memory_type = info->memoryTypeIndex;
    return VK_SUCCESS;
}

void perform(Tag_vkFreeMemory tag, VkDevice device, VkDeviceMemory memory,
             const VkAllocationCallbacks*) {
    driver().destroy(tag.name, number(device), memory);
}

VkResult perform(Tag_vkMapMemory tag, VkDevice, VkDeviceMemory memory, VkDeviceSize, VkDeviceSize,
                 VkMemoryMapFlags, void** data) {
    MockObject& object = *driver().find(tag.name, memory);
    if (object.mapped) {
        driver().breach(tag.name, "memory is mapped already");
    }
    if ((memory_flags[object.memory_type] & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) {
        driver().breach(tag.name, "memory that the host cannot see");
    }
    constexpr std::size_t alignment = 64;
    object.mapped = true;
    object.content.resize(object.bytes + alignment);
    void* start = object.content.data();
    std::size_t space = object.content.size();
    *data = std::align(alignment, object.bytes, start, space);
    object.words = {static_cast<std::uint32_t*>(*data), object.bytes / sizeof(std::uint32_t)};
    std::fill(object.words.begin(), object.words.end(), MockDriver::device_word);
    return VK_SUCCESS;
}

void expect_mapped(std::string_view call, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const MockObject* const memory = driver().find(call, ranges[i].memory);
        if (memory != nullptr && !memory->mapped) {
            driver().breach(call, "memory that is not mapped");
        }
    }
}

VkResult perform(Tag_vkFlushMappedMemoryRanges tag, VkDevice, std::uint32_t count,
                 const VkMappedMemoryRange* ranges) {
    expect_mapped(tag.name, count, ranges);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkInvalidateMappedMemoryRanges tag, VkDevice, std::uint32_t count,
                 const VkMappedMemoryRange* ranges) {
    expect_mapped(tag.name, count, ranges);
    return VK_SUCCESS;
}

// Buffers and images.

VkResult perform(Tag_vkCreateBuffer tag, VkDevice device, const VkBufferCreateInfo* info,
                 const VkAllocationCallbacks*, VkBuffer* buffer) {
    *buffer = driver().make<VkBuffer>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *buffer);
    object.bytes = info->size;
    object.written = (info->usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT) != 0;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateImage tag, VkDevice device, const VkImageCreateInfo* info,
                 const VkAllocationCallbacks*, VkImage* image) {
    *image = driver().make<VkImage>(tag.name, number(device));
    driver().find(tag.name, *image)->bytes =
        std::uint64_t{8} * info->extent.width * info->extent.height;
    return VK_SUCCESS;
}

template <class Handle>
void get_requirements(std::string_view call, Handle wanted, VkMemoryRequirements* requirements) {
    const MockObject& object = *driver().find(call, wanted);
    constexpr VkDeviceSize alignment = 256;
    *requirements = {(object.bytes + alignment - 1) / alignment * alignment, alignment,
                     (1U << memory_types) - 1};
}

void perform(Tag_vkGetBufferMemoryRequirements tag, VkDevice, VkBuffer buffer,
             VkMemoryRequirements* requirements) {
    get_requirements(tag.name, buffer, requirements);
}

void perform(Tag_vkGetImageMemoryRequirements tag, VkDevice, VkImage image,
             VkMemoryRequirements* requirements) {
    get_requirements(tag.name, image, requirements);
}

template <class Handle>
VkResult bind(std::string_view call, Handle wanted, VkDeviceMemory memory, VkDeviceSize offset) {
    MockObject* const object = driver().find(call, wanted);
    const MockObject* const found = driver().find(call, memory);
    if (object == nullptr || found == nullptr) {
        return VK_SUCCESS;
    }
    if (object->bound) {
        driver().breach(call, "an object that has memory already");
    }
    if (offset + object->bytes > found->bytes) {
        driver().breach(call, "memory that is too small");
    }
    object->bound = true;
    object->needs[0] = number(memory);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkBindBufferMemory tag, VkDevice, VkBuffer buffer, VkDeviceMemory memory,
                 VkDeviceSize offset) {
    return bind(tag.name, buffer, memory, offset);
}

VkResult perform(Tag_vkBindImageMemory tag, VkDevice, VkImage image, VkDeviceMemory memory,
                 VkDeviceSize offset) {
    return bind(tag.name, image, memory, offset);
}

/// Object `index` of what another refers to has to be there, and with memory.
template <class Handle>
void refer(std::string_view call, MockObject& from, std::uint64_t index, Handle to) {
    const MockObject* const object = driver().find(call, to);
    if (object == nullptr) {
        return;
    }
    if ((std::is_same_v<Handle, VkBuffer> || std::is_same_v<Handle, VkImage>)&&!object->bound) {
        driver().breach(call, "an object without memory");
    }
    from.needs[index] = number(to);
}

VkResult perform(Tag_vkCreateImageView tag, VkDevice device, const VkImageViewCreateInfo* info,
                 const VkAllocationCallbacks*, VkImageView* view) {
    *view = driver().make<VkImageView>(tag.name, number(device));
    refer(tag.name, *driver().find(tag.name, *view), 0, info->image);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateFramebuffer tag, VkDevice device, const VkFramebufferCreateInfo* info,
                 const VkAllocationCallbacks*, VkFramebuffer* framebuffer) {
    *framebuffer = driver().make<VkFramebuffer>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *framebuffer);
    for (std::uint32_t i = 0; i < info->attachmentCount; ++i) {
        refer(tag.name, object, i, info->pAttachments[i]);
    }
    return VK_SUCCESS;
}

// Pipelines and descriptor sets.

template <class Info>
VkResult make_pipelines(std::string_view call, VkDevice device, std::uint32_t count,
                        const Info* infos, VkPipeline* pipelines) {
    for (std::uint32_t i = 0; i < count; ++i) {
        driver().find(call, infos[i].layout);
        pipelines[i] = driver().make<VkPipeline>(call, number(device));
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateGraphicsPipelines tag, VkDevice device, VkPipelineCache,
                 std::uint32_t count, const VkGraphicsPipelineCreateInfo* infos,
                 const VkAllocationCallbacks*, VkPipeline* pipelines) {
    return make_pipelines(tag.name, device, count, infos, pipelines);
}

VkResult perform(Tag_vkCreateComputePipelines tag, VkDevice device, VkPipelineCache,
                 std::uint32_t count, const VkComputePipelineCreateInfo* infos,
                 const VkAllocationCallbacks*, VkPipeline* pipelines) {
    return make_pipelines(tag.name, device, count, infos, pipelines);
}

VkResult perform(Tag_vkAllocateDescriptorSets tag, VkDevice,
                 const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
    driver().find(tag.name, info->descriptorPool);
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
        sets[i] = driver().make<VkDescriptorSet>(tag.name, number(info->descriptorPool));
        refer(tag.name, *driver().find(tag.name, sets[i]), UINT32_MAX, info->pSetLayouts[i]);
    }
    return VK_SUCCESS;
}

void perform(Tag_vkUpdateDescriptorSets tag, VkDevice, std::uint32_t count,
             const VkWriteDescriptorSet* writes, std::uint32_t, const VkCopyDescriptorSet*) {
    for (std::uint32_t i = 0; i < count; ++i) {
        MockObject* const set = driver().find(tag.name, writes[i].dstSet);
        if (set == nullptr) {
            continue;
        }
        driver().expect_unused(tag.name, number(writes[i].dstSet));
        if (writes[i].pImageInfo != nullptr) {
            refer(tag.name, *set, writes[i].dstBinding, writes[i].pImageInfo->imageView);
        } else {
            refer(tag.name, *set, writes[i].dstBinding, writes[i].pBufferInfo->buffer);
        }
    }
}

// Command buffers.

VkResult perform(Tag_vkAllocateCommandBuffers tag, VkDevice,
                 const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers) {
    driver().find(tag.name, info->commandPool);
    for (std::uint32_t i = 0; i < info->commandBufferCount; ++i) {
        buffers[i] = driver().make<VkCommandBuffer>(tag.name, number(info->commandPool));
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkResetCommandPool tag, VkDevice, VkCommandPool pool,
                 VkCommandPoolResetFlags) {
    for (auto& [child, object] : driver().objects) {
        if (object.parent == number(pool)) {
            driver().expect_unused(tag.name, child);
            object.commands = MockObject::Commands::empty;
            object.needs.clear();
        }
    }
    return VK_SUCCESS;
}

void change(std::string_view call, VkCommandBuffer commands, MockObject::Commands from,
            MockObject::Commands to) {
    MockObject* const object = driver().find(call, commands);
    if (object != nullptr && object->commands != from) {
        driver().breach(call, "a command buffer in another state");
    } else if (object != nullptr) {
        object->commands = to;
    }
}

VkResult perform(Tag_vkBeginCommandBuffer tag, VkCommandBuffer commands,
                 const VkCommandBufferBeginInfo*) {
    change(tag.name, commands, MockObject::Commands::empty, MockObject::Commands::recording);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkEndCommandBuffer tag, VkCommandBuffer commands) {
    change(tag.name, commands, MockObject::Commands::recording, MockObject::Commands::executable);
    return VK_SUCCESS;
}

/// A command buffer that is being recorded refers to whatever a command names.
template <class Type>
void use(std::string_view call, VkCommandBuffer commands, Type used) {
    if constexpr (VulkanHandle<Type> && !std::is_same_v<Type, VkCommandBuffer>) {
        if (MockObject* const object = driver().find(call, commands);
            object != nullptr && used != VK_NULL_HANDLE) {
            refer(call, *object, number(used), used);
        }
    }
}

void perform(Tag_vkCmdBeginRenderPass tag, VkCommandBuffer commands,
             const VkRenderPassBeginInfo* info, VkSubpassContents) {
    use(tag.name, commands, info->renderPass);
    use(tag.name, commands, info->framebuffer);
}

void perform(Tag_vkCmdBindDescriptorSets tag, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipelineLayout layout, std::uint32_t, std::uint32_t count,
             const VkDescriptorSet* sets, std::uint32_t, const std::uint32_t*) {
    use(tag.name, commands, layout);
    for (std::uint32_t i = 0; i < count; ++i) {
        use(tag.name, commands, sets[i]);
    }
}

void perform(Tag_vkCmdBindVertexBuffers tag, VkCommandBuffer commands, std::uint32_t,
             std::uint32_t count, const VkBuffer* buffers, const VkDeviceSize*) {
    for (std::uint32_t i = 0; i < count; ++i) {
        use(tag.name, commands, buffers[i]);
    }
}

void perform(Tag_vkCmdPipelineBarrier tag, VkCommandBuffer commands, VkPipelineStageFlags,
             VkPipelineStageFlags, VkDependencyFlags, std::uint32_t, const VkMemoryBarrier*,
             std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
             std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    for (std::uint32_t i = 0; i < buffer_count; ++i) {
        use(tag.name, commands, buffers[i].buffer);
    }
    for (std::uint32_t i = 0; i < image_count; ++i) {
        use(tag.name, commands, images[i].image);
    }
}

// Submissions and fences.

VkResult perform(Tag_vkCreateFence tag, VkDevice device, const VkFenceCreateInfo* info,
                 const VkAllocationCallbacks*, VkFence* fence) {
    *fence = driver().make<VkFence>(tag.name, number(device));
    driver().find(tag.name, *fence)->signalled = (info->flags & VK_FENCE_CREATE_SIGNALED_BIT) != 0;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkResetFences tag, VkDevice, std::uint32_t count, const VkFence* fences) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (MockObject* const fence = driver().find(tag.name, fences[i])) {
            if (!fence->in_use.empty()) {
                driver().breach(tag.name, "a fence of a submission that is not done");
            }
            fence->signalled = false;
        }
    }
    return VK_SUCCESS;
}

/// What a submission leaves in the buffers that it writes. Counts that the host set to 0 stay 0.
void write_results(const std::set<Number>& used) {
    for (const Number number_used : used) {
        const MockObject& buffer = driver().objects[number_used];
        if (!buffer.written || !buffer.bound) {
            continue;
        }
        for (std::uint32_t& word : driver().objects[buffer.needs.at(0)].words) {
            word = word == 0 ? 0 : MockDriver::device_word;
        }
    }
}

VkResult perform(Tag_vkQueueSubmit tag, VkQueue queue, std::uint32_t count,
                 const VkSubmitInfo* infos, VkFence fence) {
    if (number(queue) != driver().queue) {
        driver().breach(tag.name, "another queue");
    }
    MockObject& signalled = *driver().find(tag.name, fence);
    if (signalled.signalled) {
        driver().breach(tag.name, "a fence that is signalled");
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; j < infos[i].commandBufferCount; ++j) {
            const VkCommandBuffer commands = infos[i].pCommandBuffers[j];
            change(tag.name, commands, MockObject::Commands::executable,
                   MockObject::Commands::pending);
            for (const auto& [place, needed] : driver().find(tag.name, commands)->needs) {
                if (!driver().objects.contains(needed)) {
                    driver().breach(tag.name, "commands refer to something that is gone");
                }
            }
            driver().add_needs(number(commands), signalled.in_use);
        }
    }
    write_results(signalled.in_use);
    signalled.signalled = true;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkWaitForFences tag, VkDevice, std::uint32_t count, const VkFence* fences,
                 VkBool32, std::uint64_t) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (MockObject* const fence = driver().find(tag.name, fences[i])) {
            if (!fence->signalled) {
                driver().breach(tag.name, "a fence that nothing will ever signal");
            }
            driver().finish(*fence);
        }
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkGetFenceStatus tag, VkDevice, VkFence fence) {
    MockObject& object = *driver().find(tag.name, fence);
    driver().finish(object);
    return object.signalled ? VK_SUCCESS : VK_NOT_READY;
}

VkResult perform(Tag_vkGetQueryPoolResults tag, VkDevice, VkQueryPool pool, std::uint32_t,
                 std::uint32_t, std::size_t bytes, void* data, VkDeviceSize, VkQueryResultFlags) {
    driver().find(tag.name, pool);
    std::memset(data, 0, bytes);
    return VK_SUCCESS;
}

// Debuggers.

VkResult perform(Tag_vkSetDebugUtilsObjectNameEXT tag, VkDevice,
                 const VkDebugUtilsObjectNameInfoEXT* info) {
    if (!driver().objects.contains(info->objectHandle)) {
        driver().breach(tag.name, "a handle of nothing that is there");
    }
    return VK_SUCCESS;
}

// What entry points do by their signatures.

template <class Tag, class... Arguments>
constexpr bool has_own = requires(Arguments... arguments) {
    perform(Tag{}, arguments...);
};

template <class Last>
constexpr bool makes_handle =
    std::is_pointer_v<Last> && !std::is_const_v<std::remove_pointer_t<Last>> &&
    VulkanHandle<std::remove_pointer_t<Last>>;

template <class Tag, class First, class... Rest>
auto act(First first, Rest... rest) {
    if constexpr (has_own<Tag, First, Rest...>) {
        return perform(Tag{}, first, rest...);
    } else if constexpr (Tag::name.starts_with("vkCmd")) {
        const MockObject* const commands = driver().find(Tag::name, first);
        if (commands != nullptr && commands->commands != MockObject::Commands::recording) {
            driver().breach(Tag::name, "a command buffer that is not being recorded");
        }
        (use(Tag::name, first, rest), ...);
    } else if constexpr (Tag::name.starts_with("vkCreate")) {
        const auto& made = std::get<sizeof...(Rest) - 1>(std::tie(rest...));
        *made = driver().make<std::remove_reference_t<decltype(*made)>>(Tag::name, number(first));
        return VK_SUCCESS;
    } else {
        static_assert(Tag::name.starts_with("vkDestroy"),
                      "an entry point that needs an overload of perform()");
        driver().destroy(Tag::name, number(first), std::get<0>(std::tie(rest...)));
    }
}

/// A failing call leaves rubbish where a new handle was to be, but where the specification wants
/// null handles.
template <class Tag, class... Arguments>
void spoil(Arguments... arguments) {
    const auto& last = std::get<sizeof...(Arguments) - 1>(std::tie(arguments...));
    using Last = std::remove_cvref_t<decltype(last)>;
    if constexpr (makes_handle<Last>) {
        constexpr bool null = Tag::name.ends_with("Pipelines") || Tag::name.ends_with("Sets") ||
                              Tag::name.ends_with("CommandBuffers");
        *last = handle<std::remove_pointer_t<Last>>(null ? 0 : 0xBAD);
    }
}

template <class Tag, class Function>
struct Entry;

template <class Tag, class Result, class... Arguments>
struct Entry<Tag, Result(VKAPI_PTR*)(Arguments...)> {
    static constexpr bool returns_result = std::is_same_v<Result, VkResult>;

    static Result VKAPI_CALL call(Arguments... arguments) {
        const UnwatchedAllocations here;
        [[maybe_unused]] const VkResult error = driver().enter(Tag::name);
        if constexpr (returns_result) {
            if (error != VK_SUCCESS) {
                spoil<Tag>(arguments...);
                return error;
            }
        }
        return act<Tag>(arguments...);
    }
};

struct Known {
    EntryPoint entry;
    PFN_vkVoidFunction function;
};

template <class Tag, class Function>
Known known(bool of_device) {
    using Here = Entry<Tag, Function>;
    return {{Tag::name, Here::returns_result, of_device},
            reinterpret_cast<PFN_vkVoidFunction>(&Here::call)};
}

const std::vector<Known>& all_known() {
    static const std::vector<Known> all{
#define NEARFIELD_OF_INSTANCE(function) known<Tag_##function, PFN_##function>(false),
#define NEARFIELD_OF_DEVICE(function) known<Tag_##function, PFN_##function>(true),
        NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_OF_INSTANCE)
            NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_OF_INSTANCE)
                NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_OF_DEVICE)
#undef NEARFIELD_OF_INSTANCE
#undef NEARFIELD_OF_DEVICE
    };
    return all;
}

PFN_vkVoidFunction device_function(const char* name) {
    if (driver().hidden == name) {
        return nullptr;
    }
    for (const Known& candidate : all_known()) {
        if (candidate.entry.name == name) {
            return candidate.function;
        }
    }
    return nullptr;
}

}  // namespace

PFN_vkVoidFunction VKAPI_CALL mock_instance_function(VkInstance, const char* name) {
    const UnwatchedAllocations here;
    return device_function(name);
}

const std::vector<EntryPoint>& entry_points() {
    static const std::vector<EntryPoint> all = [] {
        std::vector<EntryPoint> entries;
        for (const Known& known_one : all_known()) {
            entries.push_back(known_one.entry);
        }
        return entries;
    }();
    return all;
}

}  // namespace nearfield::test_support
