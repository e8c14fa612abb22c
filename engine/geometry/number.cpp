#include <engine/geometry/number.hpp>

#include <array>
#include <charconv>

namespace nearfield::geometry {

std::string number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

}  // namespace nearfield::geometry
