#include "mutation.hpp"

#include <algorithm>
#include <array>

namespace nearfield::test {
namespace {

constexpr std::array<const char*, 14> numbers{
    "0",     "-1",  "1e308", "-1e308",     "1e-320", "nan",  "inf",
    "1e999", "0.5", ".",     "4294967296", "1e12",   "-0.0", "99999999999999999999"};

}  // namespace

std::size_t Mutation::below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
}

void Mutation::change_number(std::string& file) {
    constexpr std::string_view digits = "0123456789";
    const std::size_t first = file.find_first_of(digits, below(file.size()));
    if (first == std::string::npos) {
        return;
    }
    const std::size_t end = std::min(file.find_first_not_of("0123456789.", first), file.size());
    file.replace(first, end - first, numbers[below(numbers.size())]);
}

void Mutation::change_once(std::string& file, std::string_view other) {
    if (file.empty()) {
        file = words_[below(words_.size())];
        return;
    }
    const std::size_t at = below(file.size());
    const std::size_t length = std::min(file.size() - at, 1 + below(below(8) == 0 ? 64 : 4));
    switch (below(8)) {
        case 0:
            file[at] = static_cast<char>(below(256));
            break;
        case 1:
            file[at] = static_cast<char>(static_cast<unsigned char>(file[at]) ^ (1U << below(8)));
            break;
        case 2:
            file.erase(at, length);
            break;
        case 3:
            file.insert(below(file.size()), file.substr(at, length));
            break;
        case 4:
            file.insert(at, words_[below(words_.size())]);
            break;
        case 5:
            change_number(file);
            break;
        case 6: {
            const std::size_t from = below(other.size());
            file.replace(at, length, other.substr(from, 1 + below(32)));
            break;
        }
        default:
            if (below(4) == 0) {
                file.resize(at);
            } else {
                std::swap(file[at], file[below(file.size())]);
            }
    }
}

std::string Mutation::mutate(std::string file, std::string_view other) {
    for (std::size_t changes = 1 + below(below(4) == 0 ? 24 : 4); changes > 0; --changes) {
        change_once(file, other);
    }
    return file;
}

}  // namespace nearfield::test
