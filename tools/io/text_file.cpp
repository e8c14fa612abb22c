#include <iconv.h>
#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace nearfield::tools {
namespace {

/// Bytes as they are or, if they begin with a byte order mark of UTF-16, as UTF-8.
std::string to_utf8(std::string bytes, const std::string& name) {
    if (!bytes.starts_with("\xFF\xFE") && !bytes.starts_with("\xFE\xFF")) {
        return bytes;
    }
    const iconv_t converter = iconv_open("UTF-8", "UTF-16");
    if (reinterpret_cast<std::intptr_t>(converter) == -1) {
        throw InputError(name + ": this system does not convert UTF-16; save the file as UTF-8");
    }
    std::string text(2 * bytes.size(), '\0');  // a unit of two bytes takes three at most
    char* from = bytes.data();
    char* to = text.data();
    std::size_t from_left = bytes.size();
    std::size_t to_left = text.size();
    const bool is_valid = iconv(converter, &from, &from_left, &to, &to_left) != SIZE_MAX;
    iconv_close(converter);
    if (!is_valid) {
        throw InputError(name + ": is not UTF-16, although it begins so: byte " +
                         std::to_string(bytes.size() - from_left));
    }
    text.resize(text.size() - to_left);
    return text;
}

}  // namespace

std::string read_bytes(std::istream& stream, const std::string& name) {
    std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) {
        throw InputError(name + ": cannot be read: " + std::strerror(errno));
    }
    return bytes;
}

std::string read_bytes(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw InputError(path + ": is a folder, not a file");
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw InputError(path + ": cannot be opened: " + std::strerror(errno));
    }
    return read_bytes(file, path);
}

InputFile read_input(const std::string& path) {
    if (path == "-") {
        const std::string name = "standard input";
        return {name, to_utf8(read_bytes(std::cin, name), name)};
    }
    return {path, to_utf8(read_bytes(path), path)};
}

std::string lower_case_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

std::string to_text(std::string bytes, const std::string& name) {
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.erase(0, 3);
    }
    if (bytes.find_first_not_of(" \t\r\n") == std::string::npos) {
        throw InputError(name + ": is empty");
    }
    if (const std::size_t zero = bytes.find('\0'); zero != std::string::npos) {
        throw InputError(name + ": is not text: a zero byte at offset " + std::to_string(zero));
    }
    return bytes;
}

std::string text_position(const std::string& path, std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
    return path + ":" + std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

}  // namespace nearfield::tools
