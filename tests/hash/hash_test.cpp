#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tools/common/library.hpp>
#include <tools/hash/sections.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace nearfield::hash {
namespace {

/// Sections that take a second together: the start of some quick ones.
std::vector<std::uint64_t> sample(const MakeContext& make_context) {
    return {hash_pairs(make_context, 0, 150), hash_world(make_context)};
}

/// Selects an instruction set during its lifetime.
class OnlyTarget {
public:
    explicit OnlyTarget(std::int64_t target) { choose(target); }
    ~OnlyTarget() { choose(0); }
    OnlyTarget(const OnlyTarget&) = delete;
    OnlyTarget& operator=(const OnlyTarget&) = delete;

private:
    static void choose(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().DeInit();
    }
};

/// The last job first, each on a thread of its own.
void run_backwards(void* /*user*/, std::uint32_t jobs,
                   void (*job)(void* data, std::uint32_t number), void* data) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = jobs; i-- > 0;) {
        threads.emplace_back(job, data, i);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

TEST(Hash, IsTheCommittedOneForEverySection) {
    std::map<std::string, std::uint64_t> committed;
    std::ifstream file(NEARFIELD_HASHES);
    for (std::string name, digits; file >> name >> digits;) {
        committed[name] = std::stoull(digits, nullptr, 16);
    }
    EXPECT_EQ(committed.size(), sections().size());
    for (const Section& section : sections()) {
        EXPECT_EQ(section.hash(cpu_context), committed[section.name])
            << section.name << ": if answers are meant to change, `nearfield hash` prints the new "
            << "hashes for " << NEARFIELD_HASHES;
    }
}

/// The outlines are shapes of thousands of edges, which have trees of boxes.
TEST(Hash, IsTheSameOnEveryInstructionSet) {
    const auto outlines =
        std::find_if(sections().begin(), sections().end(),
                     [](const Section& one) { return std::string_view(one.name) == "outlines"; });
    ASSERT_NE(outlines, sections().end());
    const auto sample_and_outlines = [&] {
        std::vector<std::uint64_t> hashes = sample(cpu_context);
        hashes.push_back(outlines->hash(cpu_context));
        return hashes;
    };
    const std::vector<std::uint64_t> expected = sample_and_outlines();
    int count = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        const std::int64_t target = left & ~(left - 1);
        const OnlyTarget only(target);
        EXPECT_EQ(sample_and_outlines(), expected) << hwy::TargetName(target);
        ++count;
    }
    EXPECT_GT(count, 1);
}

TEST(Hash, IsTheSameForAnyNumberOfJobs) {
    const std::vector<std::uint64_t> expected = sample(cpu_context);
    for (const std::uint32_t jobs : {1U, 2U, 7U, max_jobs}) {
        const auto with_jobs = [jobs](Settings settings) {
            settings.jobs = {.count = jobs, .run = run_backwards};
            return cpu_context(settings);
        };
        EXPECT_EQ(sample(with_jobs), expected) << jobs << " jobs";
    }
}

TEST(Hash, IsTheSameWithADevice) {
    const auto on_device = [](Settings settings) {
        settings.pipelines_on_demand = true;
        return tools::take(Context::create_headless({}, settings));
    };
    EXPECT_EQ(sample(on_device), sample(cpu_context));
}

}  // namespace
}  // namespace nearfield::hash
