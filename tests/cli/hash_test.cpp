#include "program.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace nearfield::test {
namespace {

TEST(HashCommand, PrintsTheCommittedLinesWithoutADriver) {
    std::ifstream file(NEARFIELD_TEST_DATA "/hashes.txt");
    std::ostringstream committed;
    committed << file.rdbuf();
    const Outcome outcome = run_program({"hash", "--quick"}, without_driver());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(outcome.out.empty());
    EXPECT_EQ(outcome.out, committed.str().substr(0, outcome.out.size()));
}

}  // namespace
}  // namespace nearfield::test
