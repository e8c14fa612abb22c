#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>

namespace nearfield::tools {

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
