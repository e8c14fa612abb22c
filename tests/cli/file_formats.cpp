#include "file_formats.hpp"

#include <bit>
#include <cstring>
#include <regex>
#include <stdexcept>
#include <string_view>

namespace nearfield::test {
namespace {

void require(bool condition, const std::string& what) {
    if (!condition) {
        throw std::runtime_error(what);
    }
}

std::uint32_t byte_at(const std::string& bytes, std::size_t offset) {
    return static_cast<unsigned char>(bytes.at(offset));
}

std::uint32_t big_endian(const std::string& bytes, std::size_t offset) {
    return byte_at(bytes, offset) << 24U | byte_at(bytes, offset + 1) << 16U |
           byte_at(bytes, offset + 2) << 8U | byte_at(bytes, offset + 3);
}

}  // namespace

FloatArray parse_npy(const std::string& bytes) {
    constexpr std::size_t preamble = 10;
    require(bytes.starts_with(std::string_view("\x93NUMPY\x01\x00", 8)), "no NPY 1.0 preamble");
    const std::size_t header_size = byte_at(bytes, 8) | byte_at(bytes, 9) << 8U;
    require((preamble + header_size) % 64 == 0, "the data are not aligned to 64 bytes");
    const std::string header = bytes.substr(preamble, header_size);
    require(header.size() == header_size, "the header is cut short");
    static const std::regex form(R"(\{'descr': '<f4', 'fortran_order': False, )"
                                 R"('shape': \((\d+), (\d+)\), \} *\n)");
    std::smatch match;
    require(std::regex_match(header, match, form), "unexpected header: " + header);

    static_assert(std::endian::native == std::endian::little);
    FloatArray array{std::stoul(match[1]), std::stoul(match[2]), {}};
    array.values.resize(array.rows * array.columns);
    const std::size_t size = array.values.size() * sizeof(float);
    require(bytes.size() == preamble + header_size + size, "the data are not rows * columns long");
    std::memcpy(array.values.data(), bytes.data() + preamble + header_size, size);
    return array;
}

PngSize parse_png(const std::string& bytes) {
    require(bytes.starts_with("\x89PNG\r\n\x1A\n"), "no PNG signature");
    require(bytes.size() > 45 && bytes.substr(12, 4) == "IHDR", "no PNG header");
    require(bytes.ends_with(std::string_view("\0\0\0\0IEND\xAE\x42\x60\x82", 12)), "no PNG end");
    return {big_endian(bytes, 16), big_endian(bytes, 20)};
}

}  // namespace nearfield::test
