#pragma once

#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {

/// The result of a run of the program.
struct Outcome {
    int status = -1;  ///< exit status; -1 if a signal ended it
    std::string out;
    std::string err;
};

/// The environment of a run.
struct Surroundings {
    std::vector<std::pair<std::string, std::string>> environment;  ///< added to the test's own
    std::string out;      ///< where the standard output goes; empty: into the outcome
    std::string in = {};  ///< the file that is the standard input; empty: the test's own
};

/// Runs the program to its end; a signal ends a run that takes longer than a minute.
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments,
                                  const Surroundings& surroundings = {});

/// An environment without a Vulkan driver.
[[nodiscard]] Surroundings without_driver();

/// The command line as typed, for messages.
[[nodiscard]] std::string command_line(const std::vector<std::string>& arguments);

}  // namespace nearfield::test
