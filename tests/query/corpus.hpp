#pragma once

#include <tests/query/pair.hpp>

#include <filesystem>
#include <vector>

namespace nearfield::test {

/// A pair that some query once answered wrongly, and what a contact query asked with.
struct CorpusCase {
    std::string name;
    Pair pair;
    double contact_distance = 0.0;
};

/// Every case of a folder of JSON files. Throws std::runtime_error where one cannot be read.
[[nodiscard]] std::vector<CorpusCase> read_corpus(const std::filesystem::path& folder);

/// While it lives, watches whether an expectation fails; if so, the pair is written into the folder
/// that the environment variable NEARFIELD_CORPUS names, ready for tests/data/corpus.
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
