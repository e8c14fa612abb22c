#pragma once

#include <nearfield/result.hpp>

#include <tools/output/answer.hpp>

#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// A number for people: six significant digits.
[[nodiscard]] std::string short_number(double number);

/// Writes what an answer says, for people, an item a line.
void write_summary(std::ostream& stream, const Answer& answer);

/// Writes what the answers of a scene say, for people.
void write_scene_summary(std::ostream& stream, std::span<const SceneAnswer> answers,
                         const Timings& timings, const std::string& device,
                         std::string_view technique);

/// Writes the stages of a batch and their passes, for people, an item a line.
void write_timings_summary(std::ostream& stream, const Timings& timings);

}  // namespace nearfield::tools
