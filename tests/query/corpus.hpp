#pragma once

#include <tests/query/pair.hpp>

#include <filesystem>
#include <vector>

namespace nearfield::test {

/// A pair for which a query once gave a wrong answer, with the contact query's distance.
struct CorpusCase {
    std::string name;
    Pair pair;
    double contact_distance = 0.0;
};

/// Reads every case in a folder of JSON files. Throws std::runtime_error if one cannot be read.
[[nodiscard]] std::vector<CorpusCase> read_corpus(const std::filesystem::path& folder);

/// During its lifetime, watches for failed expectations. If one fails, it writes the pair into the
/// folder named by the environment variable NEARFIELD_CORPUS, ready for tests/data/corpus.
class CorpusKeeper {
public:
    CorpusKeeper(const Pair& pair, double contact_distance);
    ~CorpusKeeper();
    CorpusKeeper(const CorpusKeeper&) = delete;
    CorpusKeeper& operator=(const CorpusKeeper&) = delete;

private:
    const Pair& pair_;
    double contact_distance_;
    int failures_before_;
};

}  // namespace nearfield::test
