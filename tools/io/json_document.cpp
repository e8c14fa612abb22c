#include <tools/io/input_error.hpp>
#include <tools/io/json_document.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

using nlohmann::json;

/// Consumes all events and keeps the position and reason of the first error: not all exceptions of
/// the parser carry a position.
class ErrorFinder : public nlohmann::json_sax<json> {
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        position_ = position;
        reason_ = error.what();
        return false;
    }

    [[nodiscard]] std::size_t position() const noexcept { return position_; }
    [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

private:
    std::size_t position_ = 0;
    std::string reason_;
};

/// Detects duplicate names in an object: the parser would silently take the last one.
class NamesInObjects {
public:
    void look_at(json::parse_event_t event, const json& parsed) {
        if (event == json::parse_event_t::object_start) {
            names_.emplace_back();
        } else if (event == json::parse_event_t::object_end) {
            names_.pop_back();
        } else if (event == json::parse_event_t::key && twice_.empty()) {
            const auto& name = parsed.get_ref<const std::string&>();
            twice_ = names_.back().insert(name).second ? "" : name;
        }
    }

    /// The first duplicate name; empty if there is none.
    [[nodiscard]] const std::string& twice() const noexcept { return twice_; }

private:
    std::vector<std::set<std::string>> names_;  // of the enclosing objects
    std::string twice_;
};

/// Removes the exception name and position from the parser's message:
/// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..." becomes
/// "syntax error ...".
std::string plain_reason(std::string reason) {
    if (const std::size_t end = reason.find("] "); reason.starts_with('[')) {
        reason.erase(0, end + 2);
    }
    if (reason.starts_with("parse error at ")) {
        reason.erase(0, reason.find(": ") + 2);
    }
    return reason;
}

std::string with_article(const json& value) {
    std::string name = value.type_name();
    if (value.is_null()) {
        return name;
    }
    return (value.is_array() || value.is_object() ? "an " : "a ") + name;
}

}  // namespace

json parse_json(const std::string& text, const std::string& file) {
    try {
        NamesInObjects names;
        json document =
            json::parse(text, [&names](int, json::parse_event_t event, const json& parsed) {
                names.look_at(event, parsed);
                return true;
            });
        if (!names.twice().empty()) {
            throw InputError(file + ": an object has two members \"" + names.twice() + "\"");
        }
        return document;
    } catch (const json::exception&) {
        ErrorFinder finder;
        json::sax_parse(text, &finder);
        const std::size_t offset = finder.position() > 0 ? finder.position() - 1 : 0;
        throw InputError(text_position(file, text, offset) +
                         ": not JSON: " + plain_reason(finder.reason()));
    }
}

JsonPlace::JsonPlace(const json& value, std::string file) : JsonPlace(value, std::move(file), "") {}

JsonPlace::JsonPlace(const json& value, std::string file, std::string path)
    : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

bool JsonPlace::has(const std::string& key) const {
    return value_->contains(key);
}

JsonPlace JsonPlace::member(const std::string& key) const {
    require_object();
    const auto found = value_->find(key);
    if (found == value_->end()) {
        fail("has no \"" + key + "\"");
    }
    return {*found, file_, path_.empty() ? key : path_ + "." + key};
}

JsonPlace JsonPlace::element(std::size_t index) const {
    return {(*value_)[index], file_, path_ + "[" + std::to_string(index) + "]"};
}

const JsonPlace& JsonPlace::require_object() const {
    if (!value_->is_object()) {
        fail("not an object but " + with_article(*value_));
    }
    return *this;
}

const JsonPlace& JsonPlace::require_array() const {
    if (!value_->is_array()) {
        fail("not an array but " + with_article(*value_));
    }
    return *this;
}

const std::string& JsonPlace::string() const {
    if (!value_->is_string()) {
        fail("not a string but " + with_article(*value_));
    }
    return value_->get_ref<const std::string&>();
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        fail("not a number but " + with_article(*value_));
    }
    const double number = value_->get<double>();
    if (!std::isfinite(number)) {
        fail("not a finite number");
    }
    return number;
}

bool JsonPlace::boolean() const {
    if (!value_->is_boolean()) {
        fail("neither true nor false but " + with_article(*value_));
    }
    return value_->get<bool>();
}

std::string JsonPlace::text() const {
    return path_.empty() ? file_ : file_ + ": " + path_;
}

void JsonPlace::fail(std::string_view reason) const {
    throw InputError(text() + ": " + std::string(reason));
}

void require_known_members(const JsonPlace& place, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : place.require_object().value().items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw UnknownMember(place.member(key).text() + ": is not known here");
        }
    }
}

std::vector<double> numbers(const JsonPlace& place, std::size_t count, const std::string& form) {
    if (place.require_array().value().size() != count) {
        place.fail("expected " + form);
    }
    std::vector<double> numbers;
    for (std::size_t index = 0; index < count; ++index) {
        numbers.push_back(place.element(index).number());
    }
    return numbers;
}

double read_above_zero(const JsonPlace& place) {
    const double number = place.number();
    if (!(number > 0.0)) {
        place.fail("expected a number greater than 0");
    }
    return number;
}

std::uint32_t read_count(const JsonPlace& place) {
    const double number = place.number();
    if (!(number >= 1.0 && number <= 1e9 && number == std::floor(number))) {
        place.fail("expected a whole number from 1 to 1000000000");
    }
    return static_cast<std::uint32_t>(number);
}

Rectangle read_rectangle(const JsonPlace& place) {
    const std::vector<double> corners = numbers(place, 4, "[x0, y0, x1, y1] (four numbers)");
    if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
        place.fail("expected x0 < x1 and y0 < y1");
    }
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

std::string read_path(const JsonPlace& name) {
    const std::filesystem::path folder = std::filesystem::path(name.file()).parent_path();
    return (folder / name.string()).string();
}

void require_angle(const JsonPlace& pose, double degrees) {
    if (const std::string problem = angle_problem(degrees); !problem.empty()) {
        pose.fail(problem);
    }
}

bool append_row(const nlohmann::json& row, std::size_t columns, std::vector<double>& numbers) {
    if (!row.is_array() || row.size() != columns) {
        return false;
    }
    for (const nlohmann::json& number : row) {
        if (!number.is_number()) {
            return false;
        }
        numbers.push_back(number.get<double>());
        if (!std::isfinite(numbers.back())) {
            return false;
        }
    }
    return true;
}

NumberTable read_rows(const JsonPlace& place, std::size_t columns, const std::string& form) {
    NumberTable table{.numbers = {}, .columns = columns};
    const nlohmann::json& rows = place.require_array().value();
    table.numbers.reserve(rows.size() * columns);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!append_row(rows[i], columns, table.numbers)) {
            static_cast<void>(numbers(place.element(i), columns, form));  // says what is wrong
        }
    }
    return table;
}

}  // namespace nearfield::tools
