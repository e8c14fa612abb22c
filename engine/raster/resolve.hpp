#pragma once

#include <engine/gpu/device.hpp>
#include <engine/raster/drawing.hpp>
#include <passes/compute_shader.hpp>

#include <array>

namespace nearfield::raster {

/// The parts in which passes bind the input of a tile batch.
namespace input_parts {
inline constexpr std::uint32_t tiles = 0;  ///< and groups of cells
inline constexpr std::uint32_t edges = 1;
inline constexpr std::uint32_t points = 2;
inline constexpr std::uint32_t field_points = 3;
}  // namespace input_parts

/// The images of a field, by sign encoding; handles of unused encodings are null.
struct FieldImages {
    struct Pair {
        graph::Handle features;
        graph::Handle sign;  ///< the same image if the sign is a bit of the feature
    };
    std::array<Pair, sign_encodings> by_encoding;
};

/// The compute passes that write for the host what was drawn. Each function adds a pass.
class Resolve {
public:
    Resolve(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Point depth (section 2.2.4 of the paper): for every point of the tile batch, whether it lies
    /// inside B, which of B's edges is nearest, and whether that is the only answer within the
    /// margin. Writes one word per point (shaders::point_inside and the other flags).
    void points(DrawGraph& graph, graph::Handle input, graph::Handle results,
                FieldImages::Pair images) const;

    /// The requested outputs at every cell of the field tiles (section 2.2.2), tile after tile: the
    /// signed distance at its centre, in cells, and the nearest of B's edges (a word of
    /// shaders::point_inside and the other flags).
    void field_cells(DrawGraph& graph, graph::Handle input, FieldImages images,
                     graph::Handle& field) const;
    /// The cells from which a field is reconstructed at points (section 2.2.2: only the requested
    /// pixels are read back), and the feature nearest to each point, point after point: a few words
    /// each (queries::FieldParts).
    void field_points(DrawGraph& graph, graph::Handle input, FieldImages images,
                      graph::Handle& field) const;
    /// Copies blended gradients: whole tiles, and the four cells around each point.
    void gradients(DrawGraph& graph, graph::Handle input, graph::Handle gradients,
                   graph::Handle& field) const;

    /// Collects the samples of the overlap tiles of one strategy (the paper's search through the
    /// image, section 2.2.1). Writes a summary per tile (shaders::TileSummary); for tiles that list
    /// their samples, the number of samples and as many as there is space for
    /// (shaders::SampleData), in any order. `samples`: summaries, count and list, which the host
    /// has initialised.
    void samples(DrawGraph& graph, graph::Handle input, graph::Handle hits, graph::Handle& samples,
                 IntersectionStrategy strategy) const;

private:
    passes::ComputeShader points_;
    passes::ComputeShader field_cells_;
    passes::ComputeShader field_points_;
    passes::ComputeShader gradients_;
    passes::ComputeShader numbers_;
    passes::ComputeShader colors_;
};

}  // namespace nearfield::raster
