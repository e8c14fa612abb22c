#pragma once

#include <tests/support/folder.hpp>

#include <string>
#include <vector>

namespace nearfield::test {

/// What a run of an example came to.
struct ExampleOutcome {
    int status = -1;         ///< exit status; 124 where it was ended after a minute
    std::string messages;    ///< standard output and error
    std::string validation;  ///< what the validation layers said
    bool validated = false;  ///< they were there
};

/// Runs an example under validation and synchronisation validation. `environment` (NAME=VALUE) is
/// added to the test's own.
[[nodiscard]] ExampleOutcome run_example(const std::string& program,
                                         const std::vector<std::string>& arguments,
                                         const test_support::Folder& folder,
                                         const std::vector<std::string>& environment = {});

}  // namespace nearfield::test
