#pragma once

#include <cstdint>
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

}  // namespace nearfield::tools
