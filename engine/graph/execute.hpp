#pragma once

#include <engine/base/function_ref.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::graph {

/// The render pass of a baked graphics pass, for creating its pipelines. Depends only on formats,
/// load and store operations, so it is compatible across extents.
[[nodiscard]] gpu::Owned<VkRenderPass> make_render_pass(const gpu::Device& device,
                                                        const Graph& graph, const BakedPass& pass);

/// Accesses outside the graph that the caller states for one execution, in place of those declared
/// (ExternalAccess): stages, accesses and the layout of an image. Without stages there is nothing
/// to wait for before, or nothing that waits after.
struct ExternalUse {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
struct ExternalUses {
    ExternalUse before;  ///< its layout keeps an image's content, unless it is undefined
    ExternalUse after;
};

/// What is behind an imported handle. A resource with uses of its own was declared with accesses
/// where these state any, and its first use in the graph is a write; or, of a buffer that was
/// declared to be written before, a read.
struct ImportedBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = VK_WHOLE_SIZE;
    std::optional<ExternalUses> uses = std::nullopt;
};
struct ImportedImage {
    VkImage image = VK_NULL_HANDLE;
    std::uint32_t level = 0;
    std::uint32_t layer = 0;
    std::optional<ExternalUses> uses = std::nullopt;
    VkImageView view = VK_NULL_HANDLE;  ///< of the level and layer, for shaders
    /// Of the view: once it is gone, another one may have its handle.
    std::uint64_t identity = 0;
};
/// The one or the other.
struct Imported {
    ImportedBuffer buffer;
    ImportedImage image;
};

/// The Vulkan objects of a baked graph (transient images in shared memory, views, render passes,
/// framebuffers) and its execution into a command buffer. Made once per graph, used every frame;
/// executing creates nothing and allocates nothing. The device must outlive it.
class Executor {
public:
    Executor(const gpu::Device& device, const Graph& graph, BakedGraph baked);

    /// The view that a compute shader samples: of the colour or depth aspect.
    [[nodiscard]] VkImageView sampled_view(Handle handle) const;

    /// Bytes of device memory of the transient images.
    [[nodiscard]] std::uint64_t image_bytes() const { return image_bytes_; }

    /// Records all passes, each labelled with its name and timed: `record` is called for what is
    /// between a pass's barriers and its end, with the pass's position in Graph::passes().
    /// `imported`: by resource, where it is imported.
    /// Executions that share these images may be in progress at the same time on one queue; their
    /// buffers must differ.
    void execute(const Graph& graph, std::span<const Imported> imported, VkCommandBuffer commands,
                 gpu::Timestamps& timestamps,
                 FunctionRef<void(std::size_t, VkCommandBuffer)> record);

    [[nodiscard]] const BakedGraph& baked() const { return baked_; }

private:
    struct Image {
        gpu::Owned<VkImage> image;
        gpu::Owned<VkImageView> attachment_view;
        gpu::Owned<VkImageView> sampled_view;
    };
    struct GraphicsPass {
        gpu::Owned<VkRenderPass> render_pass;
        gpu::Owned<VkFramebuffer> framebuffer;
    };

    void create_images(const Graph& graph);
    void allocate_memory(const Graph& graph);
    void create_views(const Graph& graph);
    void create_graphics(const Graph& graph);
    /// Adds a barrier to those of the next call.
    void add(const Resource& resource, const Imported& imported, const Barrier& declared);
    void record_barriers(const Graph& graph, std::span<const Imported> imported,
                         VkCommandBuffer commands, const std::vector<Barrier>& barriers);

    const gpu::Device* device_;
    BakedGraph baked_;
    std::vector<gpu::DeviceMemory> memory_;  // by memory slot
    std::vector<Image> images_;              // by resource
    std::vector<GraphicsPass> graphics_;     // by position in baked_.passes
    // Of the next vkCmdPipelineBarrier; memory for most.
    std::vector<VkMemoryBarrier> memory_barriers_;
    std::vector<VkImageMemoryBarrier> image_barriers_;
    std::vector<VkBufferMemoryBarrier> buffer_barriers_;
    VkPipelineStageFlags source_stages_ = 0;
    VkPipelineStageFlags destination_stages_ = 0;
    std::uint64_t image_bytes_ = 0;
};

/// The executor of a graph that the library builds itself. Such a graph always bakes; throws
/// StatusException if it does not.
[[nodiscard]] std::unique_ptr<Executor> make_executor(const gpu::Device& device,
                                                      const Graph& graph);

}  // namespace nearfield::graph
