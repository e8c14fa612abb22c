#pragma once

#include "program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tests/support/folder.hpp>
#include <tests/support/techniques.hpp>

#include <string>
#include <vector>

namespace nearfield::test {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

/// The difference that numbers have from their texts.
constexpr double rounding = 1e-9;

[[nodiscard]] Arguments operator+(Arguments first, const Arguments& second);

/// A folder with the unit square in both formats. Its vertices and edges are numbered
/// counter-clockwise from the origin: edge 0 is the lowest, 1 the right one, 2 the highest, 3 the
/// left one.
class CliTest : public testing::Test {
protected:
    CliTest();

    /// "query TYPE A B --technique TECHNIQUE" with the unit square twice.
    [[nodiscard]] Arguments squares(const std::string& type,
                                    const std::string& technique = has_raster ? "raster"
                                                                              : "compute") const;

    /// The JSON of a query. Unless the exit status is 0 and the standard output is a single JSON
    /// value, the test fails and the result is null.
    [[nodiscard]] static Json answer(const Arguments& query);

    /// The signed distance to an outline at a point.
    [[nodiscard]] double distance_at(const std::string& file, const std::string& point,
                                     const Arguments& options) const;

    /// Expects exit status 2, an empty standard output, a message that contains all of `parts`, and
    /// unchanged files.
    void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const;

    test_support::Folder folder_;
    std::string a_;  ///< GeoJSON
    std::string b_;  ///< well-known text
};

}  // namespace nearfield::test
