#pragma once

#include <engine/device_input/plan.hpp>
#include <engine/device_input/search_shapes.hpp>

#include <shaders/compute_work.h>

#include <cstdint>

namespace nearfield::device_input {

/// Shapes as tiles of the compute technique see them. Keeps what it makes of a shape until the
/// shape changes.
class ShapesInTiles {
public:
    void begin_batch() { is_begun_ = false; }
    void clear() { shapes_.clear(); }
    /// A shape whose mask starts at a word of the scratch memory. `deviation`: of a simplified
    /// boundary; 0: the shape's own edges.
    [[nodiscard]] shaders::ShapeInTileData see(const geometry::Polygon& polygon, const Pose& pose,
                                               const PlannedTile& tile, double deviation,
                                               std::uint32_t mask);
    /// The chunks of edges of a shape that has been seen.
    [[nodiscard]] std::uint32_t chunks_of(const shaders::ShapeInTileData& seen) const {
        return shapes_.units()[seen.shape][0];
    }
    [[nodiscard]] const SearchShapes& shapes() const { return shapes_; }

private:
    SearchShapes shapes_;
    bool is_begun_ = false;  // the batch has used them
};

}  // namespace nearfield::device_input
