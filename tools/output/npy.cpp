#include <tools/output/npy.hpp>

#include <bit>
#include <cstddef>
#include <string>

namespace nearfield::tools {

static_assert(std::endian::native == std::endian::little,
              "values are written as they lie in memory");

void write_npy(std::ostream& stream, std::span<const float> values, std::uint32_t width,
               std::uint32_t height) {
    constexpr std::size_t preamble = 10;  // magic, version, length of the header
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                         std::to_string(height) + ", " + std::to_string(width) + "), }";
    // The data begin at a multiple of 64 bytes; the header ends with a line feed.
    const std::size_t unpadded = preamble + header.size() + 1;
    header.append((64 - unpadded % 64) % 64, ' ').push_back('\n');
    stream.write("\x93NUMPY\x01\x00", 8);
    stream.put(static_cast<char>(header.size() & 0xFFU));
    stream.put(static_cast<char>(header.size() >> 8U));
    stream << header;
    const std::span<const std::byte> bytes = std::as_bytes(values);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
}

}  // namespace nearfield::tools
