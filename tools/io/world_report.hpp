#pragma once

#include <tools/io/json_writer.hpp>
#include <tools/io/world_answer.hpp>

#include <ostream>

namespace nearfield::tools {

/// Writes the members of an object that is open: the query, the summary and the records, or where
/// they are written to.
void write_world_answer(JsonWriter& json, const WorldAnswer& answer);

/// Writes the lines of a text for people.
void write_world_summary(std::ostream& stream, const WorldAnswer& answer);

}  // namespace nearfield::tools
