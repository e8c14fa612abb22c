#pragma once

#include <nearfield/result.hpp>
#include <nearfield/tile.hpp>

#include <tools/io/json_writer.hpp>
#include <tools/io/query_request.hpp>

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace nearfield::tools {

struct WorldAnswer;

/// One query with its answer and everything to report about it. Refers to objects that the caller
/// keeps.
struct Answer {
    const QueryRequest& request;
    const AnyResult& result;
    const Timings& timings;
    const std::string& device;
    const std::vector<TileReport>* tiles = nullptr;  ///< if requested
};

/// One query of a scene and its answer. Refers to objects that the caller keeps.
struct SceneAnswer {
    const QueryRequest& request;
    std::string_view a;  ///< names of the instances; empty where an error concerns all pairs
    std::string_view b;
    const AnyResult& result;  ///< of any kind, with the error as its status, where there is none
    std::string_view kind;    ///< the name of the query, as the scene has it
    /// Of a query of all instances, if it is answered; `result` then only has its status.
    const WorldAnswer* world = nullptr;
    const QueryTime* time = nullptr;  ///< if it was asked for
};

/// A context's device as text for people. `name`: Context::device_name().
[[nodiscard]] inline const std::string& device_text(const std::string& name) {
    static const std::string none = "none";
    return name.empty() ? none : name;
}

/// What a status says, with its reasons.
[[nodiscard]] inline std::string full_message(const Status& status) {
    std::string text = status.message();
    for (const std::string& reason : status.reasons()) {
        text += "\n  - " + reason;
    }
    return text;
}

/// True of a result that says that the shapes meet, as its kind means it: penetrating points,
/// samples or contacts were found; moving shapes touch, or were not proven not to; A is inside B;
/// otherwise the shapes share a point.
[[nodiscard]] inline bool is_hit(const AnyResult& result) {
    return std::visit(
        [](const auto& any) {
            using Result = std::decay_t<decltype(any)>;
            if constexpr (std::is_same_v<Result, TimeOfImpactResult>) {
                return any.state != ImpactState::separated;
            } else if constexpr (std::is_same_v<Result, ContainmentResult>) {
                return any.inside;
            } else if constexpr (requires { any.count; }) {
                return any.count > 0;
            } else {
                return any.intersects;
            }
        },
        result);
}

/// The part that every kind of result has.
[[nodiscard]] inline const ResultSummary& summary_of(const AnyResult& result) {
    return std::visit([](const auto& any) -> const ResultSummary& { return any; }, result);
}

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
