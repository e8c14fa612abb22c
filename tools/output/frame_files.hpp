#pragma once

#include <cstdint>
#include <string>

namespace nearfield::tools {

/// Pictures of frames, each in a file named after a pattern: `%d` in it, or `%04d` with the number
/// of digits, is the frame's number, `%%` a per cent sign. Without a number every frame takes the
/// place of the one before.
class FrameFiles {
public:
    /// Throws InputError where the pattern is none or its files cannot be written.
    explicit FrameFiles(const std::string& pattern);

    /// Writes the bytes of a frame's file. Throws std::runtime_error where that fails.
    void write(std::uint64_t frame, const std::string& bytes) const;

    [[nodiscard]] std::string path_of(std::uint64_t frame) const;

private:
    std::string before_;
    std::string after_;
    bool numbered_ = false;
    std::size_t digits_ = 0;
};

}  // namespace nearfield::tools
