#pragma once

#include <nearfield/result.hpp>

#include <tools/output/answer.hpp>
#include <tools/output/json_writer.hpp>

#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Writes the JSON of one query, with a line feed at its end.
void write_query_json(std::ostream& stream, const Answer& answer);

/// Writes the JSON of a scene's answers, with a line feed at its end. `technique`: of all of them.
void write_scene_json(std::ostream& stream, std::span<const SceneAnswer> answers,
                      const Timings& timings, const std::string& device,
                      std::string_view technique);

/// Writes the member `timings_ms` of an object that is open.
void write_timings(JsonWriter& json, const Timings& timings);

}  // namespace nearfield::tools
