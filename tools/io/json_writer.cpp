#include <nlohmann/json.hpp>
#include <tools/io/json_writer.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

namespace nearfield::tools {

void JsonWriter::break_line() {
    stream_.put('\n');
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        stream_ << "  ";
    }
}

void JsonWriter::separate() {
    if (after_key_) {
        after_key_ = false;
        return;
    }
    if (levels_.empty()) {
        return;
    }
    Level& level = levels_.back();
    if (!level.empty) {
        stream_.put(',');
    }
    if (level.layout == Layout::lines) {
        break_line();
    } else if (!level.empty) {
        stream_.put(' ');
    }
    level.empty = false;
}

void JsonWriter::open(char bracket, Layout layout) {
    separate();
    stream_.put(bracket);
    levels_.push_back({layout});
}

void JsonWriter::close(char bracket) {
    const Level level = levels_.back();
    levels_.pop_back();
    if (level.layout == Layout::lines && !level.empty) {
        break_line();
    }
    stream_.put(bracket);
}

JsonWriter& JsonWriter::begin_object(Layout layout) {
    open('{', layout);
    return *this;
}

JsonWriter& JsonWriter::end_object() {
    close('}');
    return *this;
}

JsonWriter& JsonWriter::begin_array(Layout layout) {
    open('[', layout);
    return *this;
}

JsonWriter& JsonWriter::end_array() {
    close(']');
    return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
    separate();
    write_text(name);
    stream_ << ": ";
    after_key_ = true;
    return *this;
}

JsonWriter& JsonWriter::value(double number) {
    if (!std::isfinite(number)) {
        return null();
    }
    separate();
    char digits[32];
    const auto [end, error] = std::to_chars(std::begin(digits), std::end(digits), number);
    static_cast<void>(error);  // a double in its shortest form has at most 24 characters
    stream_.write(digits, end - digits);
    return *this;
}

JsonWriter& JsonWriter::whole(std::uint64_t number) {
    separate();
    stream_ << number;
    return *this;
}

JsonWriter& JsonWriter::value(bool truth) {
    separate();
    stream_ << (truth ? "true" : "false");
    return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
    separate();
    write_text(text);
    return *this;
}

JsonWriter& JsonWriter::value(Vector2 point) {
    return begin_array().value(point.x).value(point.y).end_array();
}

JsonWriter& JsonWriter::value(Feature feature) {
    const bool is_edge = feature.kind == Feature::Kind::edge;
    return begin_object().member(is_edge ? "edge" : "vertex", feature.index).end_object();
}

JsonWriter& JsonWriter::null() {
    separate();
    stream_ << "null";
    return *this;
}

void JsonWriter::write_text(std::string_view text) {
    const bool is_plain = std::all_of(text.begin(), text.end(), [](char character) {
        return character >= ' ' && character <= '~' && character != '"' && character != '\\';
    });
    if (is_plain) {  // so are most, and there may be many
        stream_.put('"');
        stream_ << text;
        stream_.put('"');
        return;
    }
    // Device and file names need not be UTF-8; invalid bytes become U+FFFD.
    stream_ << nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace nearfield::tools
