#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
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

    /// Adds a compute pass that reads each image, once, and the input of all passes; returns the
    /// new version of `field`, which it writes.
    [[nodiscard]] graph::Handle add_pass(TileGraph& graph, const char* name, graph::Handle input,
                                         graph::Handle field, TileGraph::Record record) const;
};

/// The bits of a texel of an encoding's sign image that are set inside B.
[[nodiscard]] std::uint32_t sign_mask(SignEncoding encoding);

/// The requested outputs at every cell of the field tiles (section 2.2.2 of the paper): the signed
/// distance at its centre, in cells, and the nearest of B's edges (a word of plan::point_inside and
/// the other flags). Reads the feature and sign images, tiles and edge lists; writes the field's
/// buffer, tile after tile.
class ResolveField {
public:
    ResolveField(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass; returns the new version of `field`.
    [[nodiscard]] graph::Handle declare(TileGraph& graph, graph::Handle input,
                                        const FieldImages& images, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    ComputeShader shader_;
};

}  // namespace nearfield::passes
