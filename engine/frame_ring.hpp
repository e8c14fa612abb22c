#pragma once

#include <engine/batch_runner.hpp>
#include <engine/gradient_normals.hpp>
#include <engine/shape_store.hpp>
#include <nearfield/context.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// The batches in flight. There is room for a fixed number; each has a runner to itself and holds
/// the shapes it was submitted with until it is collected.
class FrameRing {
public:
    FrameRing(std::uint32_t frames, const plan::PlanLimits& limits, const CostModel& costs,
              const char* gradient_format, Renderer& renderer, ShapeStore& shapes);

    /// Throws Failure (ring_full) where there is no room. After any Failure nothing of the batch is
    /// left. `memory`, if given, is swapped for results that the batch will not need.
    Ticket submit(std::span<const AnyQuery> queries, Results* memory = nullptr);
    /// collect() would not wait for what was submitted.
    [[nodiscard]] bool is_ready(Ticket ticket);
    /// Waits for one batch and writes its results. Throws Failure (unknown_ticket) where there is
    /// none; after any other Failure too the ticket is used up.
    void collect(Ticket ticket, Results& results);
    /// What stays on the device of a query of a batch in flight. Throws as collect() does, and
    /// where there is nothing.
    template <class Query>
    [[nodiscard]] auto resident(Ticket ticket, QueryHandle<Query> handle) {
        return require(ticket).runner.resident(handle);
    }
    /// Gives up a batch of a device that is lost. Throws as collect() does.
    void drop(Ticket ticket);

private:
    struct Frame {
        BatchRunner runner;
        ShapeStore::Held shapes;
        std::uint64_t number = 0;  // of its ticket; 0: none
    };

    [[nodiscard]] Frame* find(Ticket ticket);
    [[nodiscard]] Frame& require(Ticket ticket);
    [[nodiscard]] Frame& free_frame();
    void release(Frame& frame);

    ShapeStore* shapes_;
    Planning planning_;
    GradientNormals normals_;
    std::vector<std::unique_ptr<Frame>> frames_;
    std::uint64_t last_number_ = 0;
};

}  // namespace nearfield
