#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <ostream>
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
    JsonWriter& value(std::uint64_t number);
    JsonWriter& value(bool truth);
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(Vector2 point);  ///< [x, y]
    JsonWriter& null();
    JsonWriter& value_or_null(std::string_view text);  ///< null if it is empty

private:
    struct Level {
        Layout layout;
        bool empty = true;
    };

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
