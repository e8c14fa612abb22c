#pragma once

#include <tests/support/folder.hpp>

#include <string>
#include <vector>

namespace nearfield::test {

/// The result of a run of an example.
struct ExampleOutcome {
    int status = -1;         ///< exit status; 124 if it was stopped after a minute
    std::string messages;    ///< standard output and error
    std::string validation;  ///< messages of the validation layers
    bool validated = false;  ///< whether the layers were active
};

/// Runs an example under validation and synchronisation validation. `environment` (NAME=VALUE) is
/// added to the test's own.
[[nodiscard]] ExampleOutcome run_example(const std::string& program,
                                         const std::vector<std::string>& arguments,
                                         const test_support::Folder& folder,
                                         const std::vector<std::string>& environment = {});

}  // namespace nearfield::test
