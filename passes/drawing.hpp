#pragma once

#include <engine/gpu/pipeline.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

#include <initializer_list>

namespace nearfield::passes {

/// Adds a pass that uses resources and draws into a new image, tested against a new image of
/// depths, stencils or both (one without a format: no test). Returns the new version of the former.
[[nodiscard]] graph::Handle add_drawing(TileGraph& graph, const char* name,
                                        std::initializer_list<graph::Bound> reads,
                                        graph::ImageDescription image,
                                        graph::ImageDescription tested, TileGraph::Record record);

/// The description of a pipeline that draws with these shaders, without tests.
[[nodiscard]] gpu::GraphicsPipelineDescription describe_drawing(VkPipelineLayout layout,
                                                                VkRenderPass render_pass,
                                                                gpu::Spirv vertex_shader,
                                                                gpu::Spirv fragment_shader);

/// Combines colours, in some channels, with those in the image.
[[nodiscard]] VkPipelineColorBlendAttachmentState blending(VkBlendFactor source,
                                                           VkBlendFactor destination,
                                                           VkBlendOp operation,
                                                           VkColorComponentFlags channels);

}  // namespace nearfield::passes
