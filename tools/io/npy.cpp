#include <tools/io/input_error.hpp>
#include <tools/io/npy.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
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

bool is_in(std::string_view letters, char letter) {
    return letters.find(letter) != std::string_view::npos;
}

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

}  // namespace nearfield::tools
