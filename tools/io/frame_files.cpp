#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tools/io/frame_files.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace nearfield::tools {

FrameFiles::FrameFiles(const std::string& pattern) {
    const auto refuse = [&pattern](const std::string& reason) {
        throw InputError("--image: \"" + pattern + "\": " + reason);
    };
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = numbered_ ? after_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
        } else if (i + 1 < pattern.size() && pattern[i + 1] == '%') {
            part += pattern[++i];
        } else {
            std::size_t end = i + 1;
            while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end]))) {
                ++end;
            }
            if (end == pattern.size() || pattern[end] != 'd' || end - i > 3) {
                refuse(
                    "after % stands d, or 0 and the number of digits and d; %% is a per cent sign");
            }
            if (numbered_) {
                refuse("has more than one frame number");
            }
            digits_ = end > i + 1 ? std::stoul(pattern.substr(i + 1, end - i - 1)) : 0;
            numbered_ = true;
            i = end;
        }
    }
    // Fails before the work begins if the file cannot be written; leaves nothing behind.
    const OutputFile first(path_of(0));
}

std::string FrameFiles::path_of(std::uint64_t frame) const {
    if (!numbered_) {
        return before_;
    }
    std::string number = std::to_string(frame);
    if (number.size() < digits_) {
        number.insert(0, digits_ - number.size(), '0');
    }
    return before_ + number + after_;
}

void FrameFiles::write(std::uint64_t frame, const std::string& bytes) const {
    OutputFile file(path_of(frame));
    file.stream() << bytes;
    file.commit();
}

namespace {

/// Starts ffmpeg with its standard input at the read end of a pipe. Returns 0 or an error number.
int start(const std::vector<std::string>& arguments, int input, pid_t& process) {
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) {
        pointers.push_back(const_cast<char*>(argument.c_str()));
    }
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    // In a process group of its own: Ctrl-C must not end it before the video is complete.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error =
        posix_spawnp(&process, pointers.front(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

}  // namespace

VideoFile::VideoFile(const std::string& path, std::uint32_t width, std::uint32_t height,
                     std::uint32_t rate)
    : path_(path) {
    // Fails before the work begins if the file cannot be written; leaves nothing behind.
    { const OutputFile check(path); }
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("--video: no pipe: " + std::string(std::strerror(errno)));
    }
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    const int error =
        start({"ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "bgra", "-s",
               size, "-r", std::to_string(rate), "-i", "-", "-pix_fmt", "yuv420p", "file:" + path},
              ends[0], process_);
    close(ends[0]);
    if (error != 0) {
        close(ends[1]);
        throw InputError(
            "--video: the program ffmpeg, which encodes videos, cannot be started (in Debian it is "
            "in the package ffmpeg): " +
            std::string(std::strerror(error)));
    }
    pipe_ = ends[1];
    // If ffmpeg ends early, writing must fail but not end this program.
    std::signal(SIGPIPE, SIG_IGN);
}

VideoFile::~VideoFile() {
    if (pipe_ >= 0) {
        close(pipe_);
        waitpid(process_, nullptr, 0);
    }
}

void VideoFile::add(std::span<const std::uint32_t> pixels) {
    const std::span<const std::byte> bytes = std::as_bytes(pixels);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t written = write(pipe_, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno != EINTR) {
            throw std::runtime_error(path_ +
                                     ": ffmpeg takes no more frames: " + std::strerror(errno));
        }
        done += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
}

void VideoFile::finish() {
    close(pipe_);
    pipe_ = -1;
    int status = 0;
    waitpid(process_, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(path_ + ": ffmpeg failed; what it said stands above");
    }
}

}  // namespace nearfield::tools
