#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Reads a text file, without a leading UTF-8 byte order mark. Throws InputError if it is missing,
/// unreadable, a folder, empty or not text.
[[nodiscard]] std::string read_text(const std::string& path);

/// "FILE:LINE:COLUMN" of a byte in a text; lines and columns (in bytes) start at 1.
[[nodiscard]] std::string text_position(const std::string& path, std::string_view text,
                                        std::size_t offset);

}  // namespace nearfield::tools
