#pragma once

#include <nearfield/nearfield.hpp>

#include <vector>

namespace nearfield::test {

/// Every number of every result of a batch, one after the other, times left out: two batches are
/// answered the same, bit for bit, where these are equal.
[[nodiscard]] std::vector<double> all_numbers(const Results& results);

}  // namespace nearfield::test
