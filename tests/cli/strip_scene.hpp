#pragma once

#include "cli_test.hpp"

#include <string>

namespace nearfield::test {

/// Scenes with the shapes, instances and groups of tests/data/scenes/strip.json: squares of side 1
/// in a bin whose inside is [0, 10] x [0, 4].
class StripScene : public CliTest {
protected:
    [[nodiscard]] static std::string strip_file();
    [[nodiscard]] static Json strip();

    /// Writes a scene with other queries, separated by commas.
    [[nodiscard]] std::string scene(const std::string& queries) const;

    [[nodiscard]] Json results_of(const std::string& queries) const;

    /// The records of the only query.
    [[nodiscard]] Json records_of(const std::string& query) const;
};

}  // namespace nearfield::test
