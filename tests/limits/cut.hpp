#pragma once

#include <nearfield/limits.hpp>

#include <atomic>
#include <cstdint>

namespace nearfield::test {

/// Limits that cancel a call at one of its checkpoints, and see how many there were.
class Cut {
public:
    /// `at`: the number of the checkpoint, from 1; 0: none.
    explicit Cut(std::uint64_t at) : at_(at) {
        limits_.cancel = &cancel_;
        limits_.user = this;
        limits_.progress = [](void* user, const Progress& progress) {
            auto& cut = *static_cast<Cut*>(user);
            cut.seen_.fetch_add(1);
            cut.done_ = progress.done;
            cut.count_ = progress.count;
            if (progress.checkpoint == cut.at_) {
                cut.cancel_ = true;
            }
        };
    }
    Cut(const Cut&) = delete;
    Cut& operator=(const Cut&) = delete;

    [[nodiscard]] const Limits& limits() const { return limits_; }
    [[nodiscard]] bool has_cut() const { return cancel_; }
    /// The number of checkpoints of the call.
    [[nodiscard]] std::uint64_t seen() const { return seen_; }
    /// Progress at the last checkpoint; of any of the last if there are several jobs.
    [[nodiscard]] std::uint64_t done() const { return done_; }
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    std::uint64_t at_;
    std::atomic<bool> cancel_ = false;
    std::atomic<std::uint64_t> seen_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> count_ = 0;
    Limits limits_;
};

/// Up to this checkpoint, most tests cut at every one.
inline constexpr std::uint64_t dense = 8;

/// Calls `cut_at(n)` for n = 1, 2, 3, ..., from `up_to` on in growing steps, until it returns
/// false: the call was over before its checkpoint n. Returns how often it was cut.
template <class CutAt>
std::uint64_t cut_everywhere(std::uint64_t up_to, const CutAt& cut_at) {
    std::uint64_t cuts = 0;
    for (std::uint64_t n = 1; cut_at(n); n += n < up_to ? 1 : n / 8 + 1) {
        ++cuts;
    }
    return cuts;
}

}  // namespace nearfield::test
