#pragma once

#include <nearfield/export.hpp>
#include <nearfield/fill.hpp>
#include <nearfield/headless.hpp>
#include <nearfield/jobs.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The entry point of the library: a context owns shapes, device objects and memory, and answers
/// batches of queries.

namespace nearfield {

// Defined in host.hpp, submission.hpp and on_device.hpp, which vulkan.hpp includes.
struct HostDevice;
struct Submission;
struct Recording;
struct FieldOnDevice;
struct PointsOnDevice;
struct SamplesOnDevice;

/// Upper limit of Settings::batches_in_flight.
inline constexpr std::uint32_t max_batches_in_flight = 8;

/// The device techniques that a context builds pipelines for. Technique::cpu needs no device and is
/// always available.
struct DeviceTechniques {
    bool raster = true;   ///< Technique::raster
    bool compute = true;  ///< Technique::compute
};

/// The amount of work in a batch from which Technique::automatic selects Technique::compute on a
/// hardware device. A device that runs on the CPU, such as lavapipe, never answers what the CPU
/// can. 0: always; UINT64_MAX: never. The defaults come from an H100 and an H200
/// (docs/measurements/gpu.md); `nearfield bench --gpu` measures another device.
struct DeviceThresholds {
    /// The number of penetrations, contacts and intersections together. An H100 answered 1,934
    /// penetrations as fast as one thread of its CPU, by an older build. An H200 needs less than
    /// half of the CPU's time for 4,738.
    std::uint64_t pairs = 2000;
    /// The number of cells of all distance fields together. Without a rectangle a field counts an
    /// upper bound, from the squares around both shapes' circles. For 256 x 256 cells an H100 needs
    /// a third of the CPU's time.
    std::uint64_t cells = 65536;
};

/// Limits and settings of a context. Invalid settings are rejected when the context is created,
/// before any driver call (StatusCode::invalid_settings).
struct Settings {
    /// Number of batches that may be submitted or recorded and not yet collected, 1 to
    /// `max_batches_in_flight`. Each has its own buffers, created on first use. A host that records
    /// sets its own number of frames in flight times its batches per frame.
    std::uint32_t batches_in_flight = 2;
    /// Memory limit for the images and results of one batch, host and device together, in bytes. A
    /// batch that needs more fails (StatusCode::too_large): before the device works, or once the
    /// CPU or the device's search has found the points that count. Meshes and edge lists, whose
    /// size depends on the shapes and not on the grid, are not counted. With several batches in
    /// flight the limit applies to the results of each; the images are shared.
    std::uint64_t memory_limit = std::uint64_t{1} << 30U;
    /// Maximum height of the bounding-volume hierarchies used for localisation (section 2.1 of the
    /// paper). A larger value means more work on the CPU and less on the device.
    std::uint32_t hierarchy_height = 12;
    /// Bounding volumes of these hierarchies; docs/performance.md compares the settings.
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
    /// The amount of work from which Technique::automatic selects compute on a hardware device.
    DeviceThresholds device_thresholds = {};
    /// Host threads for the queries that the CPU answers and for making pipelines. Its function and
    /// `user` must stay valid for the lifetime of the context. Default: everything runs on the
    /// calling thread.
    JobSystem jobs = {};
    /// Techniques to build pipelines for. Technique::automatic never selects a technique that is
    /// left out, and a query that names one fails with StatusCode::unsupported_technique in its own
    /// result. Ignored by a context without a device.
    DeviceTechniques techniques = {};
    /// True: timestamps measure each pass (Timings::passes). They cost time themselves, because
    /// some drivers wait at each: small frames of lavapipe become twice as long.
    bool timestamps = false;
    /// False: the context makes all pipelines when it is created, and no later call makes any.
    /// True: the first call that needs a pipeline makes it and is slower for that: run(), submit(),
    /// record(), collect(), layout_on_device(), World::update(), World::submit() or
    /// World::record(). For a program that has few queries and should start quickly.
    bool pipelines_on_demand = false;
};

/// The result of Context::add_shape(): the handle of the shape, or the reason why there is none. It
/// converts to a ShapeHandle. If the shape was refused, every query about it fails for the same
/// reason. The context keeps the messages of its last 64 refusals.
class AddedShape : public Expected<ShapeHandle> {
public:
    /// A shape that was added.
    AddedShape(ShapeHandle handle) : Expected(handle), handle_(handle) {}
    /// A shape that was refused, and the handle that stands for it.
    AddedShape(Status why, ShapeHandle handle) : Expected(std::move(why)), handle_(handle) {}

    /// The handle. Every query refuses the handle of a refused shape.
    operator ShapeHandle() const noexcept { return handle_; }

private:
    ShapeHandle handle_;
};

/// Names a batch in flight of one context. The default value names none. A ticket of another
/// context is refused (unknown_ticket).
struct Ticket {
    std::uint64_t number = 0;   ///< counts the batches of a context from 1; 0: no batch
    std::uint32_t context = 0;  ///< number of the context, unique in the process

    /// True if both name the same batch of one context.
    friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// Device memory of one context, in bytes: allocated by the library or by HostDevice::memory.
struct MemoryUse {
    std::uint64_t in_use = 0;  ///< now
    std::uint64_t peak = 0;    ///< maximum since the context was created
};

/// Answers queries, on one Vulkan device or on the CPU alone.
///
/// Threads: a context is used by one thread at a time. Different contexts are independent, on the
/// same device too, as long as their queues are not used at the same time
/// (HostDevice::queue_access).
///
/// Lifetime: worlds, tables of pairs and requests keep what they need of their context, so that all
/// of them can be destroyed in any order. The last of them waits for the batches that the context
/// submitted, and for nothing else on the device, then frees everything the context created. It
/// does not wait for recorded batches: the device must have finished them, or never start them, and
/// the host says so by frame_completed() first. Otherwise the log has an error that names the open
/// frames, and debug builds of the library end the program (assert). A command buffer that holds a
/// batch of a destroyed context must not be submitted; it can only be reset or freed.
///
/// Errors: after any error except device_lost the context remains usable. After device_lost, calls
/// that can fail return device_lost and no more work goes to Vulkan. Destroy the context, which
/// still frees everything, and create another on another device.
class NEARFIELD_EXPORT Context {
public:
    /// Creates a context on a host's device, which must outlive it and all that keeps it. Fails
    /// with unsupported_device if the device does not meet the base requirements (Status::reasons
    /// lists all that it lacks), or with invalid_settings, out_of_memory, device_lost or
    /// device_error.
    [[nodiscard]] static Expected<Context> create(const HostDevice& host,
                                                  const Settings& settings = {});

    /// Creates a context with an instance and a device of its own, without presentation. Fails with
    /// no_device if there is no loader, driver or device of the given name, with unsupported_device
    /// if no device is usable (Status::reasons lists what each one lacks), and as create() does.
    [[nodiscard]] static Expected<Context> create_headless(const HeadlessOptions& options = {},
                                                           const Settings& settings = {});

    /// Creates a context without a device: opens no Vulkan loader and needs no driver. It answers
    /// every query that Technique::cpu answers, and Technique::automatic means Technique::cpu. A
    /// query that needs a device (raster, compute, results on the device, blended gradients) fails
    /// in its own result (unsupported_technique). record(), submit() with semaphores, and
    /// reload_shaders() fail with no_device. Settings that concern the device are ignored.
    [[nodiscard]] static Expected<Context> create_cpu(const Settings& settings = {});

    /// Creates a context without a device, with default settings. The program ends if memory runs
    /// out; create_cpu() returns the error instead.
    Context() noexcept;

    ~Context();
    /// A moved-from context can only be destroyed or assigned to.
    Context(Context&&) noexcept;
    /// Destroys the context that was there before.
    Context& operator=(Context&&) noexcept;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Adds a shape. The rings are copied. There is no precomputation: a shape may be added in the
    /// frame that first uses it. The result tells whether the shape was refused, and so does the
    /// first query about it.
    ///
    /// `deviation`, in the units of the coordinates, >= 0: the maximum distance of the rings from
    /// the shape that they approximate, as bounded by tessellate() (curve.hpp); 0 if the rings are
    /// the shape. It is part of the error bound of every result that depends on the shape. A query
    /// fails (invalid_query) if the deviations of its shapes together exceed `max_deviation` times
    /// its tolerance.
    ///
    /// Fails with invalid_shape if there is no ring, a ring has fewer than three different vertices
    /// or lies on one line, a coordinate is not finite or exceeds `largest_coordinate` in
    /// magnitude, the rings together are smaller than `smallest_extent` or have more than
    /// `max_vertices` vertices, or the deviation is out of range.
    [[nodiscard]] AddedShape add_shape(std::span<const Ring> rings, double deviation = 0.0);
    /// Adds a shape from the caller's own numbers, which are copied. Fails as for a Ring.
    [[nodiscard]] AddedShape add_shape(std::span<const RingView> rings, double deviation = 0.0);
    /// Adds the region that the rings enclose by a rule, as resolve_fill() (fill.hpp) finds it on
    /// its finest grid: features are those of its rings, and its deviation is added to `deviation`.
    /// With FillRule::union_of_parts every ring is a part. Fails as resolve_fill() does too, and
    /// with invalid_shape if the region is empty.
    [[nodiscard]] AddedShape add_shape(std::span<const Ring> rings, FillRule rule,
                                       double deviation = 0.0);

    /// Replaces all rings of a shape; its handle stays valid. Nothing is rebuilt, so deforming a
    /// shape every frame costs one copy. Batches in flight are answered for the rings they were
    /// submitted with. Fails with unknown_shape and as add_shape() does; the shape then keeps its
    /// rings.
    Status update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation = 0.0);
    /// Replaces all rings by the caller's own numbers, which are copied. Fails as for a Ring.
    Status update_shape(ShapeHandle shape, std::span<const RingView> rings, double deviation = 0.0);
    /// Replaces all rings by those of the region that `rings` enclose by a rule. Costs as much as
    /// resolve_fill(), and also fails as resolve_fill() does.
    Status update_shape(ShapeHandle shape, std::span<const Ring> rings, FillRule rule,
                        double deviation = 0.0);

    /// Removes a shape. Its handle stays invalid from then on (unknown_shape). Batches in flight
    /// are answered as if the shape were still there.
    Status remove_shape(ShapeHandle shape);

    /// Broad phase: the pairs of instances whose bounding boxes are at most `reach` apart along
    /// both axes (world units, >= 0; 0: the closed boxes overlap), in ascending order. The boxes
    /// include the rounding of their vertices, because shapes that are that close touch. The time
    /// grows with the number of instances and of pairs found. The pairs are borrowed from the
    /// context, which keeps their memory, until the next call. Fails with invalid_query (the reach
    /// or a pose), unknown_shape or out_of_memory.
    [[nodiscard]] Expected<std::span<const InstancePair>> find_overlapping_boxes(
        std::span<const Instance> instances, double reach);

    /// Answers a batch and returns when all results are available: submit(), then collect(). Fails
    /// with ring_full if Settings::batches_in_flight batches are in flight.
    ///
    /// The returned status is that of the batch as a whole: too_large (more memory than the limit,
    /// or than one buffer of the device holds), out_of_memory, device_lost, device_error; the
    /// results are undefined then. An error of one query (invalid_query, unknown_shape,
    /// unsupported_strategy, ...) is the status of that query's result, and the other queries are
    /// answered. If `limits` end the call, the queries that are not done say so in the same way.
    Status run(const Batch& batch, Results& results, const Limits& limits = {});

    /// Answers one query: run() with a batch of one. An error of the query is the returned status.
    /// A program with many queries per frame puts them into one Batch, which is submitted once and
    /// keeps its memory.
    template <class Query>
    [[nodiscard]] Expected<typename Query::Result> answer(const Query& query,
                                                          const Limits& limits = {}) {
        Batch batch;
        const QueryHandle<Query> handle = batch.add(query);
        Results results;
        if (Status status = run(batch, results, limits); !status.ok()) {
            return status;
        }
        auto& result = *std::get_if<typename Query::Result>(&results.results[handle.index]);
        return result.status.ok() ? Expected<typename Query::Result>(std::move(result))
                                  : result.status;
    }

    /// Submits a batch without waiting for it: localises, plans, records everything into one
    /// command buffer and submits that to the queue, then answers the queries of the CPU. Nothing
    /// is submitted if no query needs the device. Nothing of the batch is borrowed: as soon as this
    /// returns, it may be cleared, and shapes may be updated and removed.
    ///
    /// Fails with ring_full if Settings::batches_in_flight batches are not yet collected, and as
    /// run() does; there is no ticket then and nothing to collect. If `limits` end the call while
    /// it plans, no query needs the device. They hold for this call alone.
    [[nodiscard]] Expected<Ticket> submit(const Batch& batch, const Limits& limits = {});
    /// Submits a batch as above, with semaphores of the host's: the device waits for some of them
    /// before it works on the batch and signals the others when it is done. If no query needs the
    /// device, the semaphores are submitted without commands, so every ticket waits for them and
    /// signals them exactly once. On an error they are not submitted. Also fails with
    /// invalid_submission if a semaphore cannot be used (the message names it and the reason).
    [[nodiscard]] Expected<Ticket> submit(const Batch& batch, const Submission& submission,
                                          const Limits& limits = {});

    /// Records a batch into a command buffer of the host, which submits it; this call submits
    /// nothing and waits for nothing. When it returns, the device's input has been written and
    /// flushed; the last barrier recorded makes the output visible to the host. So the host needs
    /// no barrier of its own before or after. Nothing is recorded if no query needs the device.
    ///
    /// Preconditions (checked by validation layers, not by the library): `commands` is as
    /// Recording::commands states; it is submitted at most once after this, to HostDevice::queue
    /// (or through queue_access); and all other batches of this context go to the same queue, in
    /// any order.
    ///
    /// State changed in the command buffer, which the host sets again as needed: for both bind
    /// points (graphics and compute) the pipeline, descriptor set 0 and push constants; the vertex
    /// buffer at binding 0; dynamic state (viewport 0, scissor 0, stencil compare mask, write mask
    /// and reference). No render pass is left open. No object of the host is touched, and no image
    /// of the library is left in a layout that matters.
    ///
    /// The batch is complete when the host says so, by frame_completed(), and not before. Until
    /// then its ticket is not ready, unless nothing was recorded because the CPU alone answers.
    ///
    /// The memory suffices for all samples of intersections.
    ///
    /// Fails with invalid_submission if `commands` is null or the frame is already complete, and as
    /// submit() does; nothing has been recorded then, and there is no ticket. `limits` as for
    /// submit(); what the host's queue does afterwards has none.
    [[nodiscard]] Expected<Ticket> record(const Batch& batch, const Recording& recording,
                                          const Limits& limits = {});

    /// States that the device has finished all of the host's frames up to `frame`, or will never
    /// execute them. Batches and tables recorded for these frames can be collected; those whose
    /// commands were not executed return not_executed. A smaller number than before has no effect.
    void frame_completed(std::uint64_t frame) noexcept;

    /// True if collect() would not wait for a submitted batch, or if the frame of a recorded batch
    /// is complete. Never waits. Also true for a ticket that collect() rejects, and for every
    /// ticket once the device is lost.
    [[nodiscard]] bool is_ready(Ticket ticket);

    /// Waits for one batch, not for those before or after it, and writes its results: the same, bit
    /// for bit, as run() would have written at the time of submit(). Tickets may be collected in
    /// any order, each one once (unknown_ticket otherwise). To keep memory, pass the same `results`
    /// objects again: their memory is swapped with that of the batches in flight.
    ///
    /// Recorded work is never waited for. If its frame is not complete, this fails with
    /// not_ready and the ticket stays valid; if it is complete and the device did not execute the
    /// commands, with not_executed, which uses up the ticket like every other error.
    ///
    /// Two kinds of submitted work go to the device a second time here and wait, unless
    /// Technique::cpu answers them: intersections with more samples than the buffer had space for
    /// (more than an eighth of the cells and more than ever before in this context; the next batch
    /// has the space), and searches of Technique::compute that found more points than earlier
    /// batches (the next batch has the space, too).
    ///
    /// `limits` hold for this call alone. The wait for the device is not cut; if they end the call,
    /// the queries that are not done say so, and the ticket is used up.
    ///
    /// Fails as run() does; the ticket is used up all the same. Once the device is lost, every
    /// ticket in flight fails with device_lost.
    Status collect(Ticket ticket, Results& results, const Limits& limits = {});

    /// The results that a query with `on_device` set leaves on the device, from submit() or
    /// record() until the batch is collected. They are valid once the device has executed the
    /// commands; on_device.hpp states how a host's shaders read them. Never waits.
    ///
    /// Fails with unknown_ticket as collect() does; with invalid_query if the handle names no query
    /// of that kind in the batch, or one without `on_device`; with the query's own status if that
    /// is an error, as for Technique::cpu; with device_lost once the device is lost.
    [[nodiscard]] Expected<FieldOnDevice> on_device(Ticket ticket,
                                                    QueryHandle<DistanceFieldQuery> query);
    /// The points of a penetration query; otherwise as for a field.
    [[nodiscard]] Expected<PointsOnDevice> on_device(Ticket ticket,
                                                     QueryHandle<PenetrationQuery> query);
    /// The points of a contact query; otherwise as for a field.
    [[nodiscard]] Expected<PointsOnDevice> on_device(Ticket ticket,
                                                     QueryHandle<ContactQuery> query);
    /// The samples of an intersection query; otherwise as for a field.
    [[nodiscard]] Expected<SamplesOnDevice> on_device(Ticket ticket,
                                                      QueryHandle<IntersectionQuery> query);

    /// The grid that the result of a field will have, by any technique: the size of the host's own
    /// images (FieldTarget). Makes, plans and reserves nothing. Fails as the query would.
    ///
    ///     const auto grid = context.field_grid(query);
    ///     image = grid ? make_image(grid->width, grid->height) : VK_NULL_HANDLE;
    [[nodiscard]] Expected<FieldGrid> field_grid(const DistanceFieldQuery& query) const;

    /// Bytes of a BufferTarget in which a query with `on_device` has space: for points all along
    /// the boundaries that it examines (of penetration A's, of contacts A's and B's), so it
    /// suffices at any poses until the rings of a shape are replaced. Makes, plans and reserves
    /// nothing. Fails where the query is invalid, names no shape, or is answered by no device of
    /// this context.
    ///
    ///     const auto size = context.target_size(query);
    ///     buffer = size ? make_buffer(*size) : VK_NULL_HANDLE;
    [[nodiscard]] Expected<std::uint64_t> target_size(const PenetrationQuery& query) const;
    /// The same of contacts.
    [[nodiscard]] Expected<std::uint64_t> target_size(const ContactQuery& query) const;
    /// Of an intersection at the query's poses: exactly SamplesOnDevice::size, for a sample in
    /// every cell of every region. Otherwise the same.
    [[nodiscard]] Expected<std::uint64_t> target_size(const IntersectionQuery& query) const;

    /// What on_device() will return for a query of a batch like this one: one entry for each of
    /// Settings::batches_in_flight, at the position OutputSlot::index. Reserves memory in all of
    /// them, so that a host can write its descriptor sets before the first frame. The handles stay
    /// valid as long as OutputSlot::revision stays the same. Plans the batch once for each entry,
    /// and records nothing. Sizes are those at the poses of the batch; target_size() of points
    /// holds for all.
    ///
    /// Fails with not_ready if a batch is in flight, and as submit() and on_device() do.
    [[nodiscard]] Expected<std::vector<FieldOnDevice>> layout_on_device(
        const Batch& batch, QueryHandle<DistanceFieldQuery> query);
    /// The points of a penetration query; otherwise as for a field.
    [[nodiscard]] Expected<std::vector<PointsOnDevice>> layout_on_device(
        const Batch& batch, QueryHandle<PenetrationQuery> query);
    /// The points of a contact query; otherwise as for a field.
    [[nodiscard]] Expected<std::vector<PointsOnDevice>> layout_on_device(
        const Batch& batch, QueryHandle<ContactQuery> query);
    /// The samples of an intersection query; otherwise as for a field.
    [[nodiscard]] Expected<std::vector<SamplesOnDevice>> layout_on_device(
        const Batch& batch, QueryHandle<IntersectionQuery> query);

    /// The device's name as reported by its driver; empty without a device.
    [[nodiscard]] const std::string& device_name() const noexcept;

    /// The device memory of this context, now and at its peak.
    [[nodiscard]] MemoryUse memory_use() const noexcept;

    /// Frees the device memory that no batch in flight uses. Later batches allocate it again at the
    /// size that they need. Useful after a spike or a change of scene. Handles of results on the
    /// device of collected batches and from layout_on_device() become invalid. Never waits.
    void trim() noexcept;

    class NEARFIELD_HIDDEN Implementation;  ///< the library's own

private:
    friend struct ContextAccess;  // of diagnostics.hpp
    friend class World;           // of world.hpp
    friend class WorldRequest;    // of world_request.hpp
    explicit Context(std::shared_ptr<Implementation> implementation) noexcept;
    std::shared_ptr<Implementation> implementation_;
};

}  // namespace nearfield
