#pragma once

#include <tools/benchmark/measuring.hpp>
#include <tools/peers/race.hpp>
#include <tools/peers/world_contest.hpp>

#include <ostream>
#include <span>
#include <string>

namespace nearfield::peers {

/// Writes the lines above the rows of the table.
void write_head(std::ostream& stream, const benchmark::Machine& machine, const std::string& device);

/// Writes a row in Markdown.
void write_row(std::ostream& stream, const ProblemTimes& times);

/// Writes which task each peer answered and how, for the rows in the table.
void write_notes(std::ostream& stream, std::span<const ProblemTimes> table);

/// Writes the rows of worlds in Markdown, with the lines above them.
void write_worlds(std::ostream& stream, std::span<const WorldTimes> table);

/// Writes everything as JSON with a final line feed.
void write_json(std::ostream& stream, std::span<const ProblemTimes> table,
                std::span<const WorldTimes> worlds, const benchmark::Machine& machine,
                const std::string& device);

}  // namespace nearfield::peers
