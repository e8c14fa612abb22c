#include "example_program.hpp"

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace nearfield::test {
namespace {

std::string quoted(const std::string& word) {
    return "'" + word + "'";  // none of our words contains a quote
}

std::string read_all(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

}  // namespace

ExampleOutcome run_example(const std::string& program, const std::vector<std::string>& arguments,
                           const test_support::Folder& folder,
                           const std::vector<std::string>& environment) {
    const std::filesystem::path settings = folder.path() / "vk_layer_settings.txt";
    const std::filesystem::path log = folder.path() / "validation.log";
    const std::filesystem::path messages = folder.path() / "messages.txt";
    std::filesystem::remove(log);
    std::ofstream(settings) << "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
                            << "khronos_validation.report_flags = error,warn,perf\n"
                            << "khronos_validation.log_filename = " << log.string() << "\n"
                            << "khronos_validation.enables = "
                               "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT\n";

    std::string line = "env VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation";
    line += " VK_LAYER_SETTINGS_PATH=" + quoted(settings.string());
    line += " XDG_RUNTIME_DIR=" + quoted(folder.path().string());
    for (const std::string& variable : environment) {
        line += " " + quoted(variable);
    }
    line += " timeout 60 " + quoted(program);
    for (const std::string& argument : arguments) {
        line += " " + quoted(argument);
    }
    line += " >" + quoted(messages.string()) + " 2>&1";
    const int status = std::system(line.c_str());  // all words of the line are the test's own

    ExampleOutcome outcome;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.messages = read_all(messages);
    outcome.validation = read_all(log);
    outcome.validated = std::filesystem::exists(log);
    return outcome;
}

}  // namespace nearfield::test
