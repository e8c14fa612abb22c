#pragma once

#include <engine/world/device_pairs.hpp>
#include <engine/world/world_view.hpp>
#include <nearfield/world_pairs.hpp>

#include <cstdint>
#include <memory>

namespace nearfield {

/// What a table keeps from update to update, whoever answers. Its members throw.
struct PairTableBase::State {
    State(const AnyQuery& query, const PairTableOptions& options)
        : query(query), options(options) {}
    virtual ~State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    // As the public functions.
    void update(const WorldView& world, const PairTableInput& input);
    void submit(const WorldView& world, const PairTableInput& input);
    void record(const WorldView& world, const PairTableInput& input, const Recording& recording);
    void collect();
    [[nodiscard]] bool is_recorded(const WorldView& world) const;
    [[nodiscard]] bool is_ready() const;
    [[nodiscard]] PairsOnDevice on_device() const;
    [[nodiscard]] std::uint32_t size() const;
    [[nodiscard]] std::uint32_t candidates() const;
    [[nodiscard]] std::uint32_t left_to_cpu() const;

    const AnyQuery query;
    const PairTableOptions options;
    Timings timings;
    Status read_status;

protected:
    /// Answers all pairs, or those of a list by any technique. `call`: for messages.
    virtual void answer(const char* call, const WorldView& world, const PairTableInput& input) = 0;
    /// Forgets what answer() keeps.
    virtual void forget_answers() = 0;
    /// Forgets the rows of the device that were made exact.
    virtual void forget_exact_rows() = 0;

    std::unique_ptr<DevicePairs> device_;  // that finds the pairs; null: answer() does
    Technique technique_{};                // of the last update
    // By answer(), at the last update.
    std::uint32_t row_count_ = 0;
    std::uint32_t candidate_count_ = 0;
    std::uint32_t answer_count_ = 0;

private:
    void start_anew();
    /// Throws what the action throws, after which the table is empty.
    template <class Action>
    void run_or_start_anew(Context::Implementation& context, const Action& action);
    void require_collected(const char* call) const;
    /// Checks what does not depend on the kind of the query, and chooses who answers.
    void choose(const char* call, const WorldView& world, const PairTableInput& input,
                bool is_recorded);
    /// The first half of an update, or of one that is recorded.
    void begin(const char* call, const WorldView& world, const PairTableInput& input,
               const Recording* recording);
    void finish();

    Context::Implementation* context_ = nullptr;  // of the last submission
    bool is_submitted_ = false;                   // to answer(), and not collected
};

}  // namespace nearfield
