#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace nearfield::test {

/// Expects a finite number.
void expect_number(const nlohmann::json& json, const std::string& key);

/// Expects the members of every query's JSON: the keys, their types, and the grids of the regions,
/// whose cells must have the side `cell`. If `cell` is 0, the regions may have any common side that
/// does not exceed the tolerance's. Returns the side.
double expect_common_part(const nlohmann::json& json, const std::string& query, double tolerance,
                          double cell);

}  // namespace nearfield::test
