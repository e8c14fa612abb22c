#include <tools/io/input_error.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace nearfield::tools {

static_assert(std::endian::native == std::endian::little,
              "values are written as they lie in memory");

namespace {

void write_array(std::ostream& stream, const std::string& type, const std::string& shape,
                 std::span<const std::byte> bytes) {
    constexpr std::size_t preamble = 10;  // magic, version, length of the header
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
    // The data begin at a multiple of 64 bytes; the header ends with a line feed.
    const std::size_t unpadded = preamble + header.size() + 1;
    header.append((64 - unpadded % 64) % 64, ' ').push_back('\n');
    stream.write("\x93NUMPY\x01\x00", 8);
    stream.put(static_cast<char>(header.size() & 0xFFU));
    stream.put(static_cast<char>(header.size() >> 8U));
    stream << header;
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
}

std::string shape_of(std::uint32_t width, std::uint32_t height) {
    return std::to_string(height) + ", " + std::to_string(width);
}

}  // namespace

void write_npy(std::ostream& stream, std::span<const float> values, std::uint32_t width,
               std::uint32_t height) {
    write_array(stream, "<f4", shape_of(width, height), std::as_bytes(values));
}

void write_npy(std::ostream& stream, std::span<const double> values, std::uint32_t width,
               std::uint32_t height) {
    write_array(stream, "<f8", shape_of(width, height), std::as_bytes(values));
}

void write_npy(std::ostream& stream, std::span<const std::uint32_t> values, std::uint32_t width,
               std::uint32_t height) {
    write_array(stream, "<u4", shape_of(width, height), std::as_bytes(values));
}

void write_npy_pairs(std::ostream& stream, std::span<const float> values, std::uint32_t width,
                     std::uint32_t height) {
    write_array(stream, "<f4", shape_of(width, height) + ", 2", std::as_bytes(values));
}

namespace {

/// Takes a file in NumPy's format apart.
class NpyReader {
public:
    NpyReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    NpyArray read() {
        const std::string_view header = take_header();
        const NumberType type = read_type(entry(header, "'descr':"));
        const bool by_columns = entry(header, "'fortran_order':").starts_with("True");
        NpyArray array;
        array.shape = read_shape(entry(header, "'shape':"));
        copy(type, by_columns, array);
        return array;
    }

private:
    struct NumberType {
        char kind = 'f';       // or of whole numbers: i, u
        std::size_t size = 8;  // bytes
        bool is_big_endian = false;
    };

    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError(name_ + ": not an array that can be read: " + reason);
    }

    /// The dictionary that describes the array; leaves the data in `bytes_`.
    std::string_view take_header() {
        constexpr std::string_view magic = "\x93NUMPY";
        if (!bytes_.starts_with(magic) || bytes_.size() < 12) {
            fail("it does not begin as NumPy's files do");
        }
        // Version 1 has two bytes for the length of the header, the later ones four.
        const std::size_t width = bytes_[magic.size()] == 1 ? 2 : 4;
        const std::size_t start = magic.size() + 2 + width;
        std::size_t length = 0;
        for (std::size_t i = 0; i < width; ++i) {
            length |= std::size_t{static_cast<unsigned char>(bytes_[magic.size() + 2 + i])}
                      << (8 * i);
        }
        if (length > bytes_.size() - start) {
            fail("its header is cut off");
        }
        const std::string_view header = bytes_.substr(start, length);
        bytes_.remove_prefix(start + length);
        return header;
    }

    /// What follows a key of the dictionary.
    std::string_view entry(std::string_view header, std::string_view key) const {
        const std::size_t found = header.find(key);
        if (found == std::string_view::npos) {
            fail("its header lacks " + std::string(key));
        }
        header.remove_prefix(found + key.size());
        header.remove_prefix(std::min(header.find_first_not_of(' '), header.size()));
        return header;
    }

    std::vector<std::size_t> read_shape(std::string_view text) const {
        std::vector<std::size_t> shape;
        const std::size_t end = text.find(')');
        if (!text.starts_with('(') || end == std::string_view::npos) {
            fail("its shape is not in parentheses");
        }
        text = text.substr(1, end - 1);
        while (text.find_first_not_of(" ,") != std::string_view::npos) {
            text.remove_prefix(text.find_first_not_of(" ,"));
            std::size_t number = 0;
            const auto [rest, error] =
                std::from_chars(text.data(), text.data() + text.size(), number);
            if (error != std::errc{}) {
                fail("its shape has no whole numbers");
            }
            shape.push_back(number);
            text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
        }
        return shape;
    }

    NumberType read_type(std::string_view text) const {
        text = text.substr(0, std::min(text.find('\'', 1), text.size()));
        const bool is_known = text.size() == 4 && is_in("<>=|", text[1]) &&
                              (text[2] == 'f' ? text[3] == '4' || text[3] == '8'
                                              : is_in("iu", text[2]) && is_in("1248", text[3]));
        if (!is_known) {
            fail("its numbers are neither float32, float64 nor whole numbers of up to 64 bits");
        }
        return {text[2], static_cast<std::size_t>(text[3] - '0'), text[1] == '>'};
    }

    std::size_t count_of(const std::vector<std::size_t>& shape) const {
        std::size_t count = 1;
        for (const std::size_t size : shape) {
            if (size != 0 && count > std::numeric_limits<std::size_t>::max() / 16 / size) {
                fail("its shape is too large");
            }
            count *= size;
        }
        return count;
    }

    double number_at(const NumberType& type, std::size_t place) const {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < type.size; ++i) {
            const std::size_t byte = type.is_big_endian ? type.size - 1 - i : i;
            bits |= std::uint64_t{static_cast<unsigned char>(bytes_[place * type.size + byte])}
                    << (8 * i);
        }
        if (type.kind == 'f') {
            return type.size == 8 ? std::bit_cast<double>(bits)
                                  : static_cast<double>(
                                        std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        }
        // The two's complement within its size.
        const bool is_negative = type.kind == 'i' && (bits >> (8 * type.size - 1)) != 0;
        const std::uint64_t all = ~std::uint64_t{0} >> (64 - 8 * type.size);
        const std::uint64_t magnitude = is_negative ? (~bits & all) + 1 : bits;
        if (magnitude > std::uint64_t{1} << 53U) {
            fail("it has whole numbers above 2^53, which float64 does not hold");
        }
        return is_negative ? -static_cast<double>(magnitude) : static_cast<double>(magnitude);
    }

    void copy(const NumberType& type, bool by_columns, NpyArray& array) const {
        const std::size_t count = count_of(array.shape);
        if (bytes_.size() != count * type.size) {
            fail("its shape " + npy_shape_text(array.shape) + " needs " +
                 std::to_string(count * type.size) + " bytes, and there are " +
                 std::to_string(bytes_.size()));
        }
        array.values.reserve(count);
        std::vector<std::size_t> index(array.shape.size(), 0);
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t place = i;
            if (by_columns) {
                place = 0;
                for (std::size_t k = index.size(); k-- > 0;) {
                    place = place * array.shape[k] + index[k];
                }
            }
            array.values.push_back(number_at(type, place));
            for (std::size_t k = index.size(); k-- > 0 && ++index[k] == array.shape[k];) {
                index[k] = 0;
            }
        }
    }

    std::string_view bytes_;
    const std::string& name_;
};

}  // namespace

NpyArray read_npy(std::string_view bytes, const std::string& name) {
    return NpyReader(bytes, name).read();
}

std::string npy_shape_text(std::span<const std::size_t> shape) {
    std::string text;
    for (const std::size_t size : shape) {
        text += (text.empty() ? "" : ", ") + std::to_string(size);
    }
    return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

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
