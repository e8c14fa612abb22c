#include <gtest/gtest.h>
#include <tools/io/input_error.hpp>
#include <tools/io/number_table.hpp>

#include <cstdint>
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

template <class Number>
std::vector<double> read_back(const std::string& type, const std::vector<Number>& numbers) {
    const std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                               std::to_string(numbers.size()) + ",), }";
    return read_npy(npy<Number>('\x01', header, numbers), "a").values;
}

TEST(ToolsNpy, WholeNumbersAreRead) {
    EXPECT_EQ(read_back<std::int8_t>("|i1", {-128, -1, 0, 127}),
              (std::vector<double>{-128, -1, 0, 127}));
    EXPECT_EQ(read_back<std::uint8_t>("|u1", {0, 255}), (std::vector<double>{0, 255}));
    EXPECT_EQ(read_back<std::int16_t>("<i2", {-32768, 5}), (std::vector<double>{-32768, 5}));
    EXPECT_EQ(read_back<std::uint32_t>("<u4", {4294967295U}), (std::vector<double>{4294967295.0}));
    EXPECT_EQ(read_back<std::int32_t>("<i4", {-7}), (std::vector<double>{-7}));
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    EXPECT_EQ(read_back<std::int64_t>("<i8", {largest, -largest, -1}),
              (std::vector<double>{0x1p53, -0x1p53, -1}));
    for (const std::int64_t beyond : {largest + 1, -largest - 1, INT64_MIN, INT64_MAX}) {
        EXPECT_THROW(static_cast<void>(read_back<std::int64_t>("<i8", {beyond})), InputError);
    }
    EXPECT_THROW(static_cast<void>(read_back<std::uint64_t>("<u8", {UINT64_MAX})), InputError);
}

TEST(ToolsNpy, BytesAreReadInEitherOrder) {
    EXPECT_EQ(read_back<std::uint64_t>(">f8", {0xf03fU, 0x0008c0U}),
              (std::vector<double>{1.0, -3.0}));
    EXPECT_EQ(read_back<std::uint32_t>(">f4", {0x803fU}), (std::vector<double>{1.0}));
    EXPECT_EQ(read_back<std::uint16_t>(">i2", {0xfeffU}), (std::vector<double>{-2.0}));
}

TEST(ToolsNpy, ElementsAreReadInEitherOrder) {
    const std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3, 2), }";
    std::vector<double> by_columns(12);
    std::vector<double> by_rows;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 2; ++k) {
                const auto value = static_cast<double>(100 * i + 10 * j + k);
                by_columns[i + 2 * (j + 3 * k)] = value;
                by_rows.push_back(value);
            }
        }
    }
    EXPECT_EQ(read_npy(npy<double>('\x01', header, by_columns), "a").values, by_rows);
}

TEST(ToolsNpy, OtherNumbersAreRefused) {
    for (const char* const type : {"<c8", "<f2", "|b1", "<i3", "<U3", "|O", "", "f8"}) {
        EXPECT_THROW(static_cast<void>(read_back<double>(type, {1.0})), InputError) << type;
    }
}

}  // namespace
}  // namespace nearfield::tools
