#include <engine/base/status_exception.hpp>
#include <engine/reload/compiler.hpp>

#include <fcntl.h>
#include <shaders/sources.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace nearfield::reload {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, int error) {
    throw StatusException({StatusCode::unavailable,
                           "shaders cannot be reloaded: " + what + ": " + std::strerror(error)});
}

/// A folder for the compiler's output, removed on destruction.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "nearfield-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            fail("no folder '" + name + "' for what the compiler writes", errno);
        }
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// A pipe through which a child process's output is read.
class Pipe {
public:
    Pipe() {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
            fail("no pipe", errno);
        }
    }
    ~Pipe() {
        close(ends_[0]);
        close_writer();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    [[nodiscard]] int writer() const { return ends_[1]; }
    void close_writer() {
        if (ends_[1] >= 0) {
            close(ends_[1]);
            ends_[1] = -1;
        }
    }
    /// Reads until the writer closes its end.
    [[nodiscard]] std::string read_all() const {
        std::string text;
        std::array<char, 4096> part{};
        for (;;) {
            const ssize_t count = read(ends_[0], part.data(), part.size());
            if (count > 0) {
                text.append(part.data(), static_cast<std::size_t>(count));
            } else if (count == 0 || errno != EINTR) {
                return text;
            }
        }
    }

private:
    std::array<int, 2> ends_{-1, -1};
};

/// Runs a program to its end; returns whether it succeeded, and its messages in `output`.
bool run(std::vector<std::string> words, std::string& output) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    Pipe pipe;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe.writer(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe.writer(), STDERR_FILENO);
    pid_t process = 0;
    const int error =
        posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        fail("the compiler '" + words.front() + "' cannot be started", error);
    }
    pipe.close_writer();
    output = pipe.read_all();
    int status = 0;
    while (waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) {
            fail("the compiler '" + words.front() + "' cannot be waited for", errno);
        }
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty()) {
            lines.push_back(line);
        }
    }
    return lines;
}

std::vector<std::uint32_t> words_of(const fs::path& file) {
    std::vector<std::uint32_t> words(fs::file_size(file) / sizeof(std::uint32_t));
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(words.data()),
                static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
    return words;
}

}  // namespace

Compilation compile(const fs::path& folder, const std::string& file) {
    const ScratchFolder scratch;
    const fs::path written = scratch.path() / "shader.spv";
    Compilation result;
    std::string said;
    const bool compiled = run({shaders::compiler, "--quiet", "--target-env", "vulkan1.1",
                               "-I" + folder.string(), std::string("-I") + shaders::include_folder,
                               "-o", written.string(), (folder / file).string()},
                              said);
    if (compiled) {
        result.words = words_of(written);
    }
    result.complaints = lines_of(said);
    return result;
}

}  // namespace nearfield::reload
