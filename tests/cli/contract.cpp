#include "contract.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace nearfield::test {

using Json = nlohmann::json;

void expect_number(const Json& json, const std::string& key) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json.at(key).is_number()) << key << ": " << json.at(key);
}

namespace {

void expect_times(const Json& times) {
    ASSERT_TRUE(times.is_object()) << times;
    EXPECT_FALSE(times.empty());
    expect_number(times, "total");
    for (const auto& [name, value] : times.items()) {
        for (const Json& time : value.is_object() ? value : Json::array({value})) {
            ASSERT_TRUE(time.is_number()) << name << ": " << time;
            EXPECT_GE(time.get<double>(), 0.0) << name;
        }
    }
}

/// The side of a region's cells, which must be equal in x and y.
double side_of_cells(const Json& region) {
    const auto extent = [&](std::size_t axis) {
        return region.at("max").at(axis).get<double>() - region.at("min").at(axis).get<double>();
    };
    EXPECT_TRUE(region.at("width").is_number_unsigned()) << region;
    EXPECT_TRUE(region.at("height").is_number_unsigned()) << region;
    const double side = extent(0) / region.at("width").get<double>();
    EXPECT_NEAR(extent(1) / region.at("height").get<double>(), side, 1e-9 * side) << region;
    return side;
}

}  // namespace

double expect_common_part(const Json& json, const std::string& query, double tolerance,
                          double cell) {
    EXPECT_EQ(json.at("query"), query);
    EXPECT_EQ(json.at("tolerance").get<double>(), tolerance);
    EXPECT_GE(json.at("error_bound").get<double>(), 0.0);
    EXPECT_LE(json.at("error_bound").get<double>(), tolerance);
    EXPECT_TRUE(json.at("intersects").is_boolean());
    const Json& device = json.at("device");
    EXPECT_TRUE(device.is_string() ? device != ""
                                   : json.at("technique") == "cpu" && device.is_null())
        << device;
    EXPECT_TRUE(json.at("technique") == "raster" || json.at("technique") == "compute" ||
                json.at("technique") == "cpu")
        << json.at("technique");
    expect_times(json.at("timings_ms"));
    for (const char* const count : {"nodes_evaluated", "pairs_rejected", "edges_kept"}) {
        EXPECT_TRUE(json.at("localization").at(count).is_number_unsigned()) << count;
    }
    EXPECT_TRUE(json.at("regions").is_array());
    for (const Json& region : json.at("regions")) {
        const double side = side_of_cells(region);
        cell = cell == 0.0 ? side : cell;
        EXPECT_NEAR(side, cell, 1e-9 * cell) << region;
        EXPECT_NEAR(side, json.at("cell").get<double>(), 1e-9 * side) << region;
    }
    EXPECT_LE(cell, tolerance * std::numbers::sqrt2 * (1.0 + 1e-9));
    return cell;
}

}  // namespace nearfield::test
