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

/// A row whose cells are members of an object that is open.
class JsonRow {
public:
    JsonRow(const WorldAnswer& answer, JsonWriter& json) : answer_(answer), json_(json) {}

    void number(std::string_view name, double number) { json_.key(name).value(number); }
    void truth(std::string_view name, bool truth) { json_.key(name).value(truth); }
    void instance(std::string_view name, InstanceHandle handle) {
        json_.key(name);
        if (is_instance(handle)) {
            json_.value(std::string_view(answer_.name_of(handle)));
        } else {
            json_.null();
        }
    }
    void state(std::string_view name, ImpactState state) { json_.key(name).value(name_of(state)); }
    void index(std::string_view name, std::uint32_t index, bool is_there) {
        json_.key(name);
        is_there ? json_.value(std::uint64_t{index}) : json_.null();
    }
    void point(std::string_view name, Vector2 point, bool is_there) {
        json_.key(name);
        is_there ? json_.value(point) : json_.null();
    }
    void feature(std::string_view name, Feature feature) {
        json_.key(name).begin_object();
        json_.key(feature.kind == Feature::Kind::edge ? "edge" : "vertex");
        json_.value(std::uint64_t{feature.index}).end_object();
    }

private:
    const WorldAnswer& answer_;
    JsonWriter& json_;
};

template <class Record>
void write_record(JsonWriter& json, const WorldAnswer& answer, const Record& record) {
    if constexpr (std::is_same_v<Record, std::uint8_t>) {
        json.value(record != 0);
    } else if constexpr (std::is_same_v<Record, InstanceHandle>) {
        json.value(std::string_view(answer.name_of(record)));
    } else {
        if constexpr (std::is_same_v<Record, RayHit>) {
            if (!is_hit(record)) {
                json.null();
                return;
            }
        }
        JsonRow row(answer, json);
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
    json.key("hit_count").value(std::uint64_t{hit_count(found)});
    if constexpr (has_lists<Records>) {
        json.key("found").value(std::uint64_t{records_of(found).size()});
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
    JsonRow row(answer, json);
    json.begin_object().key("pose").value(std::uint64_t{*least});
    write_cells(row, clearances[*least]);
    json.end_object();
}

/// Where the records are, and what their numbers mean.
void write_values(JsonWriter& json, const WorldAnswer& answer) {
    json.key("values").value(std::string_view(answer.request->values));
    json.key("columns").begin_array();
    for (const std::string& name : world_columns(answer)) {
        json.value(std::string_view(name));
    }
    json.end_array();
    if (is_npy(answer.request->values)) {
        json.key("instances").begin_array();
        for (const SceneInstance& instance : answer.scene->instances) {
            json.value(std::string_view(instance.name));
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
    json.key("query").value(name_of(request.type));
    json.key("technique").value(to_string(answering_technique(request)));
    if (request.shape) {
        json.key("shape").value(std::string_view(answer.scene->shapes[*request.shape].name));
    }
    json.key("against").value_or_null(request.against ? request.against->name : std::string());
    json.key("count").value(std::uint64_t{request.size()});
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
