#pragma once

#include <tools/benchmark/machine.hpp>
#include <tools/peers/race.hpp>

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

/// Writes everything as JSON with a final line feed.
void write_json(std::ostream& stream, std::span<const ProblemTimes> table,
                const benchmark::Machine& machine, const std::string& device);

}  // namespace nearfield::peers
