#pragma once

#include <engine/device_input/pair_question.hpp>
#include <nearfield/status.hpp>
#include <nearfield/world_pairs.hpp>

#include <shaders/pairs.h>
#include <shaders/push.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file The capacities of a search between pairs, found or given, and its division into parts.

namespace nearfield::render {

/// How many a search between pairs has counted, or has room for, by stage
/// (shaders/search.h): edges, points, points found, pairs, their items, and rows.
using PairCounts = std::array<std::uint32_t, shaders::stages_of_pairs>;

[[nodiscard]] PairCounts sum(const PairCounts& a, const PairCounts& b);

/// Room for what a first search may find, and for at least the pairs, points and rows of `reserve`.
/// Tests look at no points.
[[nodiscard]] PairCounts first_capacities(const device_input::PairSearchKind& kind,
                                          const PairTableCounts& reserve);
/// Whether a search of one part can count so many.
[[nodiscard]] bool is_countable(const PairCounts& counts);
/// Throws StatusException (too_large) if one instance has more pairs than can be searched.
void require_searchable(const PairCounts& counts);
/// Capacities for what a search has counted without room for all of it. Stages after one without
/// room have counted only a part, so they get room for as many times more; those after pairs
/// without room have counted nothing but items, and get room another time. `headroom`: more than 1
/// if there has to be room for so many times as much; what grows is then at least doubled.
[[nodiscard]] PairCounts grown(const PairCounts& counts, const PairCounts& capacities,
                               double headroom);
/// The error of a search without room for what it counted; the reasons name each stage.
[[nodiscard]] Status overflow(const PairCounts& counts, const PairCounts& capacities);

/// Bytes that a search for pairs needs: of scratch memory, which its parts use in turns, and of
/// what the host reads of each part.
struct PairBytes {
    std::uint64_t scratch = 0;
    std::uint64_t records = 0;
    std::uint64_t rows = 0;

    [[nodiscard]] std::uint64_t found() const { return records + rows; }
    [[nodiscard]] std::uint64_t largest() const { return std::max({scratch, records, rows}); }
};

/// Those of the rows of a part, of one more, and of the numbers of rows that the CPU decides.
[[nodiscard]] std::uint64_t bytes_of_pair_rows(std::uint32_t rows);
/// Those of records that the host reads, if it reads any.
[[nodiscard]] std::uint64_t bytes_of_pair_records(const device_input::PairSearchKind& kind,
                                                  const PairCounts& capacities);
/// Says where a part has its arrays in the scratch memory, behind the boxes of all `instances`.
[[nodiscard]] PairBytes place_pair_arrays(const device_input::PairSearchKind& kind,
                                          std::uint32_t instances, const PairCounts& capacities,
                                          shaders::SearchPush& push);

/// Instances that follow one another, whose pairs are searched at once: those that have one of them
/// first. Or given pairs, each of which counts for an instance.
struct PairPart {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    PairCounts capacities{};
    PairCounts needed{};   ///< without anything to spare; estimated where nothing was counted
    PairCounts counted{};  ///< at least so much is needed
};

/// How much memory a search may use.
struct PairLimits {
    std::uint64_t reach = 0;   ///< in one buffer, as far as shaders reach
    std::uint64_t memory = 0;  ///< in all buffers
};

/// The parts in which pairs are searched one after the other: one, unless that does not fit.
/// Together they have all instances, or all given pairs.
class PairParts {
public:
    /// `first`: see first_capacities().
    PairParts(const device_input::PairSearchKind& kind, const PairCounts& first, bool is_resident);

    [[nodiscard]] std::size_t count() const { return parts_.size(); }
    [[nodiscard]] const PairPart& operator[](std::size_t i) const { return parts_[i]; }

    /// Of how many instances they are from now on. Returns whether they are others. Of a part that
    /// loses some, the rest are taken for average ones.
    bool set_instances(std::uint32_t count);
    /// Of how many given pairs, with how many items: all else is 0. They become one part, with
    /// `room` at least, unless several have as many pairs. Returns whether any part is another.
    bool set_given(const PairCounts& counts, const PairCounts& room);
    /// Takes down what a search has counted in a part that had room for it.
    void note(std::size_t i, const PairCounts& counts) {
        parts_[i].needed = parts_[i].counted = counts;
    }
    /// Makes room for what a search has counted in a part without room for it, and for a little
    /// more; see grown(). Call fit() then.
    void grow(std::size_t i, const PairCounts& counts, double headroom);
    /// Joins the two neighbours that need least, if twice as much would fit. Returns whether it
    /// did; call fit() then. Precondition: all parts were noted.
    bool join(const PairLimits& limits);
    /// Divides parts that do not fit with a little to spare. Throws StatusException (too_large) if
    /// what was counted of one instance does not fit with nothing to spare, or what the search
    /// finds.
    void fit(const PairLimits& limits);

private:
    [[nodiscard]] PairBytes bytes_of(const PairCounts& capacities) const;
    [[nodiscard]] PairBytes bytes_of_all() const;
    [[nodiscard]] PairBytes bytes_of_residents(const PairCounts& capacities) const;
    [[nodiscard]] PairBytes bytes_of_all_residents() const;
    [[nodiscard]] bool fits(const PairCounts& capacities, const PairLimits& limits) const;
    [[nodiscard]] PairCounts with_much_more(const PairCounts& counts) const;
    void divide(std::size_t i, const PairLimits& limits);
    template <class Room>
    bool shrink(const Room& room);
    bool forget_estimates();
    void fit_memory(const PairLimits& limits);

    device_input::PairSearchKind kind_;
    bool is_resident_;
    PairCounts first_capacities_;
    std::vector<PairPart> parts_;
};

}  // namespace nearfield::render
