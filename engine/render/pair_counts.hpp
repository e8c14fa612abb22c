#pragma once

#include <engine/plan/pair_question.hpp>
#include <nearfield/status.hpp>

#include <shaders/pairs.h>

#include <array>
#include <cstdint>

namespace nearfield::render {

/// How many the search for all pairs of a world has counted, or has room for, by stage
/// (shaders/search.h): edges, points, points found, pairs, their items, and rows.
using PairCounts = std::array<std::uint32_t, plan::stages_of_pairs>;

/// Room for what a first search may find. Tests look at no points.
[[nodiscard]] PairCounts first_capacities(const plan::PairSearchKind& kind);
/// Whether a search of one part can count so many.
[[nodiscard]] bool is_countable(const PairCounts& counts);
/// Throws StatusException (too_large) if one instance has more pairs than can be searched.
void require_searchable(const PairCounts& counts);
/// Capacities for what a search has counted without room for all of it. Stages after one without
/// room have counted only a part, so they get room for as many times more; those after pairs
/// without room have counted nothing but items, and get room another time.
[[nodiscard]] PairCounts grown(const PairCounts& counts, const PairCounts& capacities);
/// The error of a search without room for what it counted; the reasons name each stage.
[[nodiscard]] Status overflow(const PairCounts& counts, const PairCounts& capacities);

}  // namespace nearfield::render
