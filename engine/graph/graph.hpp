#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::graph {

/// How a pass accesses a resource. Stages, access masks, image layouts and image usages follow from
/// this alone (see access.hpp).
enum class Access : std::uint8_t {
    color_attachment,          ///< written (and tested against the previous content) as colour
    depth_stencil_attachment,  ///< written and tested as depth, stencil or both
    sampled_in_compute,        ///< image, read by texel fetch in a compute shader
    storage_read_in_compute,   ///< buffer, read in a compute shader
    storage_write_in_compute,  ///< buffer, written (or read and written) in a compute shader
    vertex_buffer,             ///< buffer, read as vertex input
    transfer_write,            ///< buffer, a part of it written by a copy
    storage_read_in_fragment,  ///< buffer, read in a fragment shader
    transfer_read,             ///< buffer, read by a copy
    storage_image_in_compute,  ///< image, written by a compute shader
    indirect_arguments,        ///< buffer, read as the arguments of a dispatch
    written_arguments,         ///< the same of one that writes arguments of later dispatches
    // Uses outside any graph, between this one and its next execution (ExternalAccess).
    exported_buffer,  ///< buffer, read by the shaders of the library's user
    exported_image,   ///< image, sampled by the shaders of the library's user
};

/// A resource at one version. A write yields a new version and invalidates the old one. A reader
/// thus names the pass whose output it reads, so the order of passes follows from the handles and
/// not from the order of declaration.
struct Handle {
    std::uint32_t resource = UINT32_MAX;
    std::uint32_t version = 0;

    friend bool operator==(const Handle&, const Handle&) = default;
};

/// An image that exists only inside the graph. Version 0 has no content.
struct ImageDescription {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    /// Format of the view for sampling, if it differs from the image's; of the same texel size.
    VkFormat sampled_format = VK_FORMAT_UNDEFINED;
};

/// A buffer of the caller's. Version 0 holds what the host wrote before the graph runs, if
/// anything.
struct BufferDescription {
    std::string name;
    bool written_by_host = false;  ///< version 0 may be read
    bool read_by_host = false;     ///< its last version is made visible to the host at the end
};

/// An image of the caller's, of any extent. Its content from before the graph runs is lost.
struct ImportedImageDescription {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
};

/// The accesses to an imported resource on the same queue before and after the graph. If omitted,
/// only the host accesses it, and it waits for a fence in between.
struct ExternalAccess {
    std::optional<Access> before = std::nullopt;  ///< if it writes a buffer, version 0 may be read
    std::optional<Access> after =
        std::nullopt;  ///< the last version is made visible to it at the end
};

/// A compute pass runs outside any render pass and may also copy.
enum class PassKind : std::uint8_t { graphics, compute };

/// One use of a resource by a pass.
struct Use {
    Handle handle;  ///< the version that the pass sees; a write produces version + 1
    Access access{};
    bool write = false;
};

/// The binding of what no shader finds at one: arguments of a dispatch, the ends of a copy.
inline constexpr std::uint32_t unbound = UINT32_MAX;
/// What all of a pass's descriptor sets have at a binding.
inline constexpr std::uint32_t every_set = UINT32_MAX;

/// What a pass uses, and at which binding its shaders find it: all that there is to say about it.
/// Null handles are left out.
struct Bound {
    std::uint32_t binding = unbound;
    Handle& handle;  ///< replaced by the new version where the access writes
    Access access = Access::storage_read_in_compute;
    std::uint32_t part = 0;         ///< of a buffer that is bound in parts
    std::uint32_t set = every_set;  ///< of a pass that has several sets, which it binds in turn
};

/// What is at a binding of a descriptor set.
struct Binding {
    std::uint32_t set = every_set;
    std::uint32_t binding = 0;
    std::uint32_t resource = 0;
    std::uint32_t part = 0;
};

struct Pass {
    std::string name;
    PassKind kind{};
    std::vector<Use> uses;
    std::vector<Binding> bindings;
};

/// Declares, inside add_pass, the reads and writes of a pass.
class PassBuilder {
public:
    explicit PassBuilder(Pass& pass) : pass_(pass) {}

    void read(Handle handle, Access access);
    /// Returns the handle of the new version. The former content is kept if the version is above 0
    /// (or the host wrote it); a version 0 is undefined to the pass, which has to initialise the
    /// parts it uses.
    [[nodiscard]] Handle write(Handle handle, Access access);
    /// Reads and writes as the accesses say. What is bound several times, in the same way, is used
    /// once.
    void use(std::span<const Bound> bound);

private:
    Pass& pass_;
};

struct Resource {
    bool is_image = false;
    bool imported = false;     // always true for buffers
    ImageDescription image;    // where is_image; without an extent where imported
    BufferDescription buffer;  // otherwise
    ExternalAccess outside;    // where imported
    /// Version 0 may be read.
    [[nodiscard]] bool has_content() const {
        return buffer.written_by_host || (!is_image && outside.before.has_value());
    }
    [[nodiscard]] const std::string& name() const { return is_image ? image.name : buffer.name; }
};

/// Passes and the resources they use, as declared. Independent of any device.
class Graph {
public:
    Handle create_image(ImageDescription description);
    Handle import_buffer(BufferDescription description, ExternalAccess outside = {});
    Handle import_image(ImportedImageDescription description, ExternalAccess outside);

    /// Calls `setup` at once with a PassBuilder.
    template <class Setup>
    void add_pass(std::string name, PassKind kind, Setup&& setup) {
        Pass& pass = passes_.emplace_back();
        pass.name = std::move(name);
        pass.kind = kind;
        PassBuilder builder(pass);
        setup(builder);
    }

    [[nodiscard]] const std::vector<Resource>& resources() const { return resources_; }
    [[nodiscard]] const std::vector<Pass>& passes() const { return passes_; }

private:
    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
};

}  // namespace nearfield::graph
