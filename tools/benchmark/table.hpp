#pragma once

#include <tools/io/input_error.hpp>
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

/// The rows of a table whose names hold a text. Throws InputError, with all names, if there is
/// none.
template <class AnyRow>
[[nodiscard]] std::vector<AnyRow> rows_with(const std::string& filter, std::vector<AnyRow> rows) {
    std::string names;
    for (const AnyRow& row : rows) {
        names += "\n  " + row.name;
    }
    std::erase_if(rows,
                  [&](const AnyRow& row) { return row.name.find(filter) == std::string::npos; });
    if (rows.empty()) {
        throw tools::InputError("--filter: no row of the table has \"" + filter +
                                "\" in its name; there are:" + names);
    }
    return rows;
}

}  // namespace nearfield::benchmark
