#pragma once

#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {

/// What a run of the program came to.
struct Outcome {
    int status = -1;  ///< exit status; -1 where a signal ended it
    std::string out;
    std::string err;
};

/// What surrounds a run.
struct Surroundings {
    std::vector<std::pair<std::string, std::string>> environment;  ///< added to the test's own
    std::string out;  ///< where the standard output goes; empty: into the outcome
};

/// Runs the program to its end; a run that hangs is ended by a signal after a minute.
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments,
                                  const Surroundings& surroundings = {});

/// Surroundings in which no Vulkan driver is found.
[[nodiscard]] Surroundings without_driver();

/// The command line as a person would type it, for messages.
[[nodiscard]] std::string command_line(const std::vector<std::string>& arguments);

}  // namespace nearfield::test
