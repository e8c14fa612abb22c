#pragma once

#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/polygons.hpp>

#include <optional>
#include <vector>

namespace nearfield::test {

/// Counts of the library's calls on queue and command buffers.
struct Calls {
    int submissions = 0;
    int waits = 0;
    int render_passes = 0;
    int draws = 0;
    int recordings = 0;        ///< counts a command that starts every kind of recording
    bool lose_device = false;  ///< waiting reports a lost device after it has waited
};
extern Calls calls;

/// Tests with their own context with two shapes, whose calls are counted.
class CountedContext : public QueryTest {
protected:
    void make(const Settings& settings);
    void make(std::uint32_t frames);
    void TearDown() override;

    [[nodiscard]] Context& counted() { return *counted_; }
    void destroy() { counted_.reset(); }

    /// The numbers from run(); each query must be answered.
    [[nodiscard]] std::vector<double> run(const Batch& batch);
    [[nodiscard]] std::vector<double> collect(Ticket ticket);
    [[nodiscard]] Ticket submit(const Batch& batch);
    [[nodiscard]] Ticket record(const Batch& batch, VkCommandBuffer commands, std::uint64_t frame);

    Rings rings_a_;
    Rings rings_b_;
    ShapeHandle a_;
    ShapeHandle b_;

private:
    void leave();

    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> counted_;
};

}  // namespace nearfield::test
