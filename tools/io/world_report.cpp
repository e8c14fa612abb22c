#include <tools/io/answer.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/world_report.hpp>
#include <tools/io/world_request.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace nearfield::tools {
namespace {

/// A row that collects the names of its cells.
class NamesRow {
public:
    explicit NamesRow(std::vector<std::string>& names) : names_(names) {}

    void number(std::string_view name, double /*number*/) { names_.emplace_back(name); }
    void truth(std::string_view name, bool /*truth*/) { names_.emplace_back(name); }
    void instance(std::string_view name, InstanceHandle /*handle*/) { names_.emplace_back(name); }
    void state(std::string_view name, ImpactState /*state*/) { names_.emplace_back(name); }
    void index(std::string_view name, std::uint32_t /*index*/, bool /*is_there*/) {
        names_.emplace_back(name);
    }
    void point(std::string_view name, Vector2 /*point*/, bool /*is_there*/) {
        names_.push_back(std::string(name) + "_x");
        names_.push_back(std::string(name) + "_y");
    }
    void feature(std::string_view /*name*/, Feature /*feature*/) {
        names_.insert(names_.end(), {"edge", "vertex"});
    }

private:
    std::vector<std::string>& names_;
};

/// A row of numbers.
class NumbersRow {
public:
    NumbersRow(const WorldAnswer& answer, std::vector<double>& numbers)
        : answer_(answer), numbers_(numbers) {}

    void number(std::string_view /*name*/, double number) { numbers_.push_back(number); }
    void truth(std::string_view /*name*/, bool truth) { numbers_.push_back(truth ? 1.0 : 0.0); }
    void instance(std::string_view /*name*/, InstanceHandle handle) {
        const std::size_t index = answer_.index_of(handle);
        numbers_.push_back(index == WorldAnswer::no_instance ? -1.0 : static_cast<double>(index));
    }
    void state(std::string_view /*name*/, ImpactState state) {
        numbers_.push_back(static_cast<double>(state));
    }
    void index(std::string_view /*name*/, std::uint32_t index, bool is_there) {
        numbers_.push_back(is_there ? index : -1.0);
    }
    void point(std::string_view /*name*/, Vector2 point, bool is_there) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        numbers_.push_back(is_there ? point.x : none);
        numbers_.push_back(is_there ? point.y : none);
    }
    void feature(std::string_view /*name*/, Feature feature) {
        index({}, feature.index, feature.kind == Feature::Kind::edge);
        index({}, feature.index, feature.kind == Feature::Kind::vertex);
    }

private:
    const WorldAnswer& answer_;
    std::vector<double>& numbers_;
};

/// A line of CSV.
class CsvRow {
public:
    CsvRow(const WorldAnswer& answer, std::ostream& stream) : answer_(answer), stream_(stream) {}

    void end() {
        stream_.put('\n');
        is_first_ = true;
    }
    void number(std::string_view /*name*/, double number) {
        separate();
        char digits[32];
        const auto [end, error] = std::to_chars(std::begin(digits), std::end(digits), number);
        static_cast<void>(error);  // a double in its shortest form has at most 24 characters
        stream_.write(digits, end - digits);
    }
    void truth(std::string_view /*name*/, bool truth) {
        separate();
        stream_.put(truth ? '1' : '0');
    }
    void instance(std::string_view /*name*/, InstanceHandle handle) {
        separate();
        if (is_instance(handle)) {
            text(answer_.name_of(handle));
        }
    }
    void state(std::string_view /*name*/, ImpactState state) {
        separate();
        stream_ << name_of(state);
    }
    void index(std::string_view /*name*/, std::uint32_t index, bool is_there) {
        separate();
        if (is_there) {
            stream_ << index;
        }
    }
    void point(std::string_view /*name*/, Vector2 point, bool is_there) {
        if (is_there) {
            number({}, point.x);
            number({}, point.y);
        } else {
            separate();
            separate();
        }
    }
    void feature(std::string_view /*name*/, Feature feature) {
        index({}, feature.index, feature.kind == Feature::Kind::edge);
        index({}, feature.index, feature.kind == Feature::Kind::vertex);
    }
    /// A cell, in quotation marks where it needs them.
    void text(const std::string& text) {
        if (text.find_first_of(",\"\r\n") == std::string::npos) {
            stream_ << text;
            return;
        }
        stream_.put('"');
        for (const char character : text) {
            stream_ << (character == '"' ? "\"\"" : std::string(1, character));
        }
        stream_.put('"');
    }
    void separate() {
        if (!is_first_) {
            stream_.put(',');
        }
        is_first_ = false;
    }

private:
    const WorldAnswer& answer_;
    std::ostream& stream_;
    bool is_first_ = true;
};

/// Describes all records to a row, each with the number of its input where there are lists;
/// `end` is called after each.
template <class Row, class End>
void write_all_cells(const WorldAnswer& answer, Row& row, End end) {
    std::visit(
        [&](const auto& found) {
            const auto& records = records_of(found);
            if constexpr (has_lists<std::decay_t<decltype(found)>>) {
                for (std::uint32_t input = 0; input + 1 < found.offsets.size(); ++input) {
                    for (std::uint32_t i = found.offsets[input]; i < found.offsets[input + 1];
                         ++i) {
                        row.index("", input, true);
                        write_cells(row, records[i]);
                        end();
                    }
                }
            } else {
                for (const auto& record : records) {
                    write_cells(row, record);
                    end();
                }
            }
        },
        answer.records);
}

/// What one input of a query is: the name of the column with its number.
std::string_view input_name(const WorldRequest& request) noexcept {
    switch (request.type) {
        case WorldQueryType::nearest:
            return request.shape ? "pose" : "point";
        case WorldQueryType::rays:
            return "segment";
        case WorldQueryType::cast:
            return "sweep";
        case WorldQueryType::overlap:
            if (!request.rectangles.empty()) {
                return "rectangle";
            }
            return request.shape ? "pose" : "point";
        case WorldQueryType::poses:
            break;
    }
    return "pose";
}

/// The columns of a file with the records of an answer. Where there are lists, the first is the
/// number of the pose, point, segment or rectangle.
std::vector<std::string> world_columns(const WorldAnswer& answer) {
    std::vector<std::string> names;
    NamesRow row(names);
    std::visit(
        [&](const auto& found) {
            if (has_lists<std::decay_t<decltype(found)>>) {
                names.emplace_back(input_name(*answer.request));
            }
            write_cells(row, typename std::decay_t<decltype(records_of(found))>::value_type{});
        },
        answer.records);
    return names;
}

}  // namespace

void write_world_csv(std::ostream& stream, const WorldAnswer& answer) {
    CsvRow row(answer, stream);
    for (const std::string& name : world_columns(answer)) {
        row.separate();
        row.text(name);
    }
    row.end();
    write_all_cells(answer, row, [&row] { row.end(); });
}

void write_world_npy(std::ostream& stream, const WorldAnswer& answer) {
    const std::size_t columns = world_columns(answer).size();
    std::vector<double> numbers;
    NumbersRow row(answer, numbers);
    write_all_cells(answer, row, [] {});
    write_npy(stream, std::span<const double>(numbers), static_cast<std::uint32_t>(columns),
              static_cast<std::uint32_t>(numbers.size() / columns));
}

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
