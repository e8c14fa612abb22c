#pragma once

#include <engine/world/device_pairs.hpp>
#include <engine/world/world_view.hpp>
#include <nearfield/world_pairs.hpp>

#include <cstdint>
#include <memory>

namespace nearfield {

/// What a table keeps from update to update, whoever answers. Its members throw.
struct PairTableBase::State {
    State(const AnyQuery& asked, const PairTableOptions& how) : query(asked), options(how) {}
    virtual ~State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// The first half of an update, or of one that is recorded. `call`: for messages, as below.
    void start(const char* call, const WorldView& world, const PairTableInput& input,
               const Recording* recording);
    void finish();
    void collect();
    /// What the device counts if it finds the pairs, and what answer() did otherwise.
    [[nodiscard]] std::uint32_t count(std::uint32_t (DevicePairs::*of_device)() const,
                                      std::uint32_t of_answer) const {
        return device != nullptr ? ((*device).*of_device)() : is_submitted ? 0 : of_answer;
    }
    [[nodiscard]] std::uint32_t size() const { return count(&DevicePairs::size, row_count); }

    const AnyQuery query;
    const PairTableOptions options;
    Timings timings;
    Status read_status;

    std::unique_ptr<DevicePairs> device;  // that finds the pairs; null: answer() does
    bool is_submitted = false;            // to answer(), and not collected
    // By answer(), at the last update.
    std::uint32_t row_count = 0;
    std::uint32_t candidate_count = 0;
    std::uint32_t answer_count = 0;

protected:
    /// Answers all pairs, or those of a list by any technique.
    virtual void answer(const char* call, const WorldView& world, const PairTableInput& input) = 0;
    /// Forgets what answer() keeps.
    virtual void forget_answers() = 0;
    /// Forgets the rows of the device that were made exact.
    virtual void forget_exact_rows() = 0;

    Technique technique_{};  // of the last update

private:
    void start_anew();
    /// Throws what the action throws, after which the table is empty.
    template <class Action>
    void run_or_start_anew(const Action& action);
    void require_collected(const char* call) const;
    /// Checks what does not depend on the kind of the query, and chooses who answers.
    void choose(const char* call, const WorldView& world, const PairTableInput& input,
                bool is_recorded);
    void begin(const char* call, const WorldView& world, const PairTableInput& input,
               const Recording* recording);

    std::shared_ptr<Context::Implementation> context_;  // of the last submission
};

}  // namespace nearfield
