#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace nearfield::tools {

std::string read_text(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw InputError(path + ": is a folder, not a file");
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw InputError(path + ": cannot be opened: " + std::strerror(errno));
    }
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad()) {
        throw InputError(path + ": cannot be read: " + std::strerror(errno));
    }
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.erase(0, 3);
    }
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
        throw InputError(path + ": is empty");
    }
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
        throw InputError(path + ": is not text: a zero byte at offset " + std::to_string(zero));
    }
    return text;
}

std::string text_position(const std::string& path, std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
    return path + ":" + std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

}  // namespace nearfield::tools
