#pragma once

#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Decodes what came back of distance fields: distances as the device says them, features and
/// analytic gradients in double precision from the edge it says is nearest, the other gradients
/// and the reconstruction at points from the values of cells.
class FieldDecoder {
public:
    /// `gradient_format`: name of the format that gradients are blended in.
    explicit FieldDecoder(const char* gradient_format) : gradient_format_(gradient_format) {}

    void begin_batch(const plan::Plan& plan) { largest_.assign(plan.queries.size(), 0.0F); }

    /// Takes the read-back of one round.
    void add(const plan::Plan& plan, const plan::Round& round, std::span<const std::uint32_t> words,
             std::vector<AnyResult>& results);

    /// The largest magnitude of a value of a query that the CPU answered, world units.
    void set_largest(std::uint32_t query, double largest) {
        largest_[query] = static_cast<float>(largest);
    }

    /// After the last round: the bounds, which depend on how far the field reaches.
    void finish(const plan::PlannedQuery& planned, std::uint32_t query,
                DistanceFieldResult& result) const;

private:
    void add_tile(const plan::PlannedQuery& planned, const plan::Tile& tile,
                  const plan::TileDraw& draw, std::span<const std::uint32_t> words,
                  DistanceFieldResult& result);
    /// `keep`: the result holds them; if not, it is their magnitude that counts.
    void add_values(const plan::Tile& tile, std::span<const std::uint32_t> words, bool keep,
                    DistanceFieldResult& result);
    static void add_features(const plan::PlannedQuery& planned, const plan::Tile& tile,
                             std::span<const std::uint32_t> words, DistanceFieldResult& result);
    void add_point(const plan::PlannedQuery& planned, const plan::Tile& tile,
                   const plan::PlannedFieldPoint& point, std::span<const std::uint32_t> words,
                   FieldPoint& result);
    /// A distance in cells as the result holds it; the largest of each query is remembered.
    [[nodiscard]] float in_world(std::uint32_t word, const plan::Tile& tile);

    const char* gradient_format_;
    std::vector<float> largest_;  // by query: largest magnitude of a value, world units
};

}  // namespace nearfield
