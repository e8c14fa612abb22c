#pragma once

#include <tools/io/output_file.hpp>

#include <optional>
#include <ostream>
#include <string>

namespace nearfield::tools {

/// The destination of a command's results: JSON in a file with a summary on standard output, or
/// JSON alone on standard output ("-") with the summary on standard error.
class ReportTarget {
public:
    /// `json` is a path or "-". Throws InputError if it cannot be written.
    explicit ReportTarget(const std::optional<std::string>& json);

    [[nodiscard]] std::ostream* json() noexcept;  ///< null if no JSON is requested
    [[nodiscard]] std::ostream& summary() noexcept;

    /// Throws std::runtime_error if writing failed.
    void commit();

private:
    bool standard_output_ = false;
    std::optional<OutputFile> file_;
};

}  // namespace nearfield::tools
