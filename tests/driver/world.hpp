#pragma once

#include <nearfield/context.hpp>

#include <tests/support/mock_driver.hpp>
#include <tests/support/techniques.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {

/// A context on a mock driver, taken through its lifetime in steps.
class World {
public:
    /// The steps in a context's lifetime, in order; each needs those before it.
    enum class Step {
        create,
        add_shapes,
        submit_first,  ///< with semaphores
        collect_first,
        submit_larger,  ///< buffers and images must grow; some results stay on the device
        collect_larger,
        record,
        collect_recorded,  ///< after the host has executed it
        record_in_vain,
        collect_unexecuted,   ///< after the host has discarded it, which it must report
        submit_without_work,  ///< for the device, so that only semaphores are submitted
        collect_without_work,
        submit_last,  ///< like the larger one before: nothing is created
        record_last,  ///< while that one is in flight, so that the second frame's resources are
                      ///< created
        destroy,      ///< with these two in flight
    };
    static constexpr Step steps[] = {Step::create,
                                     Step::add_shapes,
                                     Step::submit_first,
                                     Step::collect_first,
                                     Step::submit_larger,
                                     Step::collect_larger,
                                     Step::record,
                                     Step::collect_recorded,
                                     Step::record_in_vain,
                                     Step::collect_unexecuted,
                                     Step::submit_without_work,
                                     Step::collect_without_work,
                                     Step::submit_last,
                                     Step::record_last,
                                     Step::destroy};

    /// Uses this technique of a device for queries, but for those whose results stay.
    explicit World(Technique technique)
        : technique_(technique),
          before_(driver_.make_semaphore(true)),
          after_(driver_.make_semaphore(false)) {
        const VkImage image = driver_.make_image();
        target_.signed_distance = {image,
                                   driver_.make_view(image),
                                   VK_FORMAT_R32_SFLOAT,
                                   {4096, 4096},
                                   VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT};
    }
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    [[nodiscard]] test_support::MockDriver& driver() { return driver_; }
    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] bool has_context() const { return context_.has_value(); }

    /// Contexts made from now on take their device memory from these functions.
    void use_memory(const MemoryFunctions& memory) { memory_ = memory; }

    /// Takes one step.
    Status take(Step step);
    /// Takes all steps before `step`; each must succeed.
    void take_all_before(Step step);
    /// Answers the larger batch (after add_shapes) and the first one without the driver, and
    /// returns the results as numbers. An error of any query counts.
    Status answer(std::vector<double>& numbers);
    /// Whether the step starts a batch: of one that fails nothing remains, so it can be taken
    /// again.
    [[nodiscard]] static bool starts_a_batch(Step step);
    /// The result of answer() without failures.
    [[nodiscard]] static std::vector<double> undisturbed(Technique technique);

    [[nodiscard]] Batch batch(double cells) const { return batch(cells, technique_); }
    /// One intersection of volumes, with samples.
    [[nodiscard]] Batch overlap(double cells) const;

    /// The first batch inverts the states of two semaphores, the one without work restores them.
    [[nodiscard]] bool is_before_first() const {
        return driver_.is_signalled(before_) && !driver_.is_signalled(after_);
    }
    [[nodiscard]] bool is_after_first() const {
        return driver_.is_signalled(after_) && !driver_.is_signalled(before_);
    }

private:
    Status create();
    Status add_shapes();
    Status submit(const Batch& queries, const Submission& submission);
    Status submit_for_device(double cells, const Submission& submission);
    Status record();
    void leave();
    Status collect();
    /// The host has completed its frame.
    Status collect_recorded(bool executed);
    /// Requests all resident outputs of the batch in flight. An error if what they name does not
    /// exist, or is not what it was although its revision is the same.
    Status look_at_residents();
    template <class Query>
    Status look_at_resident(QueryHandle<Query> handle);
    [[nodiscard]] bool is_usable(const FieldOnDevice& field) const;
    template <class Resident>
    [[nodiscard]] bool is_usable(const Resident& resident) const;
    /// One query of each kind that a technique answers, with this many cells per unit.
    [[nodiscard]] Batch batch(double cells, Technique technique) const;
    [[nodiscard]] Instance here() const { return {a_, {}}; }
    [[nodiscard]] Instance there() const { return {b_, {{1.2, 0.4}, 0.3}}; }

    struct NamedBefore {
        std::uint64_t revision = 0;
        std::vector<const void*> handles;
    };

    Technique technique_;
    test_support::MockDriver driver_;
    VkSemaphore before_;
    VkSemaphore after_;
    MemoryFunctions memory_;
    FieldTarget target_;  ///< of resident fields: one image is the host's
    std::optional<Context> context_;
    ShapeHandle a_;
    ShapeHandle b_;
    /// What an output of a slot named last, by the slot and the number of the query.
    std::map<std::pair<std::uint32_t, std::uint32_t>, NamedBefore> named_before_;
    Ticket ticket_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  // for the host's frame
    std::uint64_t frame_ = 0;
};

[[nodiscard]] const char* to_string(World::Step step);

/// The library's status code for an error of the driver.
[[nodiscard]] StatusCode code_of(VkResult error);

}  // namespace nearfield::test
