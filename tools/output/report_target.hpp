#pragma once

#include <tools/output/output_file.hpp>

#include <optional>
#include <ostream>
#include <string>

namespace nearfield::tools {

/// Where a command writes what it found: JSON into a file, or alone on the standard output ("-"),
/// and a summary for people on the standard output, or beside JSON on the standard error.
class ReportTarget {
public:
    /// `json` is a path or "-". Throws InputError where it cannot be written.
    explicit ReportTarget(const std::optional<std::string>& json);

    [[nodiscard]] std::ostream* json() noexcept;  ///< null where no JSON is wanted
    [[nodiscard]] std::ostream& summary() noexcept;

    /// Throws std::runtime_error where something could not be written.
    void commit();

private:
    bool standard_output_ = false;
    std::optional<OutputFile> file_;
};

}  // namespace nearfield::tools
