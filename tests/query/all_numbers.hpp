#pragma once

#include <nearfield/nearfield.hpp>

#include <vector>

namespace nearfield::test {

/// All numbers of all results of a batch in order, except times. Two batches have bitwise identical
/// answers if these are equal.
[[nodiscard]] std::vector<double> all_numbers(const Results& results);

}  // namespace nearfield::test
