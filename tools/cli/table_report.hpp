#pragma once

#include <tools/benchmark/machine.hpp>
#include <tools/cli/technique_race.hpp>
#include <tools/io/json_writer.hpp>

#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The environment of a measured table.
struct Surroundings {
    benchmark::Machine machine;
    std::string device;
    std::string driver;
};

/// "2026-11-21, nearfield COMMIT; PROCESSOR, 2 cores; DEVICE (DRIVER)", without a line feed.
void write_surroundings(std::ostream& stream, const Surroundings& surroundings);
/// The same as members of an open object.
void write_surroundings(JsonWriter& json, const Surroundings& surroundings);

/// The table in Markdown, written row by row.
class TextTable {
public:
    /// Writes the lines above the rows.
    TextTable(std::ostream& stream, const Surroundings& surroundings);

    void add(const RowTimes& row);
    /// Writes the explanations of the refusals.
    void finish();

private:
    [[nodiscard]] std::string cell(const TechniqueTime& time);

    std::ostream& stream_;
    std::vector<std::string> refusals_;  // distinct; rows refer to them by number
};

/// Writes the table as JSON with a final line feed.
void write_table_json(std::ostream& stream, std::span<const RowTimes> table,
                      const Surroundings& surroundings);

}  // namespace nearfield::tools
