#include <tools/io/number_table.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/summary.hpp>
#include <tools/io/world_records.hpp>
#include <tools/io/world_report.hpp>
#include <tools/io/world_technique.hpp>
#include <tools/io/world_values.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>

namespace nearfield::tools {
namespace {

/// A row of members; an instance is its name.
auto row_of(JsonWriter& json, const WorldAnswer& answer) {
    return JsonRow(json, [&answer](InstanceHandle handle) {
        return is_instance(handle) ? std::optional<std::string_view>(answer.name_of(handle))
                                   : std::nullopt;
    });
}

template <class Record>
void write_record(JsonWriter& json, const WorldAnswer& answer, const Record& record) {
    if constexpr (std::is_same_v<Record, std::uint8_t>) {
        json.value(record != 0);
    } else if constexpr (std::is_same_v<Record, InstanceHandle>) {
        json.value(answer.name_of(record));
    } else {
        if constexpr (std::is_same_v<Record, RayHit>) {
            if (!is_hit(record)) {
                json.null();
                return;
            }
        }
        auto row = row_of(json, answer);
        json.begin_object();
        write_cells(row, record);
        json.end_object();
    }
}

template <class Records>
void write_records(JsonWriter& json, const WorldAnswer& answer, const Records& found) {
    const auto& records = records_of(found);
    constexpr bool is_bare = std::is_same_v<Records, std::vector<std::uint8_t>>;
    json.key("records").begin_array(is_bare ? JsonWriter::Layout::one_line
                                            : JsonWriter::Layout::lines);
    if constexpr (has_lists<Records>) {
        for (std::size_t input = 0; input + 1 < found.offsets.size(); ++input) {
            json.begin_array();
            for (std::uint32_t i = found.offsets[input]; i < found.offsets[input + 1]; ++i) {
                write_record(json, answer, records[i]);
            }
            json.end_array();
        }
    } else {
        for (const auto& record : records) {
            write_record(json, answer, record);
        }
    }
    json.end_array();
}

/// How many of the inputs hit something.
template <class Records>
std::size_t hit_count(const Records& found) {
    std::size_t count = 0;
    if constexpr (has_lists<Records>) {
        for (std::size_t input = 0; input + 1 < found.offsets.size(); ++input) {
            count += found.offsets[input] < found.offsets[input + 1] ? 1U : 0U;
        }
    } else {
        count = static_cast<std::size_t>(
            std::count_if(found.begin(), found.end(), [](const auto& hit) { return is_hit(hit); }));
    }
    return count;
}

/// The first pose with the least clearance; nothing if no instance is within reach of any pose.
std::optional<std::size_t> least_of(const WorldAnswer& answer,
                                    const std::vector<Clearance>& clearances) {
    const auto least = std::min_element(
        clearances.begin(), clearances.end(),
        [](const Clearance& a, const Clearance& b) { return a.distance < b.distance; });
    const bool is_found =
        least != clearances.end() &&
        (is_instance(least->instance) || least->distance < answer.request->max_clearance);
    return is_found ? std::optional(static_cast<std::size_t>(least - clearances.begin()))
                    : std::nullopt;
}

template <class Records>
void write_counts(JsonWriter& json, const WorldAnswer& /*answer*/, const Records& found) {
    json.member("hit_count", hit_count(found));
    if constexpr (has_lists<Records>) {
        json.member("found", records_of(found).size());
    }
}

void write_counts(JsonWriter& json, const WorldAnswer& answer,
                  const std::vector<Clearance>& clearances) {
    json.key("least");
    const auto least = least_of(answer, clearances);
    if (!least) {
        json.null();
        return;
    }
    auto row = row_of(json, answer);
    json.begin_object().member("pose", *least);
    write_cells(row, clearances[*least]);
    json.end_object();
}

/// Where the records are, and what their numbers mean.
void write_values(JsonWriter& json, const WorldAnswer& answer) {
    json.member("values", answer.request->values);
    json.member("columns", world_columns(answer));
    if (is_npy(answer.request->values)) {
        json.key("instances").begin_array();
        for (const SceneInstance& instance : answer.scene->instances) {
            json.value(instance.name);
        }
        json.end_array();
    }
}

/// "12 points"
std::string count_text(std::size_t count, std::string_view what) {
    return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

template <class Records>
void write_found(std::ostream& stream, const WorldAnswer& answer, const Records& found) {
    std::string text = count_text(answer.request->size(), input_name(*answer.request)) + ", " +
                       std::to_string(hit_count(found)) + " hit";
    if constexpr (has_lists<Records>) {
        text += ", " + std::to_string(records_of(found).size()) + " found";
    }
    write_item(stream, "count", text);
}

void write_found(std::ostream& stream, const WorldAnswer& answer,
                 const std::vector<Clearance>& clearances) {
    write_item(stream, "count", count_text(clearances.size(), "pose"));
    if (const auto least = least_of(answer, clearances)) {
        const Clearance& clearance = clearances[*least];
        const bool is_told = is_instance(clearance.instance);
        write_item(stream, "least",
                   (is_told ? "" : "at most ") + short_number(clearance.distance) +
                       (is_told ? " from " + answer.name_of(clearance.instance) : "") + ", pose " +
                       std::to_string(*least));
    }
}

}  // namespace

void write_world_answer(JsonWriter& json, const WorldAnswer& answer) {
    const WorldRequest& request = *answer.request;
    json.member("query", name_of(request.type));
    json.member("technique", to_string(answering_technique(request)));
    if (request.shape) {
        json.member("shape", answer.scene->shapes[*request.shape].name);
    }
    json.member("against", request.against ? std::optional(request.against->name) : std::nullopt);
    json.member("count", request.size());
    std::visit([&](const auto& found) { write_counts(json, answer, found); }, answer.records);
    if (!request.values.empty()) {
        write_values(json, answer);
    } else if (request.records) {
        std::visit([&](const auto& found) { write_records(json, answer, found); }, answer.records);
    }
}

void write_world_summary(std::ostream& stream, const WorldAnswer& answer) {
    const WorldRequest& request = *answer.request;
    std::string query(name_of(request.type));
    if (request.shape) {
        query += " of " + answer.scene->shapes[*request.shape].name;
    }
    query += request.against ? " against " + request.against->name : " against all instances";
    write_item(stream, "query", query);
    std::visit([&](const auto& found) { write_found(stream, answer, found); }, answer.records);
    if (!request.values.empty()) {
        write_item(stream, "values", request.values);
    }
}

}  // namespace nearfield::tools
