#include <engine/graph/access.hpp>
#include <engine/graph/graph.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::graph {

void PassBuilder::read(Handle handle, Access access) {
    pass_.uses.push_back({.handle = handle, .access = access, .write = false});
}

Handle PassBuilder::write(Handle handle, Access access) {
    pass_.uses.push_back({.handle = handle, .access = access, .write = true});
    return {.resource = handle.resource, .version = handle.version + 1};
}

void PassBuilder::use(std::span<const Bound> bound) {
    for (const Bound& each : bound) {
        if (each.handle == Handle{}) {
            continue;
        }
        const bool is_known =
            std::any_of(pass_.uses.begin(), pass_.uses.end(), [&each](const Use& use) {
                return use.handle.resource == each.handle.resource && use.access == each.access;
            });
        if (!is_known && traits(each.access).writes) {
            each.handle = write(each.handle, each.access);
        } else if (!is_known) {
            read(each.handle, each.access);
        }
        if (each.binding != unbound) {
            pass_.bindings.push_back({.set = each.set,
                                      .binding = each.binding,
                                      .resource = each.handle.resource,
                                      .part = each.part});
        }
    }
}

Handle Graph::create_image(ImageDescription description) {
    Resource& resource = resources_.emplace_back();
    resource.is_image = true;
    resource.image = std::move(description);
    return {.resource = static_cast<std::uint32_t>(resources_.size() - 1), .version = 0};
}

Handle Graph::import_buffer(BufferDescription description, ExternalAccess outside) {
    Resource& resource = resources_.emplace_back();
    resource.imported = true;
    resource.buffer = std::move(description);
    resource.outside = outside;
    return {.resource = static_cast<std::uint32_t>(resources_.size() - 1), .version = 0};
}

Handle Graph::import_image(ImportedImageDescription description, ExternalAccess outside) {
    Resource& resource = resources_.emplace_back();
    resource.is_image = true;
    resource.imported = true;
    resource.image.name = std::move(description.name);
    resource.image.format = description.format;
    resource.outside = outside;
    return {.resource = static_cast<std::uint32_t>(resources_.size() - 1), .version = 0};
}

}  // namespace nearfield::graph
