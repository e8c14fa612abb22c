#pragma once

#include <nearfield/context.hpp>

#include <tests/support/mock_driver.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {

/// A context on a mock driver, taken through its life in steps.
class World {
public:
    /// What a context goes through, in order; each step needs those before it.
    enum class Step {
        create,
        add_shapes,
        submit_first,
        collect_first,
        submit_larger,  ///< buffers and images have to grow
        collect_larger,
        submit_last,  ///< as the one before: nothing is made
        destroy,      ///< with that batch in flight
    };
    static constexpr Step steps[] = {Step::create,        Step::add_shapes,    Step::submit_first,
                                     Step::collect_first, Step::submit_larger, Step::collect_larger,
                                     Step::submit_last,   Step::destroy};

    /// Queries by this technique: raster or compute.
    explicit World(Technique technique) : technique_(technique) {}

    [[nodiscard]] test_support::MockDriver& driver() { return driver_; }
    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] bool has_context() const { return context_.has_value(); }

    /// Takes one step.
    Status take(Step step);
    /// Takes all steps before `step`; each has to succeed.
    void take_all_before(Step step);
    /// Answers the larger batch, after add_shapes, and the first one without the driver; what that
    /// says, as numbers. An error of any query counts.
    Status answer(std::vector<double>& numbers);
    /// What answer() says where nothing comes in the way.
    [[nodiscard]] static std::vector<double> undisturbed(Technique technique);

    [[nodiscard]] Batch batch(double cells) const { return batch(cells, technique_); }

private:
    Status create();
    Status add_shapes();
    Status submit(double cells);
    Status collect();
    /// One of each kind of query that a technique answers, with so many cells to a unit.
    [[nodiscard]] Batch batch(double cells, Technique technique) const;

    Technique technique_;
    test_support::MockDriver driver_;
    std::optional<Context> context_;
    ShapeHandle a_;
    ShapeHandle b_;
    Ticket ticket_;
};

[[nodiscard]] const char* to_string(World::Step step);

}  // namespace nearfield::test
