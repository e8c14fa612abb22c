#pragma once

#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/batch/call_within.hpp>
#include <engine/batch/context_implementation.hpp>
#include <engine/device_input/world_question.hpp>
#include <engine/render/world_query_buffers.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/device_instances.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/placed_instances.hpp>
#include <engine/world/world_state.hpp>
#include <nearfield/world_request.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield {

/// What requests of all kinds keep from one submission to the next: the instances as the device was
/// told of them, its memory, and what the CPU answers by itself. Its members throw.
struct WorldRequest::State {
    explicit State(device_input::WorldQuestion kind);
    virtual ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    [[nodiscard]] bool is_ready() const;
    /// Throws (not_ready) if something was submitted and not collected. `call`: for the message.
    void require_collected(const char* call) const;
    /// Throws (not_ready) unless something was submitted.
    void require_submitted(const char* call) const {
        if (!is_pending_on_device_ && !is_answered_) {
            refuse_uncollected(call);
        }
    }
    [[noreturn]] static void refuse_uncollected(const char* call);
    /// Whether Technique::automatic asks the device so many questions.
    [[nodiscard]] static bool pays_on_device(const World::State& world, std::size_t questions);

    // What kinds of questions look at while the device is asked, and while its answers are decided.

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

    const device_input::WorldQuestion question;
    std::uint32_t count = 0;
    std::uint32_t left_to_cpu = 0;
    Timings timings;

protected:
    /// Throws what the action throws, after which nothing is submitted.
    template <class Action>
    void run_or_forget(Context::Implementation& with, const Action& action) {
        const Status status = with.unless_lost(action);
        if (!status.ok()) {
            forget();
            throw StatusException(status);
        }
    }
    /// What was submitted is lost, and all that is known of the world.
    void forget();
    /// Tells the device of the instances, and begins to count the time.
    void start(const char* call, const WorldView& world, const WorldFilter& filter,
               std::size_t questions);
    /// Whether there is anything to ask the device.
    [[nodiscard]] bool is_asked() const { return instances_.size() > 0 && count > 0; }
    /// Lets the device begin. `push`: what depends on the kind of questions.
    void begin(const Stopwatch& total, shaders::WorldQueryPush& push);
    /// Prefetches the instance that an answer begins with, if it names one.
    void prefetch(const std::byte* answer) const {
        std::uint32_t number = 0;
        std::memcpy(&number, answer, sizeof(number));
        number &= ~shaders::point_in_instance;
        if (number < instances_.size()) {
            placed_.prefetch(number);
        }
    }
    void clear_left();
    void gather_left();
    /// The instances as they were submitted, for the CPU's own queries. The index of an instance is
    /// its number.
    [[nodiscard]] const world::Instances& instances_for_cpu();
    /// The filter that was submitted, among these.
    [[nodiscard]] WorldFilter filter_for_cpu() const;
    void set_pending_on_device(bool is_pending);
    static void require_countable(const char* call, std::size_t questions);

    /// The number of questions that a job takes at a time.
    static constexpr std::size_t questions_of_part = 1024;

    std::shared_ptr<Context::Implementation> context_;
    std::unique_ptr<render::WorldQueryBuffers> buffers_;
    std::optional<Jobs> jobs_;
    double making_pipelines_ = 0.0;  // milliseconds of the last submission
    // Numbers of the questions that the CPU answers: those that each job has left, and all.
    std::vector<std::vector<std::uint32_t>> left_of_jobs_;
    std::vector<std::uint32_t> left_;
    bool is_pending_on_device_ = false;
    bool is_answered_ = false;  // by the CPU, and not collected

private:
    // Boxes and places are those of an intersection test, which has no tolerance either.
    const AnyQuery query_;
    const device_input::PairQuestion pair_question_;
    std::weak_ptr<const void> world_;
    std::uint32_t renderer_ = 0;  // number of that of the last submission
    DeviceInstances instances_{query_, pair_question_};
    PlacedInstances placed_;
    std::optional<world::Instances> for_cpu_;  // brought up to date when they are needed
    std::vector<std::uint64_t> moves_for_cpu_;
    WorldFilter filter_;
    std::uint32_t ignored_ = shaders::no_instance;
};

/// A request about questions of one kind. What a `Kind` is, by the example of segments:
///
///     static constexpr device_input::WorldQuestion question;  // on the device
///     static constexpr const char* call;              // for messages
///     using Input, Answer;                            // of the public call
///     using Data, Found;                              // of one question and answer, on the device
///     using Solver;                                   // of a job of the CPU
///     void require_room(call, inputs, answers);       // checks their numbers
///     std::uint32_t answers_each();                   // to an input; the device gives one
///     void require(world, inputs);                    // checks what the call is given
///     void answer(world, inputs, answers, filter);    // the CPU answers all
///     void take_down(state, push);                    // prepares what questions have in common
///     Data data_of(state, input);                     // a question to the device
///     bool decide(state, input, found, answer);       // false: the CPU has to
///     void answer_some(solver, instances, filter, inputs, numbers, answers);
template <class Kind>
struct WorldRequest::Of final : State {
    using Input = typename Kind::Input;
    using Answer = typename Kind::Answer;

    Of() : State(Kind::question) {}

    /// That of a request, which is made if it has none of this kind.
    [[nodiscard]] static Of& of(WorldRequest& request) {
        if (request.state_ == nullptr || request.state_->question != Kind::question) {
            if (request.state_ != nullptr) {
                request.state_->require_collected(Kind::call);
            }
            request.state_ = std::make_unique<Of>();
        }
        return static_cast<Of&>(*request.state_);
    }

    /// A call that answers at once. `kept`: for the device.
    static Status answer(World::State& world, WorldRequest& kept, const Kind& kind,
                         std::span<const Input> inputs, std::span<Answer> answers,
                         const WorldOptions& options) {
        return catch_within(options.limits, [&] {
            kind.require_room(Kind::call, inputs.size(), answers.size());
            kind.require(world, inputs);
            world.instances.require_own(options.filter.ignored, Kind::call);
            if (ask_device(world, kept, kind, inputs, options)) {
                of(kept).take(Kind::call, answers);
            } else {
                world.prepare();
                kind.answer(world, inputs, answers, options.filter);
            }
        });
    }

    /// A call that submits.
    static Status submit(World::State& world, WorldRequest& request, const Kind& kind,
                         std::span<const Input> inputs, const WorldOptions& options) {
        return catch_within(options.limits, [&] {
            kind.require_room(Kind::call, inputs.size(), kind.answers_each() * inputs.size());
            kind.require(world, inputs);
            world.instances.require_own(options.filter.ignored, Kind::call);
            Of& own = of(request);
            own.require_collected(Kind::call);
            if (!ask_device(world, request, kind, inputs, options)) {
                own.answer_on_cpu(world, kind, inputs, options.filter);
            }
        });
    }

    /// A call that collects.
    static Status collect(WorldRequest& request, std::span<Answer> answers, const Limits& limits) {
        return catch_within(limits, [&] {
            if (request.state_ == nullptr || request.state_->question != Kind::question) {
                refuse_uncollected("collect");
            }
            static_cast<Of&>(*request.state_).take("collect", answers);
        });
    }

private:
    /// Lets the device begin, unless the CPU is to answer.
    [[nodiscard]] static bool ask_device(World::State& world, WorldRequest& request,
                                         const Kind& kind, std::span<const Input> inputs,
                                         const WorldOptions& options) {
        switch (options.technique) {
            case Technique::cpu:
                return false;
            case Technique::compute:
                if (kind.answers_each() != 1) {
                    refuse(Kind::call, "the device finds one of each, not " +
                                           std::to_string(kind.answers_each()));
                }
                of(request).begin_on_device(world, kind, inputs, options.filter);
                return true;
            case Technique::automatic:
                return kind.answers_each() == 1 && pays_on_device(world, inputs.size()) &&
                       of(request).begin_where_there_is_room(world, kind, inputs, options.filter);
            case Technique::raster:
                break;
        }
        refuse_technique(Kind::call, options.technique);
    }

    [[nodiscard]] bool begin_where_there_is_room(World::State& world, const Kind& kind,
                                                 std::span<const Input> inputs,
                                                 const WorldFilter& filter) {
        try {
            begin_on_device(world, kind, inputs, filter);
            return true;
        } catch (const StatusException& failure) {
            if (failure.status().code() != StatusCode::too_large) {
                throw;
            }
            return false;
        }
    }

    void answer_on_cpu(World::State& world, const Kind& kind, std::span<const Input> inputs,
                       const WorldFilter& filter) {
        const Stopwatch total;
        require_countable(Kind::call, inputs.size());
        timings = {};
        kind_ = kind;
        answers_.resize(kind.answers_each() * inputs.size());
        world.prepare();
        kind.answer(world, inputs, std::span(answers_), filter);
        count = left_to_cpu = static_cast<std::uint32_t>(inputs.size());
        is_answered_ = true;
        timings.decode = timings.total = total.milliseconds();
    }

    void begin_on_device(World::State& world, const Kind& kind, std::span<const Input> inputs,
                         const WorldFilter& filter) {
        run_or_forget(*world.context, [&] {
            const Stopwatch total;
            kind_ = kind;
            start(Kind::call, world.view(), filter, inputs.size());
            if (is_asked()) {
                std::byte* const memory = buffers_->reserve(count, context_->memory_limit());
                inputs_.assign(inputs.begin(), inputs.end());
                shaders::WorldQueryPush push{};
                kind_.take_down(*this, push);
                jobs_->divide(count, questions_of_part,
                              [&](std::uint32_t /*job*/, std::size_t first, std::size_t end) {
                                  for (std::size_t i = first; i < end; ++i) {
                                      const auto data = kind_.data_of(*this, inputs_[i]);
                                      std::memcpy(memory + i * sizeof(data), &data, sizeof(data));
                                  }
                              });
                begin(total, push);
            }
            set_pending_on_device(true);
            timings.total = total.milliseconds() - making_pipelines_;
        });
    }

    /// `call`: for messages.
    void take(const char* call, std::span<Answer> answers) {
        require_submitted(call);
        kind_.require_room(call, count, answers.size());
        if (is_answered_) {
            std::copy(answers_.begin(), answers_.end(), answers.begin());
            is_answered_ = false;
            return;
        }
        run_or_forget(*context_, [&] {
            const Stopwatch total;
            if (is_asked()) {
                buffers_->finish(timings);
            }
            const Stopwatch decoding;
            expect_answers(count);
            clear_left();
            if (is_asked()) {
                decide(answers);
            } else {
                std::fill(answers.begin(), answers.end(), Answer{});
                finish_answers(count);
            }
            gather_left();
            if (!left_.empty()) {
                answer_left(answers);
            }
            timings.decode = decoding.milliseconds();
            timings.total += total.milliseconds();
            set_pending_on_device(false);
        });
    }

    /// Answers what the device can tell; lists the others.
    void decide(std::span<Answer> answers) {
        using Found = typename Kind::Found;
        const std::byte* const all = buffers_->answers();
        jobs_->divide(count, questions_of_part,
                      [&](std::uint32_t job, std::size_t first, std::size_t end) {
                          checkpoint();
                          constexpr std::size_t ahead = 8;
                          for (std::size_t i = first; i < end; ++i) {
                              prefetch(all + std::min(i + ahead, end - 1) * sizeof(Found));
                              Found found;
                              std::memcpy(&found, all + i * sizeof(found), sizeof(found));
                              if (!kind_.decide(*this, inputs_[i], found, answers[i])) {
                                  left_of_jobs_[job].push_back(static_cast<std::uint32_t>(i));
                              }
                          }
                          finish_answers(end - first);
                      });
    }

    void answer_left(std::span<Answer> answers) {
        const world::Instances& all = instances_for_cpu();
        const WorldFilter filter = filter_for_cpu();
        solvers_.resize(jobs_->count());
        jobs_->divide(
            left_.size(), questions_of_part,
            [&](std::uint32_t job, std::size_t first, std::size_t end) {
                const auto numbers = std::span(left_).subspan(first, end - first);
                kind_.answer_some(solvers_[job], all, filter, inputs_, numbers, answers);
                if constexpr (requires(Answer answer) { answer.instance; }) {
                    for (const std::uint32_t number : numbers) {
                        InstanceHandle& named = answers[number].instance;
                        named = named == InstanceHandle{} ? named : instances()[named.index].handle;
                    }
                }
            });
    }

    Kind kind_;
    std::vector<Input> inputs_;
    std::vector<Answer> answers_;                 // of the CPU, until they are collected
    std::vector<typename Kind::Solver> solvers_;  // by job
};

}  // namespace nearfield
