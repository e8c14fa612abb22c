#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace nearfield::test {

/// Expects a finite number.
void expect_number(const nlohmann::json& json, const std::string& key);

/// Expects what every query's JSON has: the keys, their types, the grids of the regions, whose
/// cells have the side `cell`. Where that is 0 any side will do that all regions share and that
/// does not exceed the tolerance's. Returns the side.
double expect_common_part(const nlohmann::json& json, const std::string& query, double tolerance,
                          double cell);

}  // namespace nearfield::test
