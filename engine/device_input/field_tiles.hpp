#pragma once

#include <engine/device_input/plan.hpp>
#include <engine/device_input/shapes_in_tiles.hpp>

#include <shaders/fields.h>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// Field tiles whose lists of near edges the device makes (shaders/fields.h).
struct FieldWork {
    std::vector<shaders::FieldTileData> tiles;
    /// Points at which fields are reconstructed; their tiles are among those above.
    std::vector<shaders::TilePointData> points;
    // In all tiles together.
    std::uint32_t regions = 0;
    std::uint32_t quarters = 0;
    std::uint32_t blocks = 0;
    std::uint32_t rows = 0;  ///< of cells
    bool values = false;
    bool features = false;

    void clear();
};

/// The lists of such tiles in the scratch memory: first words, or units of four words.
struct FieldLists {
    std::uint32_t regions = 0;
    std::uint32_t quarters = 0;
    std::uint32_t blocks = 0;
    std::uint32_t segments = 0;  ///< units
    std::uint32_t room = 0;      ///< for segments
    std::uint32_t numbers = 0;   ///< of edges, where there are features
    std::uint32_t crowd = 0;     ///< numbers of crowded blocks, after a word that is 0 at first
    std::uint64_t end = 0;

    /// Lays out the lists from a word on.
    FieldLists(const FieldWork& work, std::uint64_t first_word);
};

/// Upper bound on the bytes of a field's lists.
[[nodiscard]] double bytes_of_field_lists(double cells);

/// Adds a tile whose fill starts at a word of the scratch memory. `first_value`, `first_feature`:
/// where the outputs at cells go in the field's read-back, or not_asked; if both are not, the tile
/// only serves its points. Returns B as the tile sees it.
shaders::ShapeInTileData add_field_tile(const PlannedQuery& query, const PlannedTile& tile,
                                        std::uint32_t mask, std::uint32_t first_value,
                                        std::uint32_t first_feature, ShapesInTiles& shapes,
                                        FieldWork& work);

/// Adds a point of a tile that has been added; `index`: in FieldWork::tiles.
void add_field_point(const PlannedTile& tile, std::uint32_t index,
                     const queries::PlacedFieldPoint& point, FieldWork& work);

}  // namespace nearfield::device_input
