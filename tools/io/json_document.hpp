#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>

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

}  // namespace nearfield::tools
