#pragma once

#include <tools/io/text_file.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::tools {

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
