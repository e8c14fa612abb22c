#pragma once

#include <engine/graph/graph.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Test graphs.
namespace nearfield::graph::testing {

inline constexpr VkExtent2D small_extent = {16, 16};

inline Handle color(Graph& graph, std::string name, VkFormat format = VK_FORMAT_R8_UNORM,
                    VkExtent2D extent = small_extent) {
    return graph.create_image({.name = std::move(name), .format = format, .extent = extent});
}

inline void add_pass(Graph& graph, std::string name, PassKind kind, const std::vector<Use>& uses) {
    graph.add_pass(std::move(name), kind, [&](PassBuilder& pass) {
        for (const Use& use : uses) {
            if (use.write) {
                static_cast<void>(pass.write(use.handle, use.access));
            } else {
                pass.read(use.handle, use.access);
            }
        }
    });
}

/// For passes that record nothing between their barriers.
inline constexpr auto no_commands = [](std::size_t, VkCommandBuffer) {};

inline Use reads(Handle handle, Access access) {
    return {.handle = handle, .access = access, .write = false};
}

inline Use writes(Handle handle, Access access) {
    return {.handle = handle, .access = access, .write = true};
}

inline Handle next(Handle handle) {
    return {.resource = handle.resource, .version = handle.version + 1};
}

/// A random graph that is valid by construction: its passes are created in a valid order, always
/// with the newest handles, and then declared in another order.
class RandomGraph {
public:
    /// `depth_stencil` is a format with both aspects.
    explicit RandomGraph(unsigned seed, VkFormat depth_stencil = VK_FORMAT_D24_UNORM_S8_UINT)
        : random_(seed) {
        make_resources(depth_stencil);
        make_passes();
    }
    /// One of compute passes alone, which write what is exported.
    [[nodiscard]] static RandomGraph that_exports(unsigned seed) { return {seed, Exporting{}}; }

    [[nodiscard]] const Graph& graph() const { return graph_; }

private:
    struct Exporting {};
    RandomGraph(unsigned seed, Exporting) : random_(seed), draws_(false) {
        make_buffers();
        for (int i = 0, count = pick(1, 3); i < count; ++i) {
            const std::string number = std::to_string(i);
            buffers_.push_back(graph_.import_buffer(
                {.name = "records" + number},
                {.before = Access::exported_buffer, .after = Access::exported_buffer}));
            images_.push_back(graph_.import_image(
                {.name = "field" + number, .format = VK_FORMAT_R32_SFLOAT},
                {.before = Access::exported_image, .after = Access::exported_image}));
        }
        make_passes();
    }

    void make_passes() {
        const int pass_count = pick(1, 14);
        for (int i = 0; i < pass_count; ++i) {
            make_pass(i);
        }
        std::vector<std::size_t> order(passes_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), random_);
        for (const std::size_t i : order) {
            add_pass(graph_, passes_[i].name, passes_[i].kind, passes_[i].uses);
        }
    }

    int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool chance(int percent) { return pick(1, 100) <= percent; }

    void make_resources(VkFormat depth_stencil) {
        const VkFormat formats[] = {VK_FORMAT_R8_UNORM, VK_FORMAT_R32_UINT, VK_FORMAT_D32_SFLOAT,
                                    depth_stencil};
        const int image_count = pick(1, 9);
        for (int i = 0; i < image_count; ++i) {
            const int kind = pick(0, 3);
            const auto side = static_cast<std::uint32_t>(pick(1, 2) * 16);
            auto& group = kind < 2 ? colors_ : depths_;
            group.push_back(
                color(graph_, "image" + std::to_string(i), formats[kind], {side, side}));
        }
        colors_.push_back(color(graph_, "fallback"));
        make_buffers();
    }

    void make_buffers() {
        const int buffer_count = pick(1, 4);
        for (int i = 0; i < buffer_count; ++i) {
            buffers_.push_back(graph_.import_buffer({.name = "buffer" + std::to_string(i),
                                                     .written_by_host = chance(50),
                                                     .read_by_host = chance(50)}));
        }
    }

    [[nodiscard]] bool readable(Handle handle) const {
        return handle.version > 0 || graph_.resources()[handle.resource].buffer.written_by_host;
    }

    void make_pass(int number) {
        Pass pass;
        pass.name = "pass" + std::to_string(number);
        pass.kind = draws_ && chance(50) ? PassKind::graphics : PassKind::compute;
        if (pass.kind == PassKind::graphics) {
            use_attachments(pass);
        } else {
            use_sampled(pass);
        }
        use_buffers(pass);
        for (Handle& image : images_) {
            if (chance(40)) {
                pass.uses.push_back(writes(image, Access::storage_image_in_compute));
                image = next(image);
            }
        }
        passes_.push_back(std::move(pass));
    }

    void use_attachments(Pass& pass) {
        Handle& first =
            colors_[static_cast<std::size_t>(pick(0, static_cast<int>(colors_.size()) - 1))];
        const std::uint32_t width = graph_.resources()[first.resource].image.extent.width;
        const std::uint32_t chosen = first.resource;
        for (Handle& handle : colors_) {
            const bool fits = graph_.resources()[handle.resource].image.extent.width == width;
            if (handle.resource == chosen || (fits && chance(25))) {
                pass.uses.push_back(writes(handle, Access::color_attachment));
                handle = next(handle);
            }
        }
        for (Handle& handle : depths_) {
            if (graph_.resources()[handle.resource].image.extent.width == width && chance(50)) {
                pass.uses.push_back(writes(handle, Access::depth_stencil_attachment));
                handle = next(handle);
                return;
            }
        }
    }

    void use_sampled(Pass& pass) {
        for (const std::vector<Handle>* group : {&colors_, &depths_}) {
            for (const Handle handle : *group) {
                if (readable(handle) && chance(40)) {
                    pass.uses.push_back(reads(handle, Access::sampled_in_compute));
                }
            }
        }
    }

    void use_buffers(Pass& pass) {
        for (Handle& handle : buffers_) {
            if (pass.kind == PassKind::compute && chance(30)) {
                pass.uses.push_back(writes(handle, chance(70) ? Access::storage_write_in_compute
                                                              : Access::transfer_write));
                handle = next(handle);
            } else if (readable(handle) && chance(50)) {
                const bool graphics = pass.kind == PassKind::graphics;
                pass.uses.push_back(reads(
                    handle, graphics ? Access::vertex_buffer : Access::storage_read_in_compute));
            }
        }
    }

    std::mt19937 random_;
    bool draws_ = true;
    Graph graph_;
    std::vector<Handle> colors_;
    std::vector<Handle> depths_;
    std::vector<Handle> buffers_;
    std::vector<Handle> images_;  // that are exported
    std::vector<Pass> passes_;
};

}  // namespace nearfield::graph::testing
