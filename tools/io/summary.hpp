#pragma once

#include <nearfield/result.hpp>

#include <tools/io/answer.hpp>

#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Formats a number for people: six significant digits.
[[nodiscard]] std::string short_number(double number);

/// Writes a line with an item: its name, and its text in a column of its own.
void write_item(std::ostream& stream, std::string_view name, const std::string& text);

/// Writes an answer for people, one item per line.
void write_summary(std::ostream& stream, const Answer& answer);

/// Writes the answers of a scene for people.
void write_scene_summary(std::ostream& stream, std::span<const SceneAnswer> answers,
                         const Timings& timings, const std::string& device,
                         std::string_view technique);

/// Writes the stages of a batch and their passes for people, one item per line.
void write_timings_summary(std::ostream& stream, const Timings& timings);

}  // namespace nearfield::tools
