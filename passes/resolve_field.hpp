#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <array>

namespace nearfield::passes {

/// The images that tell of a field, by sign encoding; handles of encodings not in use are null.
struct FieldImages {
    struct Pair {
        graph::Handle features;
        graph::Handle sign;  ///< the same image where the sign is a bit of the feature
    };
    std::array<Pair, sign_encodings> by_encoding;

    /// Each image once.
    void declare_reads(graph::PassBuilder& pass) const;
};

/// Which bits of a texel of an encoding's sign image say "inside".
[[nodiscard]] std::uint32_t sign_mask(SignEncoding encoding);

/// Binds the set of the field tiles of an encoding.
void bind_field_set(const gpu::Functions& functions, VkCommandBuffer commands,
                    VkPipelineLayout layout, const Frame& frame, SignEncoding encoding);

/// What is asked for at every cell of the field tiles (section 2.2.2 of the paper): the signed
/// distance at its centre, in cells, and the nearest of B's edges (plan::point_inside and so on).
/// Reads the feature and sign images, tiles and edge lists; writes the field's buffer, tile after
/// tile.
class ResolveField {
public:
    ResolveField(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass; returns the field's buffer.
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, graph::Handle input,
                                        const FieldImages& images, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> pipeline_;
};

}  // namespace nearfield::passes
