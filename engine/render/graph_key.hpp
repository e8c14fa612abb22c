#pragma once

#include <engine/plan/tile_batch.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstddef>

namespace nearfield::render {

/// The outputs that a tile batch of the compute technique needs; all false for one that is drawn.
struct ComputeKey {
    bool field_values = false;
    bool field_features = false;
    bool field_points = false;  ///< some output at points of a field
    bool fields = false;        ///< values or features of fields
    bool overlap = false;
    bool keeps_hits = false;  ///< another pass reads the masks of some overlap

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
    ComputeKey compute;                                   ///< compute technique: replaces all else

    [[nodiscard]] bool any_field() const { return field_cells || field_points; }
    [[nodiscard]] bool field_by(SignEncoding encoding) const {
        return field[static_cast<std::size_t>(encoding)];
    }

    friend bool operator==(const GraphKey&, const GraphKey&) = default;
};

}  // namespace nearfield::render
