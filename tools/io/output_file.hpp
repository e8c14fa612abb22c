#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <span>
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

/// Pictures of frames, each in a file named after a pattern: `%d`, or `%04d` with a number of
/// digits, stands for the frame's number, `%%` for a per cent sign. Without a number, every frame
/// overwrites the previous one.
class FrameFiles {
public:
    /// Throws InputError if the pattern is invalid or its files cannot be written.
    explicit FrameFiles(const std::string& pattern);

    /// Writes the contents of a frame's file. Throws std::runtime_error on failure.
    void write(std::uint64_t frame, const std::string& bytes) const;

    [[nodiscard]] std::string path_of(std::uint64_t frame) const;

private:
    std::string before_;
    std::string after_;
    bool numbered_ = false;
    std::size_t digits_ = 0;
};

/// A video that the program ffmpeg encodes as frames are added. The file's extension determines the
/// container.
class VideoFile {
public:
    /// Throws InputError if ffmpeg is not installed or the file cannot be written. `rate`: frames
    /// per second. Width and height must be even.
    VideoFile(const std::string& path, std::uint32_t width, std::uint32_t height,
              std::uint32_t rate);
    /// Without finish(), the file is left incomplete.
    ~VideoFile();
    VideoFile(const VideoFile&) = delete;
    VideoFile& operator=(const VideoFile&) = delete;

    /// 0xAARRGGBB, row by row from the top. Throws std::runtime_error.
    void add(std::span<const std::uint32_t> pixels);
    /// Waits for ffmpeg. Throws std::runtime_error if it failed.
    void finish();

private:
    std::string path_;
    pid_t process_ = -1;
    int pipe_ = -1;
};

}  // namespace nearfield::tools
