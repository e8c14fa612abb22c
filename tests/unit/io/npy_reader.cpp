#include <gtest/gtest.h>
#include <tools/io/npy.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// A file of a version of NumPy's format: from version 2 on the header's length has four bytes.
template <class Number>
std::string npy(char version, const std::string& header, const std::vector<Number>& numbers) {
    std::string bytes = std::string("\x93NUMPY") + version + '\0';
    bytes += static_cast<char>(header.size() % 256);
    bytes += static_cast<char>(header.size() / 256);
    bytes.resize(version == 1 ? 10 : 12);
    bytes += header;
    const std::size_t start = bytes.size();
    bytes.resize(start + numbers.size() * sizeof(Number));
    std::memcpy(bytes.data() + start, numbers.data(), numbers.size() * sizeof(Number));
    return bytes;
}

TEST(ToolsNpy, IsReadInEveryVersionAndPrecision) {
    // Longer than one byte counts.
    const std::string rest = "'fortran_order': False, 'shape': (2, 3), }" + std::string(300, ' ');
    for (const char version : {'\x01', '\x02', '\x03'}) {
        SCOPED_TRACE(int{version});
        const NpyArray doubles =
            read_npy(npy<double>(version, "{'descr': '<f8', " + rest, {1, 2, 3, 4, 5, 0.1}), "a");
        EXPECT_EQ(doubles.shape, (std::vector<std::size_t>{2, 3}));
        EXPECT_EQ(doubles.values, (std::vector<double>{1, 2, 3, 4, 5, 0.1}));
        const NpyArray floats =
            read_npy(npy<float>(version, "{'descr': '<f4', " + rest, {1, 2, 3, 4, 5, 0.5F}), "a");
        EXPECT_EQ(floats.shape, doubles.shape);
        EXPECT_EQ(floats.values, (std::vector<double>{1, 2, 3, 4, 5, 0.5}));
    }
}

}  // namespace
}  // namespace nearfield::tools
