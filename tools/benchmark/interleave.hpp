#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace nearfield::benchmark {

/// One of several ways to do the same work, with its measurements so far.
struct Contender {
    /// Does the work once; returns the time in milliseconds.
    std::function<double()> frame;
    std::vector<double> frames_ms;
};

/// How long each contender in a row is measured.
struct Budget {
    /// A contender is done when its frames add up to this many milliseconds ...
    double milliseconds = 250.0;
    /// ... or when it has run this many frames,
    std::size_t max_frames = 2000;
    /// but it always runs at least this many.
    std::size_t fewest_frames = 2;
    /// Length of a turn in milliseconds: long enough to warm the caches.
    double turn = 20.0;
};

/// Measures the contenders in alternating turns, so that other load on the machine and side effects
/// of one contender affect all of them equally. Each contender first does its work once unmeasured,
/// or several times if that is quick.
void measure(std::span<Contender> contenders, const Budget& budget);

}  // namespace nearfield::benchmark
