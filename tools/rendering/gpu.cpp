#include <nearfield/requirements.hpp>

#include <tools/common/library.hpp>
#include <tools/rendering/gpu.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace nearfield::tools {
namespace {

vk::raii::Context open_loader() {
    try {
        return {};
    } catch (const std::runtime_error& error) {
        throw NoGpu(std::string("there is no Vulkan loader: ") + error.what());
    }
}

vk::raii::Instance make_instance(const vk::raii::Context& loader,
                                 const std::vector<std::string>& extensions) {
    std::vector<const char*> names;
    names.reserve(extensions.size());
    for (const std::string& extension : extensions) {
        names.push_back(extension.c_str());
    }
    const auto application =
        vk::ApplicationInfo().setPApplicationName("nearfield").setApiVersion(VK_API_VERSION_1_1);
    try {
        return {loader, vk::InstanceCreateInfo()
                            .setPApplicationInfo(&application)
                            .setPEnabledExtensionNames(names)};
    } catch (const vk::SystemError& error) {
        throw NoGpu(std::string("there is no Vulkan instance: ") + error.what());
    }
}

bool offers_debug_utils(const vk::raii::Context& loader) {
    const auto all = loader.enumerateInstanceExtensionProperties();
    return std::any_of(all.begin(), all.end(), [](const vk::ExtensionProperties& extension) {
        return std::string(extension.extensionName.data()) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    });
}

std::vector<std::string> with_debug_utils(std::vector<std::string> extensions, bool offered) {
    if (offered) {
        extensions.emplace_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    return extensions;
}

/// Better kinds of device come first.
int rank(const vk::raii::PhysicalDevice& device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 1;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        default:
            return 3;
    }
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, const Requirements& needed,
                             std::uint32_t family, bool presents) {
    const float priority = 1.0F;
    const auto queue =
        vk::DeviceQueueCreateInfo().setQueueFamilyIndex(family).setQueuePriorities(priority);
    std::vector<const char*> extensions;
    if (presents) {
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    const auto features =
        vk::PhysicalDeviceFeatures().setLogicOp(static_cast<vk::Bool32>(needed.features.logicOp));
    return {physical, vk::DeviceCreateInfo()
                          .setQueueCreateInfos(queue)
                          .setPEnabledExtensionNames(extensions)
                          .setPEnabledFeatures(&features)};
}

}  // namespace

GpuInstance::GpuInstance(const std::vector<std::string>& extensions)
    : loader_(open_loader()),
      debug_utils_(offers_debug_utils(loader_)),
      instance_(make_instance(loader_, with_debug_utils(extensions, debug_utils_))) {}

Gpu::Gpu(const GpuInstance& instance, const CanPresent& can_present) {
    std::vector<vk::raii::PhysicalDevice> devices;
    std::string reasons;
    try {
        for (vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance.get())) {
            devices.push_back(std::move(device));
        }
    } catch (const vk::SystemError& error) {
        reasons = std::string("; ") + error.what();
    }
    std::stable_sort(devices.begin(), devices.end(),
                     [](const vk::raii::PhysicalDevice& a, const vk::raii::PhysicalDevice& b) {
                         return rank(a) < rank(b);
                     });
    PhysicalDevice asked;
    asked.instance = *instance.get();
    asked.get_instance_proc_addr = instance.get_instance_proc_addr();
    asked.debug_utils = instance.debug_utils();
    for (vk::raii::PhysicalDevice& device : devices) {
        asked.physical_device = *device;
        const auto families = static_cast<std::uint32_t>(device.getQueueFamilyProperties().size());
        for (std::uint32_t family = 0; family < families; ++family) {
            asked.queue_family = family;
            const Requirements needed = take(requirements(asked));
            const std::string subject = std::string("; ") +
                                        device.getProperties().deviceName.data() +
                                        ", queue family " + std::to_string(family) + ": ";
            for (const std::string& unmet : needed.unmet) {
                reasons += subject + unmet;
            }
            const OptionalPart& drawing = *needed.find("VK_QUEUE_GRAPHICS_BIT");
            for (const std::string& missing : drawing.missing) {
                reasons += subject + missing;
            }
            if (!needed.met() || !drawing.available) {
                continue;
            }
            if (can_present && !can_present(device, family)) {
                reasons += subject + "cannot present to this window";
                continue;
            }
            physical_ = std::move(device);
            device_ = make_device(physical_, needed, family, static_cast<bool>(can_present));
            queue_ = vk::raii::Queue(device_, family, 0);
            host_.instance = asked.instance;
            host_.physical_device = *physical_;
            host_.device = *device_;
            host_.queue = *queue_;
            host_.queue_family = family;
            host_.get_instance_proc_addr = asked.get_instance_proc_addr;
            host_.debug_utils = asked.debug_utils;
            host_.logic_op = needed.features.logicOp == VK_TRUE;
            return;
        }
    }
    throw NoGpu("none of " + std::to_string(devices.size()) + " Vulkan devices can be used" +
                reasons);
}

namespace {

vk::raii::DeviceMemory allocate(const Gpu& gpu, const vk::MemoryRequirements& needed,
                                vk::MemoryPropertyFlags properties) {
    const vk::PhysicalDeviceMemoryProperties offered = gpu.physical_device().getMemoryProperties();
    for (std::uint32_t type = 0; type < offered.memoryTypeCount; ++type) {
        if ((needed.memoryTypeBits & (1U << type)) != 0 &&
            (offered.memoryTypes[type].propertyFlags & properties) == properties) {
            return {
                gpu.device(),
                vk::MemoryAllocateInfo().setAllocationSize(needed.size).setMemoryTypeIndex(type)};
        }
    }
    throw std::runtime_error("the device has no memory of the kind " + vk::to_string(properties));
}

vk::raii::CommandPool make_pool(const Gpu& gpu) {
    return {gpu.device(), vk::CommandPoolCreateInfo()
                              .setFlags(vk::CommandPoolCreateFlagBits::eResetCommandBuffer)
                              .setQueueFamilyIndex(gpu.queue_family())};
}

vk::raii::CommandBuffer make_command_buffer(const Gpu& gpu, const vk::raii::CommandPool& pool) {
    vk::raii::CommandBuffers made(
        gpu.device(),
        vk::CommandBufferAllocateInfo().setCommandPool(*pool).setCommandBufferCount(1));
    return std::move(made.front());
}

}  // namespace

HostBuffer::HostBuffer(const Gpu& gpu, std::size_t size, vk::BufferUsageFlags usage)
    : buffer_(gpu.device(), vk::BufferCreateInfo().setSize(size).setUsage(usage)) {
    memory_ = allocate(
        gpu, buffer_.getMemoryRequirements(),
        vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    buffer_.bindMemory(*memory_, 0);
    bytes_ = {static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE)), size};
}

DeviceImage::DeviceImage(const Gpu& gpu, vk::Extent2D extent, vk::Format format,
                         vk::SampleCountFlagBits samples, vk::ImageUsageFlags usage)
    : image_(gpu.device(), vk::ImageCreateInfo()
                               .setImageType(vk::ImageType::e2D)
                               .setFormat(format)
                               .setExtent({extent.width, extent.height, 1})
                               .setMipLevels(1)
                               .setArrayLayers(1)
                               .setSamples(samples)
                               .setUsage(usage)) {
    memory_ =
        allocate(gpu, image_.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    image_.bindMemory(*memory_, 0);
    view_ = vk::raii::ImageView(gpu.device(), vk::ImageViewCreateInfo()
                                                  .setImage(*image_)
                                                  .setViewType(vk::ImageViewType::e2D)
                                                  .setFormat(format)
                                                  .setSubresourceRange(whole_image));
}

void change_use(const vk::raii::CommandBuffer& commands, vk::Image image, const ImageUse& before,
                const ImageUse& after) {
    commands.pipelineBarrier(before.stage, after.stage, {}, {}, {},
                             vk::ImageMemoryBarrier()
                                 .setSrcAccessMask(before.access)
                                 .setDstAccessMask(after.access)
                                 .setOldLayout(before.layout)
                                 .setNewLayout(after.layout)
                                 .setSrcQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                                 .setDstQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                                 .setImage(image)
                                 .setSubresourceRange(whole_image));
}

Commands::Commands(const Gpu& gpu)
    : gpu_(gpu),
      pool_(make_pool(gpu)),
      commands_(make_command_buffer(gpu, pool_)),
      done_(gpu.device(), vk::FenceCreateInfo().setFlags(vk::FenceCreateFlagBits::eSignaled)) {}

const vk::raii::CommandBuffer& Commands::begin() {
    wait();
    commands_.begin(
        vk::CommandBufferBeginInfo().setFlags(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    return commands_;
}

void Commands::submit(vk::Semaphore wait, vk::Semaphore signal) {
    commands_.end();
    gpu_.device().resetFences(*done_);
    // The first use of the semaphore's image is the copy to it, so only transfers wait.
    const vk::PipelineStageFlags stage = vk::PipelineStageFlagBits::eTransfer;
    auto info = vk::SubmitInfo().setCommandBuffers(*commands_);
    if (wait) {
        info.setWaitSemaphores(wait).setWaitDstStageMask(stage);
    }
    if (signal) {
        info.setSignalSemaphores(signal);
    }
    gpu_.queue().submit(info, *done_);
}

void Commands::wait() const {
    if (gpu_.device().waitForFences(*done_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) {
        throw std::runtime_error("waiting for the device failed");
    }
}

}  // namespace nearfield::tools
