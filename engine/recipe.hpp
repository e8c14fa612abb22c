#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>
#include <nearfield/context.hpp>
#include <passes/blocks.hpp>
#include <passes/collect.hpp>
#include <passes/collect_gradients.hpp>
#include <passes/color_fill.hpp>
#include <passes/compute_layout.hpp>
#include <passes/cone_mesh.hpp>
#include <passes/early_out.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fill.hpp>
#include <passes/frame.hpp>
#include <passes/gradient.hpp>
#include <passes/intersect.hpp>
#include <passes/intersection_strategies.hpp>
#include <passes/masks.hpp>
#include <passes/resolve_field.hpp>
#include <passes/resolve_field_points.hpp>
#include <passes/resolve_points.hpp>
#include <passes/stencil_pipelines.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace nearfield {

/// What a round of the compute technique asks for; all false for one that is drawn.
struct ComputeNeeds {
    bool points = false;
    bool field_values = false;
    bool field_features = false;
    bool field_points = false;  ///< something at points of a field
    bool fill = false;          ///< a volume as a mask, or the sign of a field
    bool boundaries_a = false;
    bool boundaries_b = false;
    bool overlap = false;

    friend bool operator==(const ComputeNeeds&, const ComputeNeeds&) = default;
};

/// What a round asks for.
struct Needs {
    bool points = false;
    std::array<bool, passes::sign_encodings> field{};     ///< by sign encoding
    bool field_cells = false;                             ///< something at every cell of a field
    bool field_points = false;                            ///< something at points of a field
    bool blended = false;                                 ///< blended gradients
    std::array<bool, intersection_strategies> overlap{};  ///< by strategy
    bool keeps_hits = false;  ///< what is found in the cells of some overlap is read once more
    ComputeNeeds compute;     ///< all there is, but for these, where any of it is needed

    [[nodiscard]] bool any_field() const { return field_cells || field_points; }
    [[nodiscard]] bool field_by(SignEncoding encoding) const {
        return field[static_cast<std::size_t>(encoding)];
    }

    friend bool operator==(const Needs&, const Needs&) = default;
};

/// The passes of the raster technique with their pipelines.
class RasterPasses {
public:
    RasterPasses(const gpu::Device& device, const passes::ComputeLayout& layout,
                 const passes::Frame& frame);

private:
    // Render passes that pipelines are made for; those that graphs make are compatible with them.
    gpu::Owned<VkRenderPass> stencil_render_pass_;
    gpu::Owned<VkRenderPass> distance_render_pass_;
    gpu::Owned<VkRenderPass> white_render_pass_;
    gpu::Owned<VkRenderPass> signed_feature_render_pass_;
    gpu::Owned<VkRenderPass> gradient_render_pass_;
    gpu::Owned<VkPipelineLayout> draw_layout_;
    passes::StencilPipelines stencil_;
    passes::IntersectionStrategies strategies_;

public:
    passes::Fill fill;
    passes::ColorFill color_fill;
    passes::ConeMesh cone_mesh;
    passes::FeatureBit feature_bit;
    passes::Gradient gradient;
    passes::EarlyOut early_out;
    passes::Intersect intersect;
    passes::ResolvePoints resolve_points;
    passes::ResolveField resolve_field;
    passes::ResolveFieldPoints resolve_field_points;
    passes::CollectGradients collect_gradients;
    passes::Collect collect;
};

/// The passes of the compute technique with their pipelines.
struct ComputePasses {
    ComputePasses(const gpu::Device& device, const passes::ComputeLayout& layout,
                  const passes::Frame& frame);

    passes::ResolvePoints resolve_points;
    passes::Masks masks;
    passes::Blocks blocks;
};

/// The passes of the techniques that a context has. Made once; recipes put them together.
struct Passes {
    std::optional<RasterPasses> raster;
    std::optional<ComputePasses> compute;
};

/// The render graph that answers some needs on an atlas of some size, baked.
class Recipe {
public:
    Recipe(const gpu::Device& device, const Passes& passes, Needs needs, VkExtent2D extent);

    [[nodiscard]] Needs needs() const { return needs_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }

    /// The buffers behind the graph's handles; null where there is none.
    struct Buffers {
        VkBuffer mesh = VK_NULL_HANDLE;
        VkBuffer input = VK_NULL_HANDLE;      ///< of compute passes
        VkBuffer scratch = VK_NULL_HANDLE;    ///< of the compute technique
        VkBuffer words = VK_NULL_HANDLE;      ///< of points and fields
        VkBuffer hits = VK_NULL_HANDLE;       ///< of intersections, where they are kept
        VkBuffer read_back = VK_NULL_HANDLE;  ///< of summaries and samples
    };
    void set_buffers(const Buffers& buffers);
    /// Points the images of the frame's descriptor sets to this recipe's images.
    void bind_images(const passes::ComputeLayout& layout, const passes::Frame& frame) const;

    void execute(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
        executor_->execute(graph_, commands, timestamps);
    }

    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    void declare_drawn(const RasterPasses& passes);
    void declare_compute(const ComputePasses& passes);
    void declare_images(const RasterPasses& passes);
    void declare_field(const RasterPasses& passes);

    Needs needs_;
    VkExtent2D extent_;
    graph::Graph graph_;
    graph::Handle mesh_;
    graph::Handle input_;
    graph::Handle scratch_;
    graph::Handle results_;
    graph::Handle field_;
    graph::Handle samples_;
    graph::Handle kept_hits_;
    passes::FieldImages images_;
    graph::Handle gradients_;
    std::array<graph::Handle, intersection_strategies> hits_;
    std::unique_ptr<graph::Executor> executor_;
};

}  // namespace nearfield
