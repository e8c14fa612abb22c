#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace nearfield::tools {

/// A file to be written in one go: the text goes into a temporary file beside it, which takes its
/// name at commit(). Made before the work begins, so that a target that cannot be written is found
/// out first; without commit() nothing is left behind. What is not a regular file (a pipe, a
/// terminal, /dev/null) is written directly.
class OutputFile {
public:
    /// Throws InputError where the file cannot be written.
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    [[nodiscard]] std::ostream& stream() noexcept { return stream_; }

    /// Throws std::runtime_error where something could not be written (a full disk, say).
    void commit();

private:
    void open_temporary();

    std::string path_;                 ///< as given, for messages
    std::filesystem::path target_;     ///< with links resolved
    std::filesystem::path temporary_;  ///< empty where the target is written directly
    std::ofstream stream_;
};

}  // namespace nearfield::tools
