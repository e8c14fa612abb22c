#pragma once

#include <engine/batch_runner.hpp>
#include <engine/gradient_normals.hpp>
#include <engine/shape_store.hpp>
#include <nearfield/context.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// The batches in flight. There is room for a fixed number; each has a runner to itself and holds
/// the shapes it was submitted with until it is collected.
class FrameRing {
public:
    FrameRing(std::uint32_t frames, const plan::PlanLimits& limits, const CostModel& costs,
              const JobSystem& jobs, Renderer* renderer, ShapeStore& shapes);

    /// Throws Failure (ring_full) where there is no room. After any Failure nothing of the batch is
    /// left. `memory`, if given, is swapped for results that the batch will not need.
    Ticket submit(std::span<const AnyQuery> queries, const Submission& order,
                  Results* memory = nullptr);
    /// The same, recorded into a command buffer of the host. Implies that the device has done all
    /// of the frames that no longer are in flight then. Throws Failure (invalid_submission) too.
    Ticket record(std::span<const AnyQuery> queries, const Recording& recording);
    /// The device has done everything of the host's frames up to this one.
    void complete(std::uint64_t host_frame);
    /// collect() would not wait for what was submitted.
    [[nodiscard]] bool is_ready(Ticket ticket);
    /// Waits for one batch and writes its results. Throws Failure (unknown_ticket) where there is
    /// none, (not_ready) where its frame is not complete; after any other Failure the ticket is
    /// used up.
    void collect(Ticket ticket, Results& results);
    /// What stays on the device of a query of a batch in flight. Throws as collect() does, and
    /// where there is nothing.
    template <class Query>
    [[nodiscard]] auto resident(Ticket ticket, QueryHandle<Query> handle) {
        return require(ticket).runner.resident(handle);
    }
    /// The tiles of the batch set going last.
    void list_tiles(std::vector<TileReport>& tiles) const;
    /// Gives up a batch of a device that is lost. Throws as collect() does.
    void drop(Ticket ticket);
#ifdef NEARFIELD_SHADER_RELOAD
    /// Throws Failure (not_ready) where a batch is; `call`: for the message.
    void require_none_in_flight(const char* call) const;
    /// Takes the place of another ring, none of whose batches is in flight: its tickets stay used.
    void count_on_from(const FrameRing& former) {
        last_number_ = former.last_number_;
        complete_ = former.complete_;
    }
#endif

private:
    struct Frame {
        BatchRunner runner;
        ShapeStore::Held shapes;
        std::uint64_t number = 0;      // of its ticket; 0: none
        std::uint64_t host_frame = 0;  // that it was recorded for, where it was
    };

    [[nodiscard]] Frame* find(Ticket ticket);
    [[nodiscard]] Frame& require(Ticket ticket);
    [[nodiscard]] Frame& free_frame();
    void release(Frame& frame);
    [[nodiscard]] bool is_complete(std::uint64_t host_frame) const {
        return complete_ && host_frame <= *complete_;
    }
    [[nodiscard]] bool is_ready(Frame& frame) const;
    /// Has `start(runner, find_shape)` set a batch going in a free frame.
    template <class Start>
    Ticket start_batch(Results* memory, const Start& start);

    ShapeStore* shapes_;
    Planning planning_;
    GradientNormals normals_;
    std::vector<std::unique_ptr<Frame>> frames_;
    std::uint64_t last_number_ = 0;
    const Frame* last_ = nullptr;            // of the batch set going last; null where it failed
    std::optional<std::uint64_t> complete_;  // the last of the host's frames that is
};

}  // namespace nearfield
