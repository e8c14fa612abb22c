#include "program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace nearfield::test {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File make_capture() {
    File file(std::tmpfile(), &std::fclose);
    if (!file) {
        throw std::runtime_error("no temporary file for what the program prints");
    }
    return file;
}

std::string read_back(std::FILE* file) {
    std::rewind(file);
    std::string text;
    std::array<char, 4096> block{};
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file)) {
        text.append(block.data(), count);
    }
    return text;
}

/// In the child: executes the program. The alarm survives exec.
[[noreturn]] void become_program(std::vector<char*>& words, const Surroundings& surroundings,
                                 int out, int err) {
    constexpr int failed = 127;
    if (!surroundings.out.empty()) {
        out = open(surroundings.out.c_str(), O_WRONLY);
    }
    if (!surroundings.in.empty() &&
        dup2(open(surroundings.in.c_str(), O_RDONLY), STDIN_FILENO) < 0) {
        _exit(failed);
    }
    if (out < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) {
        _exit(failed);
    }
    for (const auto& [name, value] : surroundings.environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    alarm(60);
    execv(words.front(), words.data());
    _exit(failed);
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    std::vector<std::string> texts{NEARFIELD_PROGRAM};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& text : texts) {
        words.push_back(text.data());
    }
    words.push_back(nullptr);

    const File out = make_capture();
    const File err = make_capture();
    const pid_t child = fork();
    if (child == 0) {
        become_program(words, surroundings, fileno(out.get()), fileno(err.get()));
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const bool ended = child > 0 && WIFEXITED(status);
    return {ended ? WEXITSTATUS(status) : -1, read_back(out.get()), read_back(err.get())};
}

Surroundings without_driver() {
    return {{{"VK_DRIVER_FILES", "/nonexistent/driver.json"},
             {"VK_ICD_FILENAMES", "/nonexistent/driver.json"}},
            {}};
}

std::string command_line(const std::vector<std::string>& arguments) {
    std::string line = "nearfield";
    for (const std::string& argument : arguments) {
        const bool plain = !argument.empty() && argument.find(' ') == std::string::npos;
        line += plain ? " " + argument : " \"" + argument + "\"";
    }
    return line;
}

}  // namespace nearfield::test
