#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/base/status_exception.hpp>

#include <string>
#include <utility>

namespace nearfield {

void Jobs::run_all(std::uint32_t jobs, FunctionRef<void(std::uint32_t)> work) {
    struct Call {
        Jobs& all;
        FunctionRef<void(std::uint32_t)> work;
        Interruption* interruption;
    } call{*this, work, current_interruption};
    for (std::uint32_t i = 0; i < jobs; ++i) {
        outcomes_[i] = {};
    }
    const auto run_one = [](void* data, std::uint32_t job) {
        const Call& of = *static_cast<Call*>(data);
        Outcome& outcome = of.all.outcomes_[job];
        const InterruptionScope scope(of.interruption);
        try {
            of.work(job);
        } catch (...) {
            outcome.failure = std::current_exception();
        }
        outcome.done = true;
    };
    system_.run(system_.user, jobs, run_one, &call);
    for (std::uint32_t i = 0; i < jobs; ++i) {
        if (!outcomes_[i].done) {
            throw StatusException({StatusCode::invalid_settings,
                                   "Settings::jobs: run returned and job " + std::to_string(i) +
                                       " of " + std::to_string(jobs) + " was not done"});
        }
    }
    std::exception_ptr failure;
    for (std::uint32_t i = 0; i < jobs; ++i) {
        const std::exception_ptr own = std::exchange(outcomes_[i].failure, nullptr);
        failure = failure ? failure : own;
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

}  // namespace nearfield
