#pragma once

#include <tools/io/text_file.hpp>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Writes an array of float32, float64 or uint32 with the shape (height, width) in NumPy's format
/// (version 1.0, little endian, C order), row 0 first. Precondition: width * height values.
void write_npy(std::ostream& stream, std::span<const float> values, std::uint32_t width,
               std::uint32_t height);
void write_npy(std::ostream& stream, std::span<const double> values, std::uint32_t width,
               std::uint32_t height);
void write_npy(std::ostream& stream, std::span<const std::uint32_t> values, std::uint32_t width,
               std::uint32_t height);

/// The same for float32 with the shape (height, width, 2). Precondition: 2 * width * height values.
void write_npy_pairs(std::ostream& stream, std::span<const float> values, std::uint32_t width,
                     std::uint32_t height);

/// An array as a file has it, in C order.
struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<double> values;
};

/// Reads an array of float32, float64 or whole numbers in NumPy's format (versions 1 to 3), in
/// either order of bytes and of elements. Throws InputError with the file's name and what is wrong.
[[nodiscard]] NpyArray read_npy(std::string_view bytes, const std::string& name);

/// "(2, 3)"
[[nodiscard]] std::string npy_shape_text(std::span<const std::size_t> shape);

/// Rows of as many finite numbers each, one row after the other.
struct NumberTable {
    std::vector<double> numbers;
    std::size_t columns = 0;

    [[nodiscard]] std::size_t rows() const noexcept { return numbers.size() / columns; }
    [[nodiscard]] const double* row(std::size_t index) const noexcept {
        return numbers.data() + index * columns;
    }
};

/// Takes a table of `columns` columns from a file: NumPy's format where the name ends in .npy
/// (float32 or float64, shape (rows, columns), C order, little endian), else CSV (commas, a line a
/// row; empty lines are skipped, and so is a first line in which nothing looks like a number, the
/// names of the columns). `form` says what a row is. Throws InputError with the line and column, or
/// the row and column, of what is wrong.
[[nodiscard]] NumberTable read_number_table(const InputFile& file, std::size_t columns,
                                            const std::string& form);

/// True of a file that is read and written in NumPy's format: its name ends in .npy.
[[nodiscard]] bool is_npy(const std::string& path);

}  // namespace nearfield::tools
