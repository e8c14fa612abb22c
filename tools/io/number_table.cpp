#include <tools/io/input_error.hpp>
#include <tools/io/npy.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

/// Reads lines of a CSV text.
class CsvReader {
public:
    CsvReader(const std::string& path, std::string_view text, std::size_t columns,
              const std::string& form)
        : path_(path), text_(text), form_(form) {
        table_.columns = columns;
    }

    NumberTable read() {
        separator_ = separator_of(text_);
        bool is_first = true;
        for (std::size_t start = 0; start < text_.size();) {
            const std::size_t end = std::min(text_.find('\n', start), text_.size());
            const std::string_view line = text_.substr(start, end - start);
            if (!without_spaces(line).empty()) {
                if (!is_first || !is_header(line)) {
                    read_line(line, start);
                }
                is_first = false;
            }
            start = end + 1;
        }
        return std::move(table_);
    }

private:
    /// What separates the fields of a text: semicolons or tabs where the first line with something
    /// in it has any, as spreadsheets write where a comma is the decimal point.
    static char separator_of(std::string_view text) {
        text.remove_prefix(std::min(text.find_first_not_of(" \r\n"), text.size()));
        const std::string_view line = text.substr(0, text.find('\n'));
        for (const char separator : {';', '\t'}) {
            if (line.find(separator) != std::string_view::npos) {
                return separator;
            }
        }
        return ',';
    }

    [[nodiscard]] std::string_view next_field(std::string_view line, std::size_t start) const {
        return line.substr(start, std::min(line.find(separator_, start), line.size()) - start);
    }

    /// Also with a decimal comma, unless commas separate fields.
    [[nodiscard]] bool parse(std::string_view field, double& number) const {
        const std::size_t comma = field.find(',');
        if (comma == std::string_view::npos || field.find('.') != std::string_view::npos) {
            return parse_finite(field, number);
        }
        std::string with_point(field);
        with_point[comma] = '.';
        return parse_finite(with_point, number);
    }

    /// True of a line in which nothing looks like a number.
    [[nodiscard]] bool is_header(std::string_view line) const {
        for (std::size_t start = 0; start <= line.size();) {
            const std::string_view field = next_field(line, start);
            if (resembles_number(without_spaces(field))) {
                return false;
            }
            start += field.size() + 1;
        }
        return true;
    }

    /// True of numbers, and of what was meant as one: with quotes, separated by other characters,
    /// or not finite.
    static bool resembles_number(std::string_view field) {
        field.remove_prefix(std::min(field.find_first_not_of("\"'+-"), field.size()));
        if (field.empty()) {
            return false;
        }
        std::string word(field.substr(0, field.find_first_of("\"'")));
        std::transform(word.begin(), word.end(), word.begin(), [](char letter) {
            return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        });
        return std::isdigit(static_cast<unsigned char>(field.front())) != 0 ||
               field.front() == '.' || word == "nan" || word == "inf" || word == "infinity";
    }

    void read_line(std::string_view line, std::size_t offset) {
        std::size_t count = 0;
        for (std::size_t start = 0; start <= line.size(); ++count) {
            const std::string_view field = next_field(line, start);
            double number = 0.0;
            if (count == table_.columns) {
                fail(offset + start, "there are more numbers than that");
            }
            if (!parse(without_spaces(field), number)) {
                fail(offset + start,
                     "\"" + std::string(without_spaces(field)) + "\" is not a finite number");
            }
            table_.numbers.push_back(number);
            start += field.size() + 1;
        }
        if (count != table_.columns) {
            fail(offset + line.size(), "the line ends after " + std::to_string(count));
        }
    }

    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const {
        throw InputError(text_position(path_, text_, offset) + ": expected " + form_ + "; " +
                         reason);
    }

    const std::string& path_;
    std::string_view text_;
    const std::string& form_;
    char separator_ = ',';
    NumberTable table_;
};

NumberTable read_npy_table(const InputFile& file, std::size_t columns, const std::string& form) {
    const std::string& path = file.name;
    NpyArray array = read_npy(file.bytes, path);
    if (array.shape.size() != 2 || array.shape[1] != columns) {
        throw InputError(path + ": expected rows of " + form + "; the shape is " +
                         npy_shape_text(array.shape));
    }
    for (std::size_t i = 0; i < array.values.size(); ++i) {
        if (!std::isfinite(array.values[i])) {
            throw InputError(path + ": row " + std::to_string(i / columns) + ", column " +
                             std::to_string(i % columns) + ": not a finite number");
        }
    }
    return {std::move(array.values), columns};
}

}  // namespace

bool is_npy(const std::string& path) {
    return path.ends_with(".npy");
}

NumberTable read_number_table(const InputFile& file, std::size_t columns, const std::string& form) {
    if (is_npy(file.name)) {
        return read_npy_table(file, columns, form);
    }
    const std::string text = to_text(file.bytes, file.name);
    return CsvReader(file.name, text, columns, form).read();
}

}  // namespace nearfield::tools
