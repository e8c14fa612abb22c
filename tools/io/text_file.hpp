#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// The bytes of a file. Throws InputError for what is missing, unreadable or a
/// folder.
[[nodiscard]] std::string read_bytes(const std::string& path);
/// All that a stream still has; `name` is for the messages.
[[nodiscard]] std::string read_bytes(std::istream& stream, const std::string& name);

/// A file as it was read; what begins with a byte order mark of UTF-16 has become UTF-8.
struct InputFile {
    std::string name;  ///< its path, whose extension may say what it holds; for messages
    std::string bytes;
};

/// Reads a file, or for "-" the standard input. Throws InputError as read_bytes().
[[nodiscard]] InputFile read_input(const std::string& path);

/// The extension of a path in lower case, with its point.
[[nodiscard]] std::string lower_case_extension(const std::string& path);

/// Bytes as text: without a leading UTF-8 byte order mark. Throws InputError where nothing else is
/// there, or where a zero byte says that it is no text.
[[nodiscard]] std::string to_text(std::string bytes, const std::string& name);

/// "FILE:LINE:COLUMN" of a byte in a text; lines and columns (in bytes) start at 1.
[[nodiscard]] std::string text_position(const std::string& path, std::string_view text,
                                        std::size_t offset);

}  // namespace nearfield::tools
