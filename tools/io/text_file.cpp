#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace nearfield::tools {

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
        return {name, read_bytes(std::cin, name)};
    }
    return {path, read_bytes(path)};
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

std::string read_text(const std::string& path) {
    return to_text(read_bytes(path), path);
}

std::string text_position(const std::string& path, std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
    return path + ":" + std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

}  // namespace nearfield::tools
