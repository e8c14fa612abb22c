#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace nearfield::tools {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw InputError(path + ": cannot be written: " + reason);
}

/// The permissions of a new file according to the user's umask.
mode_t default_mode() {
    const mode_t mask = umask(0);
    umask(mask);
    return static_cast<mode_t>(0666) & ~mask;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
    std::error_code error;
    target_ = std::filesystem::weakly_canonical(path, error);
    if (error || path.empty()) {
        refuse(path, path.empty() ? "an empty name" : error.message());
    }
    const std::filesystem::file_status status = std::filesystem::status(target_, error);
    if (std::filesystem::is_directory(status)) {
        refuse(path, "is a folder");
    }
    if (std::filesystem::exists(status)) {
        if (access(target_.c_str(), W_OK) != 0) {
            refuse(path, std::strerror(errno));
        }
        if (!std::filesystem::is_regular_file(status)) {
            stream_.open(target_, std::ios::binary);
            if (!stream_) {
                refuse(path, "cannot be opened");
            }
            return;
        }
    }
    open_temporary();
}

void OutputFile::open_temporary() {
    std::string name = target_.string() + ".XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) {
        refuse(path_, std::strerror(errno));
    }
    temporary_ = name;
    fchmod(descriptor, default_mode());
    close(descriptor);
    stream_.open(temporary_, std::ios::binary);
    if (!stream_) {
        refuse(path_, "the temporary file beside it cannot be opened");
    }
}

OutputFile::~OutputFile() {
    if (!temporary_.empty()) {
        stream_.close();
        std::error_code ignored;
        std::filesystem::remove(temporary_, ignored);
    }
}

void OutputFile::commit() {
    stream_.close();
    if (!stream_) {
        throw std::runtime_error(path_ + ": could not be written completely");
    }
    if (temporary_.empty()) {
        return;
    }
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) {
        throw std::runtime_error(path_ + ": could not be written: " + error.message());
    }
    temporary_.clear();
}

namespace {

/// The same for all names of a file, which need not be there yet.
std::filesystem::path only_name(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, ignored), ignored);
}

}  // namespace

void require_different_files(const std::vector<std::string>& inputs,
                             const std::vector<std::string>& outputs) {
    std::vector<std::filesystem::path> taken;
    taken.reserve(inputs.size() + outputs.size());
    std::error_code ignored;
    for (const std::string& input : inputs) {
        taken.push_back(only_name(input));
    }
    for (const std::string& output : outputs) {
        const std::filesystem::path path = only_name(output);
        if (std::filesystem::exists(path, ignored) &&
            !std::filesystem::is_regular_file(path, ignored)) {
            continue;
        }
        if (std::find(taken.begin(), taken.end(), path) != taken.end()) {
            throw InputError(output + ": would be written over an input or another output");
        }
        taken.push_back(path);
    }
}

ReportTarget::ReportTarget(const std::optional<std::string>& json) : standard_output_(json == "-") {
    if (json && !standard_output_) {
        file_.emplace(*json);
    }
}

std::ostream* ReportTarget::json() noexcept {
    if (standard_output_) {
        return &std::cout;
    }
    return file_ ? &file_->stream() : nullptr;
}

std::ostream& ReportTarget::summary() noexcept {
    return standard_output_ ? std::cerr : std::cout;
}

void ReportTarget::commit() {
    if (file_) {
        file_->commit();
    }
}

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
