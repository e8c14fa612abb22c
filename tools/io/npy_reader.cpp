#include <tools/io/input_error.hpp>
#include <tools/io/npy.hpp>

#include <charconv>
#include <cstring>
#include <limits>
#include <utility>

namespace nearfield::tools {
namespace {

/// Takes a file in NumPy's format apart.
class NpyReader {
public:
    NpyReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    NpyArray read() {
        const std::string_view header = take_header();
        const std::string_view type = entry(header, "'descr':");
        const bool is_double = type.starts_with("'<f8'");
        if (!is_double && !type.starts_with("'<f4'")) {
            fail("its numbers are not float32 or float64 in little endian order");
        }
        if (!entry(header, "'fortran_order':").starts_with("False")) {
            fail("it is not in C order");
        }
        NpyArray array;
        array.shape = read_shape(entry(header, "'shape':"));
        if (is_double) {
            copy<double>(array);
        } else {
            copy<float>(array);
        }
        return array;
    }

private:
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

    template <class Number>
    void copy(NpyArray& array) const {
        std::size_t count = 1;
        for (const std::size_t size : array.shape) {
            if (size != 0 && count > std::numeric_limits<std::size_t>::max() / 16 / size) {
                fail("its shape is too large");
            }
            count *= size;
        }
        if (bytes_.size() != count * sizeof(Number)) {
            fail("its shape " + npy_shape_text(array.shape) + " needs " +
                 std::to_string(count * sizeof(Number)) + " bytes, and there are " +
                 std::to_string(bytes_.size()));
        }
        array.values.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            Number number{};
            std::memcpy(&number, bytes_.data() + i * sizeof(Number), sizeof(Number));
            array.values.push_back(number);
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
