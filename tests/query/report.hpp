#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace nearfield::test {

/// Collects the violations of one result, so that ten thousand wrong records give one failure with
/// the first few in detail.
class Report {
public:
    explicit Report(std::string about) : about_(std::move(about)) { text_.precision(17); }
    ~Report() {
        if (count_ > 0) {
            ADD_FAILURE() << about_ << ": " << count_ << " violations\n" << text_.str();
        }
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;

    /// Records a violation if `holds` is false; `details` are written one after another.
    template <class... Details>
    void require(bool holds, const Details&... details) {
        constexpr int max_written = 5;
        if (!holds && ++count_ <= max_written) {
            text_ << "  ";
            (text_ << ... << details) << '\n';
        }
    }

    [[nodiscard]] bool clean() const { return count_ == 0; }

private:
    std::string about_;
    std::ostringstream text_;
    int count_ = 0;
};

}  // namespace nearfield::test
