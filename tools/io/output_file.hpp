#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A file that is replaced as a whole: the text goes into a temporary file beside it, which
/// commit() renames. Construct it before the work begins, so that an unwritable target is reported
/// first. Without commit() nothing is left behind. Targets other than regular files (a pipe, a
/// terminal, /dev/null) are written directly.
class OutputFile {
public:
    /// Throws InputError if the file cannot be written.
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    [[nodiscard]] std::ostream& stream() noexcept { return stream_; }

    /// Throws std::runtime_error if writing failed (a full disk, for example).
    void commit();

private:
    void open_temporary();

    std::string path_;                 ///< as given, for messages
    std::filesystem::path target_;     ///< with links resolved
    std::filesystem::path temporary_;  ///< empty if the target is written directly
    std::ofstream stream_;
};

/// An output must not overwrite an input or another output; throws InputError. Pipes and terminals
/// may be shared.
void require_different_files(const std::vector<std::string>& inputs,
                             const std::vector<std::string>& outputs);

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
