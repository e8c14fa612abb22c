#pragma once

#include <engine/gpu/functions.hpp>
#include <engine/gpu/strategies.hpp>
#ifdef NEARFIELD_SHADER_RELOAD
#include <engine/gpu/shader_words.hpp>
#endif
#include <nearfield/host.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::gpu {

/// Bytes of allocated device memory: current and peak.
class MemoryCount {
public:
    void add(std::uint64_t bytes) {
        in_use_ += bytes;
        peak_ = std::max(peak_, in_use_);
    }
    void remove(std::uint64_t bytes) { in_use_ -= bytes; }
    [[nodiscard]] std::uint64_t in_use() const { return in_use_; }
    [[nodiscard]] std::uint64_t peak() const { return peak_; }

private:
    std::uint64_t in_use_ = 0;
    std::uint64_t peak_ = 0;
};

class MemoryBlocks;

/// A borrowed Vulkan device with its entry points and limits, and the host's callbacks. Immutable
/// after construction, except for the count of memory and for reloaded shaders.
class Device {
public:
    /// Looks up every entry point and checks every requirement. Throws StatusException
    /// (unsupported_device) that lists each missing entry point, queue capability, limit and
    /// format.
    explicit Device(const HostDevice& host);
    /// All memory must have been given back.
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const Functions& functions() const { return functions_; }
    [[nodiscard]] VkDevice handle() const { return host_.device; }
    [[nodiscard]] VkQueue queue() const { return host_.queue; }
    /// For every vkCreate, vkAllocate, vkDestroy and vkFree.
    [[nodiscard]] const VkAllocationCallbacks* allocator() const {
        return allocator_ ? &*allocator_ : nullptr;
    }
    /// For every pipeline; the host's cache, or none.
    [[nodiscard]] VkPipelineCache pipeline_cache() const { return host_.pipeline_cache; }
    [[nodiscard]] bool timeline_semaphore() const { return host_.timeline_semaphore; }
    /// Submissions signal a timeline semaphore and no fence.
    [[nodiscard]] bool completion_by_timeline() const { return host_.completion_by_timeline; }
    /// vkQueueSubmit, or the host's replacement for it.
    [[nodiscard]] VkResult submit(const VkSubmitInfo& info, VkFence fence) const;
    [[nodiscard]] MemoryCount& memory_count() const { return memory_count_; }
    /// The memory of all buffers and images.
    [[nodiscard]] MemoryBlocks& memory() const { return *memory_blocks_; }
    /// The host's allocator of device memory, or null.
    [[nodiscard]] const MemoryFunctions* host_memory() const {
        return host_.memory.allocate != nullptr ? &host_.memory : nullptr;
    }
    /// What the queue family can do.
    [[nodiscard]] VkQueueFlags queue_flags() const { return queue_flags_; }
    /// Into how many parts the rasteriser divides a pixel along an axis.
    [[nodiscard]] double subpixel_steps() const {
        return static_cast<double>(std::uint64_t{1} << limits().subPixelPrecisionBits);
    }
    /// The queue family draws; otherwise there is no Technique::raster.
    [[nodiscard]] bool draws() const { return (queue_flags_ & VK_QUEUE_GRAPHICS_BIT) != 0; }
    /// All queue families that use resident results, without repetition; empty if only
    /// queue_family() does.
    [[nodiscard]] const std::vector<std::uint32_t>& reader_families() const {
        return reader_families_;
    }
#ifdef NEARFIELD_SHADER_RELOAD
    [[nodiscard]] ShaderWords& shader_words() const {
        return shader_words_;
    }
#endif
    [[nodiscard]] std::uint32_t queue_family() const {
        return host_.queue_family;
    }
    [[nodiscard]] const std::string& name() const {
        return name_;
    }
    /// The device runs on the CPU, as lavapipe does.
    [[nodiscard]] bool is_software() const {
        return properties_.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const {
        return properties_.limits;
    }
    /// A combined depth-stencil format that can be an attachment; only its stencil is used.
    [[nodiscard]] VkFormat stencil_format() const {
        return stencil_format_;
    }
    [[nodiscard]] const StrategySupport& strategy_support() const {
        return strategy_support_;
    }
    /// A format of two floats that can be blended and sampled: single precision where the device
    /// blends it, otherwise half.
    [[nodiscard]] VkFormat gradient_format() const {
        return gradient_format_;
    }
    /// 0 where the queue family has no timestamps.
    [[nodiscard]] std::uint32_t timestamp_bits() const {
        return timestamp_bits_;
    }

    /// The memory types among `allowed` (bit mask) that have all of `required`, without those that
    /// need a feature or a protected allocation. Throws StatusException if there is none.
    [[nodiscard]] std::uint32_t usable_types(std::uint32_t allowed,
                                             VkMemoryPropertyFlags required) const;
    /// The memory type among `allowed` that has all of `required` and most of `preferred`; the
    /// first one on a tie. Skips types and throws as usable_types() does.
    [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                            VkMemoryPropertyFlags preferred) const;
    /// Returns whether such a memory type exists.
    [[nodiscard]] bool has_memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required) const;
    [[nodiscard]] VkMemoryPropertyFlags memory_flags(std::uint32_t type) const;

    /// Logs the text that `words()` returns, if the host has a log callback; logs nothing if there
    /// is no memory for the text.
    template <class Words>
    void log(LogLevel level, const Words& words) const noexcept {
        if (host_.log.write == nullptr) {
            return;
        }
        std::string text;
        try {
            text = words();
        } catch (const std::bad_alloc&) {
            return;
        }
        host_.log.write(host_.log.user, level, text.c_str());
    }

    /// Names an object for debuggers and validation; does nothing if the host did not enable debug
    /// utils.
    template <class Object>
    void name_object(VkObjectType type, Object object, const std::string& name) const {
        set_name(type, reinterpret_cast<std::uint64_t>(object), name);
    }
    void begin_label(VkCommandBuffer commands, const char* name) const;
    void end_label(VkCommandBuffer commands) const;

private:
    [[nodiscard]] bool is_usable_type(std::uint32_t type, std::uint32_t allowed,
                                      VkMemoryPropertyFlags required) const;
    void set_name(VkObjectType type, std::uint64_t object, const std::string& name) const;
    /// Each fills functions_ and appends the names of missing entry points.
    void load_instance_functions(std::vector<std::string>& missing);
    void load_device_functions(std::vector<std::string>& missing);
    /// Throws StatusException (invalid_settings) if the device does not have one of the host's.
    void set_reader_families(std::size_t family_count);

    HostDevice host_;
    std::optional<VkAllocationCallbacks> allocator_;
    mutable MemoryCount memory_count_;
    std::unique_ptr<MemoryBlocks> memory_blocks_;
#ifdef NEARFIELD_SHADER_RELOAD
    mutable ShaderWords shader_words_;
#endif
    Functions functions_;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    std::string name_;
    VkFormat stencil_format_ = VK_FORMAT_UNDEFINED;
    StrategySupport strategy_support_;
    VkFormat gradient_format_ = VK_FORMAT_UNDEFINED;
    std::uint32_t timestamp_bits_ = 0;
    VkQueueFlags queue_flags_ = 0;
    std::vector<std::uint32_t> reader_families_;
};

/// Throws StatusException (device_lost, out_of_memory or device_error) unless the result is a
/// success; `call` is the entry point, `what` the object it was for.
void check(VkResult result, const char* call, std::string_view what);

/// The name of a result as the specification spells it ("VK_ERROR_DEVICE_LOST").
[[nodiscard]] const char* to_string(VkResult result) noexcept;

}  // namespace nearfield::gpu
