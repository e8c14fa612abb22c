#pragma once

#include <tools/benchmark/machine.hpp>
#include <tools/commands/technique_race.hpp>

#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::tools {

/// Where a table was measured.
struct Surroundings {
    benchmark::Machine machine;
    std::string device;
    std::string driver;
};

/// The table for people, in Markdown, written row by row.
class TextTable {
public:
    /// Writes what stands above the rows.
    TextTable(std::ostream& stream, const Surroundings& surroundings);

    void add(const RowTimes& row);
    /// Writes what refusals mean.
    void finish();

private:
    [[nodiscard]] std::string cell(const TechniqueTime& time);

    std::ostream& stream_;
    std::vector<std::string> refusals_;  // different ones; a row names them by number
};

/// Writes the table as JSON, with a line feed at its end.
void write_table_json(std::ostream& stream, std::span<const RowTimes> table,
                      const Surroundings& surroundings);

}  // namespace nearfield::tools
