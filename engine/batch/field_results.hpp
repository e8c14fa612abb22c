#pragma once

#include <engine/device_input/plan.hpp>
#include <engine/device_input/tile_batch.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::batch {

/// Decodes distance fields: distances as the device computed them; features and analytic gradients
/// in double precision from the edge that the device found nearest; other gradients, and the
/// reconstruction at points, from the values of cells.
class FieldDecoder {
public:
    /// `gradient_format`: name of the format that gradients are blended in.
    explicit FieldDecoder(const char* gradient_format) : gradient_format_(gradient_format) {}

    void begin_batch(const device_input::Plan& plan) {
        largest_.assign(plan.queries.size(), 0.0F);
        refused_.clear();
    }

    /// Decodes the read-back of one tile batch.
    void add(const device_input::Plan& plan, const device_input::TileBatch& batch,
             std::span<const std::uint32_t> words, std::vector<AnyResult>& results);

    /// The device did not answer all cells of the fields of a tile batch.
    void refuse(const device_input::Plan& plan, const device_input::TileBatch& batch);

    /// Call after the last tile batch: sets the bounds, which depend on how far the field reaches.
    void finish(const device_input::PlannedQuery& planned, DistanceFieldResult& result) const;

private:
    void add_tile(const device_input::PlannedQuery& planned, const device_input::PlannedTile& tile,
                  const device_input::FieldTile& field, std::span<const std::uint32_t> words,
                  DistanceFieldResult& result);
    /// `keep`: store the values in the result; otherwise only track their magnitude.
    void add_values(const device_input::PlannedTile& tile, std::span<const std::uint32_t> words,
                    bool keep, DistanceFieldResult& result);
    static void add_features(const device_input::PlannedQuery& planned,
                             const device_input::PlannedTile& tile,
                             std::span<const std::uint32_t> words, DistanceFieldResult& result);
    void add_point(const device_input::PlannedQuery& planned, const device_input::PlannedTile& tile,
                   const queries::PlacedFieldPoint& point, std::span<const std::uint32_t> words,
                   FieldPoint& result);
    /// Converts a distance in cells to the result's units and tracks the largest value of each
    /// query.
    [[nodiscard]] float in_world(std::uint32_t word, const device_input::PlannedTile& tile);

    const char* gradient_format_;
    std::vector<float> largest_;          // by query: largest magnitude of a value, world units
    std::vector<std::uint32_t> refused_;  // queries
};

}  // namespace nearfield::batch
