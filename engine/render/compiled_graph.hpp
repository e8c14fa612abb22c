#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/collect.hpp>
#include <passes/collect_gradients.hpp>
#include <passes/color_fill.hpp>
#include <passes/compute_layout.hpp>
#include <passes/cone_mesh.hpp>
#include <passes/early_out.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fields.hpp>
#include <passes/fill.hpp>
#include <passes/gradient.hpp>
#include <passes/intersect.hpp>
#include <passes/intersection_strategies.hpp>
#include <passes/masks.hpp>
#include <passes/record_context.hpp>
#include <passes/resolve_field.hpp>
#include <passes/resolve_field_points.hpp>
#include <passes/resolve_points.hpp>
#include <passes/stencil_pipelines.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace nearfield::render {

/// The outputs that a tile batch of the compute technique needs; all false for one that is drawn.
struct ComputeKey {
    bool points = false;
    bool field_values = false;
    bool field_features = false;
    bool field_points = false;  ///< some output at points of a field
    bool marks = false;         ///< edges in masks that the host lists: a volume as a mask
    bool fields = false;        ///< values or features of fields
    bool boundaries_a = false;
    bool boundaries_b = false;
    bool overlap = false;

    friend bool operator==(const ComputeKey&, const ComputeKey&) = default;
};

/// The outputs that a tile batch needs, which determine its graph.
struct GraphKey {
    bool points = false;
    std::array<bool, plan::sign_encodings> field{};       ///< by sign encoding
    bool field_cells = false;                             ///< some output at cells of a field
    bool field_points = false;                            ///< some output at points of a field
    bool blended = false;                                 ///< blended gradients
    std::array<bool, intersection_strategies> overlap{};  ///< by strategy
    bool keeps_hits = false;  ///< another pass reads the hits in the cells of some overlap
    ComputeKey compute;       ///< compute technique: replaces all but keeps_hits

    [[nodiscard]] bool any_field() const { return field_cells || field_points; }
    [[nodiscard]] bool field_by(SignEncoding encoding) const {
        return field[static_cast<std::size_t>(encoding)];
    }

    friend bool operator==(const GraphKey&, const GraphKey&) = default;
};

/// The passes of the raster technique with their pipelines.
class RasterPipelines {
public:
    RasterPipelines(const gpu::Device& device, const passes::ComputeLayout& layout);

private:
    // Render passes that pipelines are made for; compatible with those that graphs make.
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
struct ComputePipelines {
    ComputePipelines(const gpu::Device& device, const passes::ComputeLayout& layout);

    passes::ResolvePoints resolve_points;
    passes::Masks masks;
    passes::Fields fields;
};

/// The passes of the techniques that a context has. Made once; compiled graphs combine them.
struct PipelineSet {
    std::optional<RasterPipelines> raster;
    std::optional<ComputePipelines> compute;
};

/// The baked render graph for one GraphKey and one size of atlas.
class CompiledGraph {
public:
    CompiledGraph(const gpu::Device& device, const PipelineSet& passes, GraphKey needs,
                  VkExtent2D extent);

    [[nodiscard]] GraphKey needs() const { return needs_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }

    /// The buffers behind the graph's handles; null for handles that the graph does not have.
    struct Buffers {
        VkBuffer mesh = VK_NULL_HANDLE;
        VkBuffer input = VK_NULL_HANDLE;    ///< of compute passes
        VkBuffer scratch = VK_NULL_HANDLE;  ///< of the compute technique
        VkBuffer fields = VK_NULL_HANDLE;   ///< of the compute technique: shapes and tiles
        VkBuffer crowd = VK_NULL_HANDLE;
        VkBuffer long_searches = VK_NULL_HANDLE;
        VkBuffer words = VK_NULL_HANDLE;      ///< of points and fields
        VkBuffer hits = VK_NULL_HANDLE;       ///< of intersections, where they are kept
        VkBuffer read_back = VK_NULL_HANDLE;  ///< of summaries and samples
    };
    void set_buffers(const Buffers& buffers);
    /// Points the images of descriptor sets to this graph's images.
    void bind_images(const passes::ComputeLayout& layout, const passes::TileBatchSets& sets) const;

    void execute(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                 const passes::RecordContext& context) const {
        graph_.execute(commands, timestamps, context);
    }

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void declare_drawn(const RasterPipelines& passes);
    void declare_compute(const ComputePipelines& passes);
    void declare_images(const RasterPipelines& passes);
    void declare_field(const RasterPipelines& passes);
    /// The passes over masks, and of fields at cells; returns what these wrote.
    passes::Fields::Output declare_masked(const ComputePipelines& passes,
                                          passes::Fields::Output output);
    passes::Fields::Output declare_cells(const passes::Fields& fields, graph::Handle scratch,
                                         passes::Fields::Output output);

    GraphKey needs_;
    VkExtent2D extent_;
    passes::TileGraph graph_;
    graph::Handle mesh_;
    graph::Handle input_;
    graph::Handle scratch_;
    graph::Handle shapes_;
    graph::Handle crowd_;
    graph::Handle long_searches_;
    graph::Handle results_;
    graph::Handle field_;
    graph::Handle samples_;
    graph::Handle kept_hits_;
    passes::FieldImages images_;
    graph::Handle gradients_;
    std::array<graph::Handle, intersection_strategies> hits_;
};

}  // namespace nearfield::render
