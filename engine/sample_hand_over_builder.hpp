#pragma once

#include <engine/plan/hand_over.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Finds what of the intersections of a batch stays on the device (see HandOverBuilder). Keeps its
/// scratch memory.
class SampleHandOverBuilder {
public:
    /// First for each batch.
    void begin() { is_found_ = false; }
    /// Adds a query to what is handed over. `rounds` are the same for all queries of a batch.
    void add(const plan::Plan& plan, std::span<const plan::Round> rounds, std::uint32_t query,
             const IntersectionResult& result, plan::HandOver& hand_over);

private:
    struct FoundTile {
        std::uint32_t index = 0;  ///< in Plan::tiles
        std::uint32_t round = 0;
        plan::SampleTileData data;
    };

    void find_tiles(const plan::Plan& plan, std::span<const plan::Round> rounds);
    void find_drawn(const plan::Plan& plan, const plan::Round& round, FoundTile found);
    void find_masks(const plan::Plan& plan, const plan::Round& round, FoundTile found);
    void add_tiles(const plan::Plan& plan, std::span<const plan::Round> rounds,
                   const IntersectionQuery& asked, plan::HandOver& hand_over);
    void place_blocks(const plan::Plan& plan, std::span<FoundTile> tiles,
                      plan::SamplesHandOver& samples) const;
    [[nodiscard]] std::uint32_t run_table(std::span<const plan::Round> rounds, std::uint32_t number,
                                          plan::HandOver& hand_over);

    bool is_found_ = false;
    std::vector<FoundTile> tiles_;           // of all resident intersections
    std::vector<std::uint32_t> run_tables_;  // by round; no_word where it has none yet
};

}  // namespace nearfield
