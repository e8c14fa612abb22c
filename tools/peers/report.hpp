#pragma once

#include <tools/benchmark/machine.hpp>
#include <tools/peers/race.hpp>

#include <ostream>
#include <span>
#include <string>

namespace nearfield::peers {

/// Writes what stands above the rows of the table.
void write_head(std::ostream& stream, const benchmark::Machine& machine, const std::string& device);

/// Writes a row, in Markdown.
void write_row(std::ostream& stream, const ProblemTimes& times);

/// Writes which question each peer answered, as far as there are rows.
void write_notes(std::ostream& stream, std::span<const ProblemTimes> table);

/// Writes all of it as JSON, with a line feed at its end.
void write_json(std::ostream& stream, std::span<const ProblemTimes> table,
                const benchmark::Machine& machine, const std::string& device);

}  // namespace nearfield::peers
