#include <tools/io/npy.hpp>

#include <bit>
#include <cstddef>
#include <string>

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

}  // namespace nearfield::tools
