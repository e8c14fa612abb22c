#pragma once

#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/device_instances.hpp>
#include <engine/context/implementation.hpp>
#include <engine/context/placed_instances.hpp>
#include <engine/plan/world_question.hpp>
#include <engine/render/world_query_buffers.hpp>
#include <engine/world/instances.hpp>
#include <nearfield/world_device_queries.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// What questions of all kinds keep from one submission to the next. Its members throw.
struct NEARFIELD_HIDDEN DeviceQueryBase::State {
    using ContextOnDevice = Context::Implementation;

    explicit State(plan::WorldQuestion question);
    virtual ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    [[nodiscard]] bool is_ready() const;

    std::uint32_t count = 0;
    std::uint32_t left_to_cpu = 0;
    Timings timings;

protected:
    /// Lets the device answer questions about a world as it is. `push`: what depends on their kind;
    /// `take_down(push)` keeps the questions until they are collected; `write(i, memory)` writes
    /// question i to its place in the device's memory, for which many jobs call it.
    template <class TakeDown, class Write>
    void submit(const char* call, Context::Implementation& with, const WorldOnDevice& world,
                const WorldFilter& filter, std::size_t questions, plan::WorldQueryPush push,
                const TakeDown& take_down, const Write& write) {
        require_collected(call);
        run_or_forget(with, [&] {
            const Stopwatch total;
            start(call, with, world, filter, questions);
            if (instances_.size() > 0 && count > 0) {
                std::byte* const memory = buffers_->reserve(count, context_->memory_limit());
                take_down(push);
                jobs().divide(count, questions_of_part,
                              [&](std::uint32_t /*job*/, std::size_t first, std::size_t end) {
                                  for (std::size_t i = first; i < end; ++i) {
                                      write(i, memory);
                                  }
                              });
                begin(total, push);
            }
            set_submitted(true);
            timings.total = total.milliseconds() - making_pipelines_;
        });
    }
    /// Waits for the answers of the device. `decide(i, answer)` answers question i from that,
    /// unless it returns false; null: nobody was asked. `answer_by_cpu(numbers)` answers the
    /// others. Many jobs decide at the same time. What was submitted is collected then, even if
    /// this fails.
    template <class Answer, class Decide, class AnswerByCpu>
    void collect(const Decide& decide, const AnswerByCpu& answer_by_cpu) {
        run_or_forget(*context_, [&] {
            const Stopwatch total;
            wait();
            const Stopwatch decoding;
            const std::byte* const answers =
                instances_.size() > 0 && count > 0 ? buffers_->answers() : nullptr;
            expect_answers(count);
            clear_left();
            jobs().divide(
                count, questions_of_part,
                [&](std::uint32_t job, std::size_t first, std::size_t end) {
                    checkpoint();
                    constexpr std::size_t ahead = 8;
                    for (std::size_t i = first; i < end; ++i) {
                        Answer answer;
                        if (answers != nullptr) {
                            prefetch(answers + std::min(i + ahead, end - 1) * sizeof(answer));
                            std::memcpy(&answer, answers + i * sizeof(answer), sizeof(answer));
                        }
                        if (!decide(i, answers != nullptr ? &answer : nullptr)) {
                            left_of_jobs_[job].push_back(static_cast<std::uint32_t>(i));
                        }
                    }
                    finish_answers(end - first);
                });
            gather_left();
            if (!left_.empty()) {
                answer_by_cpu(std::span<const std::uint32_t>(left_));
            }
            timings.decode = decoding.milliseconds();
            timings.total += total.milliseconds();
            set_submitted(false);
        });
    }
    /// Prefetches the instance that an answer begins with, if it names one.
    void prefetch(const std::byte* answer) const {
        std::uint32_t number = 0;
        std::memcpy(&number, answer, sizeof(number));
        number &= ~plan::point_in_instance;
        if (number < instances_.size()) {
            placed_.prefetch(number);
        }
    }
    /// Throws (not_ready) unless something was submitted. `call`: for the message.
    void require_submitted(const char* call) const;

    [[nodiscard]] const DeviceInstances& instances() const { return instances_; }
    /// A shape that questions are about, on the device too.
    const DeviceInstances::ShapeOfInstances& add_shape(ShapeHandle shape) {
        return instances_.add_shape(context_->shapes(), shape);
    }
    /// The instance of an edge; null if there is no such edge: a device that fails may leave
    /// anything.
    [[nodiscard]] const PlacedInstance* find_placed(std::uint32_t number,
                                                    std::uint32_t edge) const {
        if (number >= instances_.size()) {
            return nullptr;
        }
        const PlacedInstance& placed = placed_.at(number, instances_);
        return edge < placed.polygon.polygon().size() ? &placed : nullptr;
    }
    /// The instances as they were submitted, for the CPU's own queries. The index of an instance is
    /// its number.
    [[nodiscard]] const world::Instances& instances_for_cpu();
    /// The filter that was submitted, among these.
    [[nodiscard]] WorldFilter filter_for_cpu() const;
    /// The handle, in the world, of an instance among these.
    [[nodiscard]] InstanceHandle handle_of(InstanceHandle instance) const {
        return instance == InstanceHandle{} ? instance : instances_[instance.index].handle;
    }
    [[nodiscard]] Jobs& jobs() { return *jobs_; }
    /// The number of questions that a job takes at a time.
    static constexpr std::size_t questions_of_part = 1024;

private:
    template <class Action>
    void run_or_forget(Context::Implementation& context, const Action& action) {
        const Status status = context.unless_lost(action);
        if (!status.ok()) {
            forget();
            throw StatusException(status);
        }
    }
    void require_collected(const char* call) const;
    void check(const char* call) const;
    void start(const char* call, Context::Implementation& with, const WorldOnDevice& world,
               const WorldFilter& filter, std::size_t questions);
    void begin(const Stopwatch& total, plan::WorldQueryPush& push);
    void wait();
    void clear_left();
    void gather_left();
    void forget();
    void set_submitted(bool is_submitted);

    const plan::WorldQuestion question_;
    // Boxes and places are those of an intersection test, which has no tolerance either.
    const AnyQuery query_;
    const plan::PairQuestion pair_question_;
    Context::Implementation* context_ = nullptr;
    std::weak_ptr<const void> world_;
    std::unique_ptr<render::WorldQueryBuffers> buffers_;
    std::uint32_t renderer_ = 0;     // number of that of the last submission
    double making_pipelines_ = 0.0;  // milliseconds of that submission
    DeviceInstances instances_{query_, pair_question_};
    PlacedInstances placed_;
    std::optional<world::Instances> for_cpu_;  // brought up to date when they are needed
    std::vector<std::uint64_t> moves_for_cpu_;
    WorldFilter filter_;
    std::uint32_t ignored_ = plan::no_instance;
    std::optional<Jobs> jobs_;
    // Numbers of the questions that the CPU answers: those that each job has left, and all.
    std::vector<std::vector<std::uint32_t>> left_of_jobs_;
    std::vector<std::uint32_t> left_;
    bool is_submitted_ = false;
};

}  // namespace nearfield
