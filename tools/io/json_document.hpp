#pragma once

#include <nearfield/shape.hpp>

#include <nlohmann/json.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/names.hpp>
#include <tools/io/number_table.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Parses JSON. Throws InputError with file, line and column if the text is not JSON.
[[nodiscard]] nlohmann::json parse_json(const std::string& text, const std::string& file);

/// A value of a JSON document together with its path, so that every error can name the place:
/// "FILE: features[0].geometry.type: ...". Refers to the document, which must outlive it.
class JsonPlace {
public:
    JsonPlace(const nlohmann::json& value, std::string file);

    [[nodiscard]] const nlohmann::json& value() const noexcept { return *value_; }
    [[nodiscard]] const std::string& file() const noexcept { return file_; }

    /// A member of an object. Throws InputError if it is missing.
    [[nodiscard]] JsonPlace member(const std::string& key) const;
    [[nodiscard]] bool has(const std::string& key) const;
    /// An element of an array. Precondition: it exists.
    [[nodiscard]] JsonPlace element(std::size_t index) const;

    /// The value as a certain type. Throws InputError if it has another type.
    const JsonPlace& require_object() const;
    const JsonPlace& require_array() const;
    [[nodiscard]] const std::string& string() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] bool boolean() const;

    /// "FILE: features[0].geometry"
    [[nodiscard]] std::string text() const;
    /// Throws InputError with the place and a reason.
    [[noreturn]] void fail(std::string_view reason) const;

private:
    JsonPlace(const nlohmann::json& value, std::string file, std::string path);

    const nlohmann::json* value_;
    std::string file_;
    std::string path_;
};

// What the members of a scene have in common. All throw InputError with the place and the reason.

/// A member that is not known: of a scene that is not understood.
class UnknownMember : public InputError {
public:
    using InputError::InputError;
};

/// Throws UnknownMember for the first member of an object that is not listed.
void require_known_members(const JsonPlace& place, const std::vector<std::string_view>& known);

/// An array of `count` finite numbers; `form` says what they are.
[[nodiscard]] std::vector<double> numbers(const JsonPlace& place, std::size_t count,
                                          const std::string& form);
/// Appends the numbers of an array; returns false where they are not `columns` finite numbers.
[[nodiscard]] bool append_row(const nlohmann::json& row, std::size_t columns,
                              std::vector<double>& numbers);
/// An array of arrays of `columns` finite numbers; `form` says what they are. Places are made only
/// for what is wrong: there may be many rows.
[[nodiscard]] NumberTable read_rows(const JsonPlace& place, std::size_t columns,
                                    const std::string& form);
[[nodiscard]] double read_above_zero(const JsonPlace& place);
/// A whole number from 1 to 1,000,000,000.
[[nodiscard]] std::uint32_t read_count(const JsonPlace& place);
/// [x0, y0, x1, y1]: the low corner, then the high one.
[[nodiscard]] Rectangle read_rectangle(const JsonPlace& place);
/// The path that a string states, relative to the folder of the document's file.
[[nodiscard]] std::string read_path(const JsonPlace& name);
/// Refuses an angle that is too large to mean anything.
void require_angle(const JsonPlace& pose, double degrees);

/// The index of the entry with a name; nothing if there is none. The entries are in ascending order
/// of their names, as the members of an object are read.
template <class Entry>
std::optional<std::size_t> find_name(const std::vector<Entry>& entries, const std::string& name) {
    const auto found =
        std::lower_bound(entries.begin(), entries.end(), name,
                         [](const Entry& entry, const std::string& of) { return entry.name < of; });
    if (found == entries.end() || found->name != name) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - entries.begin());
}

/// The index of the entry that the string at a place names; `kind` says what it is.
template <class Entry>
std::size_t find_entry(const std::vector<Entry>& entries, const JsonPlace& place,
                       const std::string& kind) {
    const std::optional<std::size_t> found = find_name(entries, place.string());
    if (!found) {
        place.fail("there is no " + kind + " \"" + place.string() + "\"");
    }
    return *found;
}

/// The value that the string at a place names.
template <class Value>
[[nodiscard]] Value read_name(const JsonPlace& place) {
    return parse_name<Value>(place.string(), place.text());
}

}  // namespace nearfield::tools
