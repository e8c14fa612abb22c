#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/record_context.hpp>

#include <array>

namespace nearfield::passes {

/// The images of a field, by sign encoding; handles of unused encodings are null.
struct FieldImages {
    struct Pair {
        graph::Handle features;
        graph::Handle sign;  ///< the same image if the sign is a bit of the feature
    };
    std::array<Pair, plan::sign_encodings> by_encoding;

    /// Declares a read of each image, once.
    void declare_reads(graph::PassBuilder& pass) const;
};

/// The bits of a texel of an encoding's sign image that are set inside B.
[[nodiscard]] std::uint32_t sign_mask(SignEncoding encoding);

/// Binds the descriptor set for the field tiles of an encoding.
void bind_field_set(const gpu::Functions& functions, VkCommandBuffer commands,
                    VkPipelineLayout layout, const RecordContext& context, SignEncoding encoding);

/// The requested outputs at every cell of the field tiles (section 2.2.2 of the paper): the signed
/// distance at its centre, in cells, and the nearest of B's edges (a word of plan::point_inside and
/// the other flags). Reads the feature and sign images, tiles and edge lists; writes the field's
/// buffer, tile after tile.
class ResolveField {
public:
    ResolveField(const gpu::Device& device, const ComputeLayout& layout,
                 const RecordContext& context);

    /// Adds the pass; returns the new version of `field`.
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, graph::Handle input,
                                        const FieldImages& images, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const RecordContext* context_;
    gpu::Owned<VkPipeline> pipeline_;
};

}  // namespace nearfield::passes
