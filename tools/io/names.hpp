#pragma once

#include <tools/io/input_error.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace nearfield::tools {

template <class Value>
struct NamedValue {
    std::string_view name;
    Value value;
};

/// The values of an enumeration with their names on the command line, in scenes and in answers. An
/// enumeration that has names specialises this.
template <class Value>
inline constexpr auto names = std::array<NamedValue<Value>, 0>{};

template <class Value>
requires std::is_enum_v<Value>
[[nodiscard]] std::string_view name_of(Value value) noexcept {
    return std::find_if(names<Value>.begin(), names<Value>.end(),
                        [value](const NamedValue<Value>& entry) { return entry.value == value; })
        ->name;
}

template <class Value>
[[nodiscard]] std::optional<Value> find_named(std::string_view name) noexcept {
    for (const auto& [text, value] : names<Value>) {
        if (text == name) {
            return value;
        }
    }
    return std::nullopt;
}

/// The value with a name. Throws InputError with the names that there are, and with `others`, which
/// the caller accepts; `what` says where the name stands ("--kind").
template <class Value>
[[nodiscard]] Value parse_name_or(std::span<const std::string_view> others, const std::string& name,
                                  const std::string& what) {
    if (const std::optional<Value> value = find_named<Value>(name)) {
        return *value;
    }
    std::string choices;
    for (const auto& [text, value] : names<Value>) {
        choices += (choices.empty() ? "" : ", ") + std::string(text);
    }
    for (const std::string_view other : others) {
        choices += ", " + std::string(other);
    }
    throw InputError(what + ": \"" + name + "\" is none of " + choices);
}
template <class Value>
[[nodiscard]] Value parse_name(const std::string& name, const std::string& what) {
    return parse_name_or<Value>({}, name, what);
}

}  // namespace nearfield::tools
