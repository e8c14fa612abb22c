#pragma once

#include <nearfield/result.hpp>

#include <tools/io/answer.hpp>
#include <tools/io/json_writer.hpp>

#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Writes the JSON of one query with a final line feed.
void write_query_json(std::ostream& stream, const Answer& answer);

/// Writes the JSON of a scene's answers with a final line feed. `technique`: the one for all of
/// them.
void write_scene_json(std::ostream& stream, std::span<const SceneAnswer> answers,
                      const Timings& timings, const std::string& device,
                      std::string_view technique);

/// Writes the member `timings_ms` of an object that is open: `total`, and the stages that took
/// place.
void write_timings(JsonWriter& json, const Timings& timings);

/// Writes a member of an object that is open: the time of each pass by its name.
void write_passes(JsonWriter& json, std::string_view name, std::span<const PassTime> passes);

}  // namespace nearfield::tools
