#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/raster/drawing.hpp>
#include <engine/raster/field_drawings.hpp>
#include <engine/raster/intersect.hpp>
#include <engine/raster/resolve.hpp>
#include <engine/render/tile_work.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstddef>

namespace nearfield::raster {

/// The passes of the technique with their pipelines.
class Pipelines {
public:
    Pipelines(const gpu::Device& device, const graph::ComputeLayout& layout);

private:
    gpu::Owned<VkRenderPass> number_render_pass_;
    gpu::Owned<VkPipelineLayout> draw_layout_;
    StencilPipelines stencil_;

public:
    FieldDrawings fields;
    Intersect intersect;
    Resolve resolve;
};

/// The outputs that a tile batch needs, which determine its graph.
struct DrawKey {
    bool points = false;
    std::array<bool, sign_encodings> field{};             ///< by sign encoding
    bool field_cells = false;                             ///< some output at cells of a field
    bool field_points = false;                            ///< some output at points of a field
    bool blended = false;                                 ///< blended gradients
    std::array<bool, intersection_strategies> overlap{};  ///< by strategy

    explicit DrawKey(const DrawnBatch& batch);
    [[nodiscard]] bool field_by(SignEncoding encoding) const {
        return field[static_cast<std::size_t>(encoding)];
    }

    friend bool operator==(const DrawKey&, const DrawKey&) = default;
};

/// The graph for one DrawKey and one size of atlas.
class DrawnGraph final : public DrawGraph {
public:
    DrawnGraph(const gpu::Device& device, const Pipelines& passes, const DrawKey& needs,
               VkExtent2D extent);

    [[nodiscard]] const DrawKey& needs() const { return needs_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    [[nodiscard]] graph::Handle input() const { return input_; }  ///< in the parts of input_parts
    [[nodiscard]] graph::Handle mesh() const { return mesh_; }
    [[nodiscard]] const render::OutputHandles& outputs() const { return outputs_; }

private:
    [[nodiscard]] FieldImages draw_fields(const FieldDrawings& drawings);
    void resolve_fields(const Pipelines& passes, FieldImages images);
    void declare_overlaps(const Pipelines& passes);
    [[nodiscard]] Canvas canvas() { return {*this, mesh_, extent_}; }

    DrawKey needs_;
    VkExtent2D extent_;
    graph::Handle input_;
    graph::Handle mesh_;
    render::OutputHandles outputs_;
};

}  // namespace nearfield::raster
