#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace nearfield::benchmark {

/// One of several ways to do the same work, and what it took so far.
struct Contender {
    /// Does the work once; returns its milliseconds.
    std::function<double()> frame;
    std::vector<double> frames_ms;
};

/// How long each contender of a row is measured.
struct Budget {
    /// Until its frames took this many milliseconds together ...
    double milliseconds = 250.0;
    /// ... or there are this many of them; but for
    std::size_t most_frames = 2000;
    /// this many there is always time.
    std::size_t fewest_frames = 2;
    /// A contender's turn, milliseconds: long enough for its memory to be in the caches again.
    double turn = 20.0;
};

/// Measures contenders turn by turn, to and fro, so that what else the machine does, and what one
/// leaves behind for the next, falls on all alike. Before, each does its work once, or more often
/// where that is quick, unmeasured.
void measure(std::span<Contender> contenders, const Budget& budget);

}  // namespace nearfield::benchmark
