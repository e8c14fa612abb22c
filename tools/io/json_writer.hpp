#pragma once

#include <nearfield/result.hpp>

#include <concepts>
#include <cstdint>
#include <optional>
#include <ostream>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Writes JSON incrementally, so that a million records need no tree in memory. Numbers have the
/// fewest digits that read back as the same double. Containers opened as `lines` have one element
/// per line; the others are written on one line.
class JsonWriter {
public:
    enum class Layout { one_line, lines };

    explicit JsonWriter(std::ostream& stream) : stream_(stream) {}

    JsonWriter& begin_object(Layout layout = Layout::one_line);
    JsonWriter& end_object();
    JsonWriter& begin_array(Layout layout = Layout::one_line);
    JsonWriter& end_array();
    JsonWriter& key(std::string_view name);

    JsonWriter& value(double number);  ///< null if it is not finite
    JsonWriter& value(bool truth);
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
    JsonWriter& value(Vector2 point);    ///< [x, y]
    JsonWriter& value(Feature feature);  ///< {"edge": index} or {"vertex": index}
    template <std::unsigned_integral Number>
    JsonWriter& value(Number number) {
        return whole(number);
    }
    /// null if there is none
    template <class Value>
    JsonWriter& value(const std::optional<Value>& any) {
        return any ? value(*any) : null();
    }
    /// An array on one line.
    template <std::ranges::input_range Range>
    requires(!std::convertible_to<const Range&, std::string_view>)
        JsonWriter& value(const Range& elements) {
        begin_array();
        for (const auto& element : elements) {
            value(element);
        }
        return end_array();
    }
    JsonWriter& null();

    /// A key and its value, which is null unless `is_there`.
    template <class Value>
    JsonWriter& member(std::string_view name, const Value& any, bool is_there = true) {
        key(name);
        return is_there ? value(any) : null();
    }
    /// A key and an array with an element a line, each of which `write(element)` writes.
    template <class Range, class Write>
    JsonWriter& list(std::string_view name, const Range& elements, Write write) {
        key(name).begin_array(Layout::lines);
        for (const auto& element : elements) {
            write(element);
        }
        return end_array();
    }

private:
    struct Level {
        Layout layout;
        bool empty = true;
    };

    JsonWriter& whole(std::uint64_t number);
    void separate();
    void open(char bracket, Layout layout);
    void close(char bracket);
    void break_line();
    void write_text(std::string_view text);

    std::ostream& stream_;
    std::vector<Level> levels_;
    bool after_key_ = false;
};

}  // namespace nearfield::tools
