#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::test {

/// Changes files at random: bytes, numbers, lines and pieces of it and of other files.
class Mutation {
public:
    /// `words` are pieces that the format knows. Borrowed.
    Mutation(unsigned seed, const std::vector<std::string>& words) : random_(seed), words_(words) {}

    /// A mutated file; `other` lends pieces.
    [[nodiscard]] std::string mutate(std::string file, std::string_view other);

private:
    [[nodiscard]] std::size_t below(std::size_t end);
    void change_once(std::string& file, std::string_view other);
    void change_number(std::string& file);

    std::mt19937 random_;
    const std::vector<std::string>& words_;
};

}  // namespace nearfield::test
