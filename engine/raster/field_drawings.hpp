#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/raster/drawing.hpp>

#include <cstdint>

namespace nearfield::raster {

/// The bits of a texel of the sign images that are set inside B.
inline constexpr std::uint32_t filled_mask = 1;
inline constexpr std::uint32_t white_mask = 0xff;

/// The passes that draw distance fields (section 2.2 of the paper): sign, nearest feature and
/// blended gradients, in all tiles at once. Each function adds a pass and returns its image.
class FieldDrawings {
public:
    /// `stencil`: the pipelines of number_format.
    FieldDrawings(const gpu::Device& device, const graph::ComputeLayout& compute_layout,
                  VkPipelineLayout layout, const StencilPipelines& stencil);

    /// Polygon fill of B by stencil parity: the sign of the field (section 2.2.2, first encoding),
    /// 1 inside B and 0 outside, in every tile with a field of this encoding.
    [[nodiscard]] graph::Handle fill(const Canvas& canvas) const;

    /// The sign in a colour buffer (second encoding): the inside of B is white. Parity by blending:
    /// each quad of the fill mesh replaces a colour by one minus it. The image is sampled as
    /// unsigned bytes: 255 inside, 0 outside.
    [[nodiscard]] graph::Handle color_fill(const Canvas& canvas) const;

    /// The distance mesh of B: tents and cones with the depth test LESS. The image has the feature
    /// (the edge in the tile's list of nearest edges that won the depth test) in every tile with a
    /// field, except those of signed_features(). The depth image is discarded: passes that need the
    /// distance compute it from the feature.
    [[nodiscard]] graph::Handle features(const Canvas& canvas) const;

    /// The distance mesh with the sign as the top bit of the feature id (third encoding). Ids are
    /// colours of four bytes: the fill inverts the highest byte by blending, as in color_fill(),
    /// and the mesh writes the id to the other three with the depth test LESS. The image is sampled
    /// as one unsigned number per texel.
    [[nodiscard]] graph::Handle signed_features(const Canvas& canvas) const;

    /// The gradient of the whole distance image in three blended draws (section 2.2.3): the image
    /// shifted by one pixel, minus the image shifted by one pixel the other way, times one half.
    /// Both components in one draw, x in red and y in green. Reads the field's values.
    [[nodiscard]] graph::Handle gradients(const Canvas& canvas, graph::Handle field) const;

private:
    void make_color_fill();
    void make_features();
    void make_signed_features();
    void make_gradients();
    void record_gradients(const graph::PassCommands& commands, const DrawContext& context) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const StencilPipelines* stencil_;
    // Render passes that pipelines are made for; compatible with those that graphs make.
    gpu::Owned<VkRenderPass> color_render_pass_;
    gpu::Owned<VkRenderPass> features_render_pass_;
    gpu::Owned<VkRenderPass> signed_features_render_pass_;
    gpu::Owned<VkRenderPass> gradients_render_pass_;
    gpu::Owned<VkPipelineLayout> gradients_layout_;
    struct {
        gpu::Owned<VkPipeline> clear, parity, mesh;
    } color_, features_, signed_features_;
    struct {
        gpu::Owned<VkPipeline> shifted, subtract, multiply;
    } gradients_;
};

}  // namespace nearfield::raster
