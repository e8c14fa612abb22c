#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Reads a value of an SVG file (path data, a list of transforms, a number) from front to back, and
/// reports positions in the file.
class SvgText {
public:
    /// `value` begins at byte `offset` of `document`; both, and `file`, must outlive this.
    SvgText(std::string_view value, std::size_t offset, std::string_view document,
            const std::string& file)
        : value_(value), offset_(offset), document_(document), file_(&file) {}

    /// Throws InputError with file, line and column of a byte of the value.
    [[noreturn]] void fail(std::size_t position, const std::string& reason) const;
    [[noreturn]] void fail(const std::string& reason) const { fail(position_, reason); }

    [[nodiscard]] std::size_t position() const noexcept { return position_; }

    /// The next character, 0 at the end.
    [[nodiscard]] char peek() const noexcept {
        return position_ < value_.size() ? value_[position_] : '\0';
    }
    void advance() noexcept { ++position_; }

    void skip_space();
    /// Space with at most one comma in it.
    void skip_separator();
    /// True if a number could begin next.
    [[nodiscard]] bool number_follows() const noexcept;
    /// Reads letters up to the first other character.
    [[nodiscard]] std::string word();
    void expect(char expected);

    /// Reads a finite number. It ends where the grammar ends it: ".5.5" and "1-2" are two.
    [[nodiscard]] double number();
    /// Reads a single digit 0 or 1: "11" are two flags.
    [[nodiscard]] bool flag();
    /// Reads a separator and a number.
    [[nodiscard]] double next_number() {
        skip_separator();
        return number();
    }

private:
    std::string_view value_;
    std::size_t offset_;
    std::string_view document_;
    const std::string* file_;
    std::size_t position_ = 0;
};

}  // namespace nearfield::tools
