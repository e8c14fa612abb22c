#pragma once

#include "support.hpp"

#include <tools/io/dxf.hpp>
#include <tools/io/simple_features.hpp>

#include <sstream>
#include <string>

namespace nearfield::tools {

/// "0 LINE 10 1.5 ..." as a DXF file has it, a word a line.
inline std::string lines(const std::string& words) {
    std::istringstream stream(words);
    std::string text;
    for (std::string word; stream >> word;) {
        text += word + "\r\n";
    }
    return text;
}

/// A drawing of entities in model space.
inline std::string drawing(const std::string& entities, const std::string& before = "") {
    return lines(before + " 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

inline std::string line(const Vector2& a, const Vector2& b) {
    std::ostringstream text;
    text.precision(17);
    text << " 0 LINE 8 0 10 " << a.x << " 20 " << a.y << " 11 " << b.x << " 21 " << b.y;
    return text.str();
}

inline CurvePath read_drawing(const std::string& text, LengthUnit unit = LengthUnit::user) {
    SkippedParts skipped;
    return parse_dxf(text, "a.dxf", skipped, unit);
}

inline std::string refusal(const std::string& text, LengthUnit unit = LengthUnit::user) {
    return input_error([&] { return read_drawing(text, unit); });
}

}  // namespace nearfield::tools
