#pragma once

#include <tools/input/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield::benchmark {

/// A row of the standard table: work that is done once a frame.
struct Row {
    std::string name;                     ///< "gears x10, contacts"
    std::function<tools::Scene()> scene;  ///< made when the row's turn comes
};

/// All rows, in the order of the table. Names are unique.
[[nodiscard]] std::vector<Row> standard_table();

}  // namespace nearfield::benchmark
