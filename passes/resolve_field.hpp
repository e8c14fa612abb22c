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
};

/// What is read back of the fields of the raster technique, tile after tile or point after point.
class ResolveField {
public:
    ResolveField(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Adds the pass for the requested outputs at every cell of the field tiles (section 2.2.2 of
    /// the paper): the signed distance at its centre, in cells, and the nearest of B's edges (a
    /// word of plan::point_inside and the other flags). Reads the feature and sign images, tiles
    /// and edge lists.
    void declare_cells(TileGraph& graph, graph::Handle input, FieldImages images,
                       graph::Handle& field) const;
    /// Adds the pass for the cells from which a field is reconstructed at points (section 2.2.2:
    /// only the requested pixels are read back), and the feature nearest to each point. Reads the
    /// points, too; writes a few words per point (plan::FieldParts).
    void declare_points(TileGraph& graph, graph::Handle input, FieldImages images,
                        graph::Handle& field) const;
    /// Adds the pass that copies blended gradients: whole tiles, and the four cells around each
    /// point.
    void declare_gradients(TileGraph& graph, graph::Handle input, graph::Handle gradients,
                           graph::Handle& field) const;

private:
    ComputeShader cells_;
    ComputeShader points_;
    ComputeShader gradients_;
};

}  // namespace nearfield::passes
