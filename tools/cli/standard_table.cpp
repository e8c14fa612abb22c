#include <tools/benchmark/machine.hpp>
#include <tools/benchmark/table.hpp>
#include <tools/cli/standard_table.hpp>
#include <tools/cli/table_report.hpp>
#include <tools/cli/technique_race.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/report_target.hpp>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

std::vector<benchmark::Row> rows_with(const std::string& filter) {
    std::vector<benchmark::Row> rows = benchmark::standard_table();
    std::string names;
    for (const benchmark::Row& row : rows) {
        names += "\n  " + row.name;
    }
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [&](const benchmark::Row& row) {
                                  return row.name.find(filter) == std::string::npos;
                              }),
               rows.end());
    if (rows.empty()) {
        throw InputError("--filter: no row of the table has \"" + filter +
                         "\" in its name; there are:" + names);
    }
    return rows;
}

}  // namespace

void run_standard_table(const std::string& filter, const Settings& settings,
                        const std::optional<std::string>& json) {
    const std::vector<benchmark::Row> rows = rows_with(filter);
    ReportTarget report(json);
    TechniqueRace race(settings);
    const Surroundings surroundings{benchmark::this_machine(), race.device_name(),
                                    benchmark::driver_of(race.device_name())};
    const bool show_progress = isatty(STDERR_FILENO) == 1;
    TextTable text(report.summary(), surroundings);
    std::vector<RowTimes> table;
    for (const benchmark::Row& row : rows) {
        if (show_progress) {
            std::cerr << "row " << table.size() + 1 << " of " << rows.size() << ": " << row.name
                      << "\x1b[K\r" << std::flush;
        }
        stop_after_ctrl_c();
        table.push_back(race.run(row));
        if (show_progress) {
            std::cerr << "\x1b[K" << std::flush;
        }
        text.add(table.back());
    }
    text.finish();
    if (std::ostream* stream = report.json()) {
        write_table_json(*stream, table, surroundings);
    }
    report.commit();
}

}  // namespace nearfield::tools
