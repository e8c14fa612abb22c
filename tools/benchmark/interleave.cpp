#include <tools/benchmark/interleave.hpp>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

namespace nearfield::benchmark {
namespace {

double spent(const Contender& contender) {
    return std::accumulate(contender.frames_ms.begin(), contender.frames_ms.end(), 0.0);
}

bool has_enough(const Contender& contender, const Budget& budget) {
    const std::size_t frames = contender.frames_ms.size();
    return frames >= budget.fewest_frames &&
           (frames >= budget.max_frames || spent(contender) >= budget.milliseconds);
}

void warm_up(const Contender& contender, double milliseconds) {
    constexpr int max_frames = 10;
    double taken = 0.0;
    for (int frame = 0; frame < max_frames && taken <= milliseconds; ++frame) {
        taken += contender.frame();
    }
}

/// Runs one turn. Returns true if there is more to measure.
bool take_turn(Contender& contender, const Budget& budget) {
    if (has_enough(contender, budget)) {
        return false;
    }
    // Let the driver's threads go idle first. Schedulers favour threads that have slept (such as
    // one waiting for a device); after a pause they favour all contenders alike.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    double taken = 0.0;
    while (taken < budget.turn && contender.frames_ms.size() < budget.max_frames) {
        contender.frames_ms.push_back(contender.frame());
        taken += contender.frames_ms.back();
    }
    return !has_enough(contender, budget);
}

}  // namespace

void measure(std::span<Contender> contenders, const Budget& budget) {
    for (const Contender& contender : contenders) {
        warm_up(contender, budget.turn);
    }
    std::vector<Contender*> order;
    for (Contender& contender : contenders) {
        order.push_back(&contender);
    }
    for (bool more = true; more;) {
        more = false;
        for (Contender* const contender : order) {
            more = take_turn(*contender, budget) || more;
        }
        std::reverse(order.begin(), order.end());
    }
}

}  // namespace nearfield::benchmark
