#pragma once

#include <engine/batch/batch_runner.hpp>
#include <engine/batch/shape_store.hpp>
#include <nearfield/context.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::batch {

/// The batches in flight, a fixed number at most; each has a runner of its own and holds the shapes
/// it was submitted with until it is collected.
class BatchRing {
public:
    BatchRing(std::uint32_t frames, const queries::QueryLimits& limits,
              const std::optional<DeviceThresholds>& thresholds, const JobSystem& jobs,
              render::Renderer* renderer, ShapeStore& shapes);

    /// Throws StatusException (ring_full) if the ring is full. After any StatusException nothing of
    /// the batch remains.
    Ticket submit(const Batch& batch, const Submission& order);
    /// Both halves: writes the results, in whose memory they are made. Throws as submit() and
    /// collect(); nothing of the batch remains then.
    void run(const Batch& batch, Results& results);
    /// The same, recorded into a command buffer of the host. Throws as require_open_frame() too.
    Ticket record(const Batch& batch, const Recording& recording);
    /// Precedes all that is recorded for the host. Throws StatusException (invalid_submission)
    /// without a command buffer, or if this frame is complete already.
    void require_open_frame(const Recording& recording) const;
    /// Reports that the device has finished the host's frames up to this one.
    void complete(std::uint64_t host_frame);
    [[nodiscard]] bool is_complete(std::uint64_t host_frame) const {
        return complete_ && host_frame <= *complete_;
    }
    /// Returns whether collect() would return without waiting for a submitted batch.
    [[nodiscard]] bool is_ready(Ticket ticket);
    /// Waits for one batch and writes its results. Throws StatusException: (unknown_ticket) if
    /// there is no such batch, (not_ready) if its frame is not complete; after any other
    /// StatusException the ticket is used up.
    void collect(Ticket ticket, Results& results);
    /// The resident output of a query of a batch in flight. Throws as collect() does, and if the
    /// query has none.
    template <class Query>
    [[nodiscard]] auto on_device(Ticket ticket, QueryHandle<Query> handle) {
        const Frame& frame = require(ticket);
        return in_slot(frame, frame.runner.on_device(handle));
    }
    /// What on_device() will return for such a query of such a batch, by frame. Throws
    /// StatusException: (not_ready) if a batch is in flight, and as submit() and on_device() do.
    template <class Query>
    [[nodiscard]] auto layout_on_device(const Batch& batch, QueryHandle<Query> handle) {
        require_none_in_flight("layout_on_device");
        std::vector<decltype(frames_.front()->runner.on_device(handle))> layout;
        for (const auto& frame : frames_) {
            reserve(*frame, batch);
            layout.push_back(in_slot(*frame, frame->runner.on_device(handle)));
        }
        return layout;
    }
    /// The solvers, for queries of the technique `cpu` that are no batch.
    [[nodiscard]] solvers::SolverJobs& solvers() { return planning_.solvers; }
    /// Throws StatusException as the query fails.
    [[nodiscard]] FieldGrid field_grid(const DistanceFieldQuery& query) const;
    // See Context::target_size.
    [[nodiscard]] std::uint64_t target_size(PenetrationQuery query) const;
    [[nodiscard]] std::uint64_t target_size(ContactQuery query) const;
    [[nodiscard]] std::uint64_t target_size(IntersectionQuery query) const;
    /// Drops the device memory that no batch in flight uses.
    void trim() noexcept;
    /// Lists the tiles of the batch started last.
    void list_tiles(std::vector<TileReport>& tiles) const;
    /// The host's frames that are not complete, as far as is known: "3, 4"; empty if there are
    /// none.
    [[nodiscard]] std::string open_frames() const;
    /// Abandons a batch of a lost device. Throws as collect() does.
    void drop(Ticket ticket);
    /// Throws StatusException (not_ready) if a batch is in flight; `call`: for the message.
    void require_none_in_flight(const char* call) const;
#ifdef NEARFIELD_SHADER_RELOAD
    /// Continues the ticket numbers of another ring without batches in flight: its tickets stay
    /// used.
    void count_on_from(const BatchRing& former) {
        last_number_ = former.last_number_;
        complete_ = former.complete_;
    }
#endif

private:
    struct Frame {
        BatchRunner runner;
        ShapeStore::Held shapes;
        std::uint32_t index = 0;       // among the frames
        std::uint64_t number = 0;      // of its ticket; 0: none
        std::uint64_t host_frame = 0;  // that it was recorded for, if it was
    };

    [[nodiscard]] Frame* find(Ticket ticket);
    [[nodiscard]] Frame& require(Ticket ticket);
    [[nodiscard]] Frame& free_frame();
    void release(Frame& frame);
    [[nodiscard]] queries::FindShape find_shape_for(Frame& frame);
    template <class Query>
    [[nodiscard]] queries::CheckedQuery check_alone(AnyQuery& any, AnyResult& result) const;
    /// Makes room in a frame for a batch that is not started.
    void reserve(Frame& frame, const Batch& batch);
    template <class Resident>
    [[nodiscard]] Resident in_slot(const Frame& frame, Resident resident) const {
        resident.slot.index = frame.index;
        return resident;
    }
    [[nodiscard]] bool is_ready(Frame& frame) const;
    /// Calls `start(frame, find_shape)` to start a batch in a free frame.
    /// `memory`, if given, is swapped for results that the batch does not need.
    template <class Start>
    Ticket start_batch(const Batch& batch, Results* memory, Laps& laps, const Start& start);
    Ticket submit(const Batch& batch, const Submission& order, Results* memory, Laps& laps);
    void collect(Ticket ticket, Results& results, Laps& laps);

    ShapeStore* shapes_;
    Planning planning_;
    std::vector<std::unique_ptr<Frame>> frames_;
    std::uint64_t last_number_ = 0;
    const Frame* last_ = nullptr;            // of the batch started last; null if it failed
    std::optional<std::uint64_t> complete_;  // the last complete frame of the host
};

}  // namespace nearfield::batch
