#include <engine/graph/access.hpp>
#include <engine/graph/bake_steps.hpp>
#include <engine/graph/format.hpp>
#include <engine/graph/names.hpp>

#include <optional>
#include <string>
#include <unordered_set>

namespace nearfield::graph {

namespace {

using std::string;

string quoted(const string& name) {
    string text = "'";
    text += name;
    text += '\'';
    return text;
}

Status check_image(const Resource& resource) {
    const ImageDescription& image = resource.image;
    if (find_format(image.format) == nullptr) {
        return graph_error("image " + quoted(image.name) + " has the format number " +
                           std::to_string(image.format) + ", which the graph does not know");
    }
    if (!resource.imported && (image.extent.width == 0 || image.extent.height == 0)) {
        return graph_error("image " + quoted(image.name) + " is empty: its extent is " +
                           extent_text(image.extent));
    }
    return {};
}

/// The reason why a use does not fit its resource or pass, if it does not.
std::optional<string> misfit(PassKind kind, const Resource& resource, const Use& use) {
    const AccessTraits& access = traits(use.access);
    if (access.of_image != resource.is_image) {
        return resource.is_image ? "which is an image, and that access is for buffers"
                                 : "which is a buffer, and that access is for images";
    }
    if (use.access == Access::exported_buffer || use.access == Access::exported_image) {
        return "which is no pass's: it happens after the graph";
    }
    if (access.pass_kind != kind) {
        return kind == PassKind::graphics ? "but the pass is a graphics pass"
                                          : "but the pass is a compute pass";
    }
    if (access.writes != use.write) {
        return use.write ? "which only reads, but declares it as a write"
                         : "which writes, but declares it as a read";
    }
    if (use.access == Access::color_attachment && !find_format(resource.image.format)->is_color()) {
        return "but its format has no colour";
    }
    if (use.access == Access::depth_stencil_attachment &&
        find_format(resource.image.format)->is_color()) {
        return "but its format has neither depth nor stencil";
    }
    return std::nullopt;
}

Status check_uses(const Graph& graph, const Pass& pass) {
    std::unordered_set<std::uint32_t> seen;
    for (const Use& use : pass.uses) {
        const string pass_name = "pass " + quoted(pass.name);
        if (use.handle.resource >= graph.resources().size()) {
            return graph_error(pass_name + " uses a handle of no resource of this graph (number " +
                               std::to_string(use.handle.resource) + ")");
        }
        const Resource& resource = graph.resources()[use.handle.resource];
        if (!seen.insert(use.handle.resource).second) {
            return graph_error(pass_name + " uses " + quoted(resource.name()) +
                               " twice; one use has to say all");
        }
        if (const std::optional<string> reason = misfit(pass.kind, resource, use)) {
            return graph_error(pass_name + " uses " + quoted(resource.name()) + " as " +
                               traits(use.access).name + ", " + *reason);
        }
    }
    return {};
}

Status check_attachments(const Graph& graph, const Pass& pass) {
    const Resource* first = nullptr;
    const Resource* depth_stencil = nullptr;
    for (const Use& use : pass.uses) {
        if (traits(use.access).usage == 0) {
            continue;
        }
        const Resource& resource = graph.resources()[use.handle.resource];
        if (first == nullptr) {
            first = &resource;
        }
        const VkExtent2D extent = resource.image.extent;
        const VkExtent2D common = first->image.extent;
        if (extent.width != common.width || extent.height != common.height) {
            return graph_error("pass " + quoted(pass.name) + " has attachments of two extents: " +
                               quoted(first->name()) + " is " + extent_text(common) + ", " +
                               quoted(resource.name()) + " is " + extent_text(extent));
        }
        if (use.access != Access::depth_stencil_attachment) {
            continue;
        }
        if (depth_stencil != nullptr) {
            return graph_error("pass " + quoted(pass.name) +
                               " has two depth-stencil attachments, " +
                               quoted(depth_stencil->name()) + " and " + quoted(resource.name()));
        }
        depth_stencil = &resource;
    }
    if (first == nullptr) {
        return graph_error("pass " + quoted(pass.name) +
                           " is a graphics pass and has no attachment");
    }
    return {};
}

}  // namespace

Status check_declarations(const Graph& graph, VkQueueFlags queue) {
    for (const Resource& resource : graph.resources()) {
        if (!resource.is_image) {
            continue;
        }
        if (Status status = check_image(resource); !status.ok()) {
            return status;
        }
    }
    for (const Pass& pass : graph.passes()) {
        if (Status status = check_uses(graph, pass); !status.ok()) {
            return status;
        }
        if (pass.kind != PassKind::graphics) {
            continue;
        }
        if ((queue & VK_QUEUE_GRAPHICS_BIT) == 0) {
            return graph_error("pass " + quoted(pass.name) +
                               " is a graphics pass, and the queue family does not draw");
        }
        if (Status status = check_attachments(graph, pass); !status.ok()) {
            return status;
        }
    }
    return {};
}

}  // namespace nearfield::graph
