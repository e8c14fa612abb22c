#pragma once

#include <tools/io/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield::benchmark {

/// A row of the standard table: work done once per frame.
struct Row {
    std::string name;                     ///< "gears x10, contacts"
    std::function<tools::Scene()> scene;  ///< called when the row is measured
};

/// All rows in table order. Names are unique.
[[nodiscard]] std::vector<Row> standard_table();

}  // namespace nearfield::benchmark
