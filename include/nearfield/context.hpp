#pragma once

#include <nearfield/cost.hpp>
#include <nearfield/export.hpp>
#include <nearfield/host.hpp>
#include <nearfield/jobs.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/requirements.hpp>
#include <nearfield/resident.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>
#include <nearfield/submission.hpp>
#include <nearfield/tile.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The door: a context owns shapes, device objects and memory, takes batches and returns results.

namespace nearfield {

/// The most batches that may be in flight at the same time.
inline constexpr std::uint32_t most_frames_in_flight = 8;

/// The techniques that need a device, of which a context makes pipelines for as many as it is asked
/// to. Technique::cpu needs none and is always there.
struct DeviceTechniques {
    bool raster = true;   ///< Technique::raster
    bool compute = true;  ///< Technique::compute
};

/// Limits and settings of a context. One that cannot be used is refused when the context is made
/// (StatusCode::invalid_settings).
struct Settings {
    std::uint32_t structure_size = sizeof(Settings);  ///< leave it as it is, see host.hpp
    /// How many batches may be submitted or recorded and not yet collected, 1 to
    /// `most_frames_in_flight`. Each has buffers of its own, made when they are first needed. For a
    /// host that records: its own number of frames in flight, times the batches of a frame.
    std::uint32_t frames_in_flight = 2;
    /// The most memory that images and results of a batch may need, device and host side together,
    /// in bytes. A batch that needs more is refused (StatusCode::too_large) before any work. Meshes
    /// and lists of edges, which grow with the shapes and not with the grid, come on top. Of
    /// several batches in flight each may need so much for its results; they share the images.
    std::uint64_t memory_limit = std::uint64_t{1} << 30U;
    /// Maximum height of the bounding-volume hierarchies that localise (section 2.1 of the paper):
    /// more is more work on the CPU and less on the device.
    std::uint32_t hierarchy_height = 12;
    /// What these hierarchies are made of; docs/performance.md has the effect of both.
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
    /// What Technique::automatic goes by, as Context::measure_costs found it on this machine; each
    /// time finite and at least 0. Left out: what holds for the device's class, see
    /// docs/performance.md.
    std::optional<CostModel> costs = std::nullopt;
    /// Threads of the host for what the CPU answers. What it points to is called for as long as the
    /// context lives. Left out: the thread that calls does all of it.
    JobSystem jobs = {};
    /// The techniques to make pipelines for, when the context is made; nothing is made for the
    /// others, Technique::automatic does not choose them, and a query that asks for one is refused
    /// (StatusCode::unsupported_technique). Without effect in a context without a device.
    DeviceTechniques techniques = {};
};

/// What an intersection strategy would need of a device and the device lacks.
struct StrategyReport {
    IntersectionStrategy strategy{};   ///< which one is told about
    std::vector<std::string> missing;  ///< empty: the strategy is available
};

/// One Vulkan device that can be used, and every reason why not where it cannot.
struct DeviceReport {
    std::string name;                  ///< as its driver gives it
    std::string driver;                ///< driver version and Vulkan version
    bool usable = false;               ///< nothing is missing
    std::vector<std::string> missing;  ///< what the base needs and the device lacks
    /// What more there may be (Requirements::optional).
    std::vector<OptionalPart> optional;
    /// Every strategy, for a headless context, which enables the features there are.
    std::vector<StrategyReport> strategies;
};

/// Every device of every installed driver, looked at without creating a device on any. An error
/// only where there is no Vulkan loader or instance. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::vector<DeviceReport>> list_devices();

/// Names a batch in flight of one context. The default value names none.
struct Ticket {
    std::uint64_t number = 0;  ///< counts a context's batches; 0: no batch

    /// Both name the same batch, in one context.
    friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// Device memory of one context (vkAllocateMemory), in bytes.
struct MemoryUse {
    std::uint64_t in_use = 0;  ///< now
    std::uint64_t peak = 0;    ///< the most there was at any time
};

/// How the render graph prints itself.
enum class GraphFormat {
    text,      ///< for people
    graphviz,  ///< a graph in the DOT language
};

/// Everything nearfield needs to answer queries, on one device or on the CPU alone.
///
/// A context is used by one thread at a time; several contexts are independent of each other, on
/// one device too, as long as their queues are not used at the same time (HostDevice::queue_access
/// sees to that).
///
/// Destroying a context waits for the batches that it submitted, for nothing else on the device,
/// and frees all it made. It does not wait for what was recorded: the device must have done that,
/// or never begin it. A command buffer with a batch of a context that is gone must not be
/// submitted; resetting or freeing it is all that is left to do with it.
///
/// After any error but device_lost a context goes on: the next batch is answered. Once the device
/// is lost it stays lost: whatever can fail says device_lost, and no more work goes to Vulkan;
/// destroy the context (that is still done properly) and make another on another device.
class NEARFIELD_EXPORT Context {
public:
    /// Adopts a host's device. Fails with every reason where the device does not suffice.
    [[nodiscard]] static Expected<Context> create(const HostDevice& host,
                                                  const Settings& settings = {});

    /// Makes an instance and a device of its own, with nothing to present to.
    [[nodiscard]] static Expected<Context> create_headless(const HeadlessOptions& options = {},
                                                           const Settings& settings = {});

    /// Makes a context without a device: no Vulkan loader is opened and no driver needed. It
    /// answers all that Technique::cpu answers, and Technique::automatic means that. A query that
    /// needs a device (raster, compute, resident, blended gradients) is refused in its own result
    /// (unsupported_technique). Fails with no_device: record(), reload_shaders(), and submit() with
    /// semaphores. Settings about devices have no effect.
    [[nodiscard]] static Expected<Context> create_cpu(const Settings& settings = {});

    ~Context();
    /// What is moved from can only be destroyed or assigned to.
    Context(Context&&) noexcept;
    /// Destroys what was there before.
    Context& operator=(Context&&) noexcept;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Copies the rings; refuses bad ones (invalid_shape). Needs no precomputation: a shape may be
    /// added in the frame it is used.
    ///
    /// `deviation`, in the units of the coordinates: how far the rings may be from the shape they
    /// stand for, as tessellate() (curve.hpp) bounds it; 0 where the rings are the shape. It is
    /// part of the error bound of every result that depends on the shape; a query whose shapes
    /// together deviate by more than `most_deviation` of its tolerance is refused (invalid_query).
    [[nodiscard]] Expected<ShapeHandle> add_shape(std::span<const Ring> rings,
                                                  double deviation = 0.0);

    /// Replaces all rings of a shape; the handle stays. Nothing is rebuilt, so deforming a shape
    /// every frame costs a copy. Batches in flight are answered for the rings they were submitted
    /// with. On error the shape keeps its former rings.
    Status update_shape(ShapeHandle shape, std::span<const Ring> rings, double deviation = 0.0);

    /// Forgets a shape. Its handle stays unknown for good. Batches in flight are answered as if it
    /// were still there.
    Status remove_shape(ShapeHandle shape);

    /// Finds the pairs of instances worth a query: those whose bounding boxes are at most `reach`
    /// apart along both axes (world units, >= 0; 0: the closed boxes meet). Replaces `pairs`, in
    /// ascending order. The time grows with the instances and with the pairs found.
    Status find_pairs(std::span<const Instance> instances, double reach,
                      std::vector<InstancePair>& pairs);

    /// Answers a batch; returns when all results are there: submit(), then collect(), so it fails
    /// with ring_full where all frames are in flight. An error of the batch as a whole is the
    /// returned status: too_large (more memory than the limit, or than one buffer of the device
    /// holds), out_of_memory, device_lost, device_error; the results are then undefined. What is
    /// wrong with one query alone (invalid_query, unknown_shape, unsupported_strategy) stands in
    /// that query's result, and the other queries are answered.
    Status run(const Batch& batch, Results& results);

    /// Answers one query: run() with a batch of one. What is wrong with the query is the returned
    /// status. A program with many queries a frame puts them into one Batch, which goes to the
    /// device once and keeps its memory.
    template <class Query>
    [[nodiscard]] Expected<typename ResultOf<Query>::type> answer(const Query& query) {
        Batch batch;
        const QueryHandle<Query> handle = batch.add(query);
        Results results;
        if (Status status = run(batch, results); !status.ok()) {
            return status;
        }
        auto& result = results[handle];
        return result.status.ok() ? Expected<typename ResultOf<Query>::type>(std::move(result))
                                  : result.status;
    }

    /// Sends a batch to the device and does not wait for it: localises, plans, records all of it
    /// into one command buffer and submits that to the queue; then answers what the CPU answers.
    /// Nothing is submitted where no query needs the device. Nothing of the batch is borrowed: it
    /// may be cleared, and shapes may be updated and removed, as soon as this returns.
    ///
    /// The device waits for the semaphores of `submission` before it works on the batch, and
    /// signals others when it is done. Where no query needs the device they are submitted without
    /// commands, so whatever is asked they are waited for and signalled once for every ticket; and
    /// not at all where there is an error.
    ///
    /// Fails with ring_full where Settings::frames_in_flight batches are not collected yet, with
    /// invalid_submission where a semaphore cannot be used (the message says which and why), and as
    /// run() does; there is no ticket then and nothing to collect.
    [[nodiscard]] Expected<Ticket> submit(const Batch& batch, const Submission& submission = {});

    /// Records a batch into a command buffer of the host, who submits it: nothing is submitted here
    /// and nothing waited for. What the device reads has been written, and flushed, when this
    /// returns; what it writes is made visible to the host by the last barrier recorded. So the
    /// host needs no barrier of its own before or after. Nothing is recorded where no query needs
    /// the device.
    ///
    /// Preconditions (validation layers see to them; the library cannot): `commands` is as
    /// Recording::commands says, it is submitted at most once after this, to HostDevice::queue (or
    /// through queue_access), and any other batch of this context goes to the same queue. In which
    /// order they get there makes no difference.
    ///
    /// Left behind in the command buffer: for both bind points (graphics and compute) another
    /// pipeline, descriptor set 0 and push constants; another vertex buffer at binding 0; other
    /// dynamic state (viewport 0, scissor 0, stencil compare mask, write mask and reference). The
    /// host sets anew what it needs. No render pass is open. No object of the host is touched, and
    /// no image of the library is left in a layout that matters.
    ///
    /// The batch is done when the host says so: frame_completed(), or recording for a frame that
    /// lies Settings::frames_in_flight ahead, which implies it. Until then its ticket is not ready.
    ///
    /// A query that takes a second submission is refused in its own result (not_recordable):
    /// contacts with gradient normals by the techniques raster and compute. Technique::automatic
    /// answers them on the CPU. There is room for all samples of intersections, however many.
    ///
    /// Fails with invalid_submission where `commands` is null or the frame is complete already, and
    /// as submit() does; nothing has been recorded then, and there is no ticket.
    [[nodiscard]] Expected<Ticket> record(const Batch& batch, const Recording& recording);

    /// The host says: the device has done everything of its frames up to this one, or will never do
    /// it. Batches recorded for them can be collected. Those whose commands were not executed after
    /// all say so then (not_executed). A smaller number than before changes nothing.
    void frame_completed(std::uint64_t frame) noexcept;

    /// True where collect() would not wait for what was submitted, or the frame is complete that a
    /// batch was recorded for; never waits. True too of a ticket that collect() refuses, and of all
    /// once the device is lost.
    [[nodiscard]] bool is_ready(Ticket ticket);

    /// Waits for one batch, not for those before or after it, and writes its results: the same, bit
    /// for bit, as run() would have written at the time of submit(). Tickets may be collected in
    /// any order, each once (unknown_ticket otherwise). Reusing the same objects for `results`
    /// keeps memory: they take turns with those of the frames in flight.
    ///
    /// What was recorded is never waited for: not_ready where its frame is not complete, and the
    /// ticket stays good; not_executed where it is complete and the device did not do it. After
    /// that the ticket is used up as after any other error.
    ///
    /// Two kinds of submitted batches go to the device again here, and wait: samples of
    /// intersections that were more than there was room for (more than an eighth of the cells and
    /// more than ever before in this context; the next batch has room), and contacts with gradient
    /// normals (ContactNormals::gradient), whose field can be asked for only where they are.
    /// Neither is so of what Technique::cpu answers.
    ///
    /// Fails as run() does; the ticket is used up all the same. Once the device is lost, every
    /// ticket in flight gives device_lost.
    Status collect(Ticket ticket, Results& results);

    /// What a query that was asked with `resident` leaves on the device: from submit() or record()
    /// until the batch is collected. The device has it once it has done the commands; resident.hpp
    /// says how a host's shaders read it. Never waits.
    ///
    /// Fails with unknown_ticket as collect() does; with invalid_query where the handle names no
    /// query of the batch of that kind, or one that was asked without `resident`; with the query's
    /// own status where it was refused, as one for Technique::cpu is; with device_lost once the
    /// device is lost.
    [[nodiscard]] Expected<ResidentField> resident(Ticket ticket,
                                                   QueryHandle<DistanceFieldQuery> query);
    /// The same of the records of a penetration.
    [[nodiscard]] Expected<ResidentRecords> resident(Ticket ticket,
                                                     QueryHandle<PenetrationQuery> query);
    /// The same of contacts.
    [[nodiscard]] Expected<ResidentRecords> resident(Ticket ticket,
                                                     QueryHandle<ContactQuery> query);
    /// The same of the samples of an intersection.
    [[nodiscard]] Expected<ResidentSamples> resident(Ticket ticket,
                                                     QueryHandle<IntersectionQuery> query);

    /// Runs every technique on small made-up workloads and measures what each takes, for
    /// Settings::costs of later contexts on the same machine; nothing changes in this one.
    /// Techniques that this context does not have keep their costs(). Takes
    /// seconds, during which nothing else should be busy there. `progress`, if given, is told the
    /// part that is done, up to 1. Needs room for a frame in flight (ring_full otherwise).
    [[nodiscard]] Expected<CostModel> measure_costs(
        const std::function<void(double)>& progress = {});

    /// What Technique::automatic goes by here.
    [[nodiscard]] const CostModel& costs() const noexcept;

    /// The device's name as its driver gives it; empty without a device.
    [[nodiscard]] const std::string& device_name() const noexcept;

    /// The device memory that this context has, and had at most.
    [[nodiscard]] MemoryUse memory_use() const noexcept;

    /// The render graph of the last batch submitted or recorded: passes, resources, lifetimes,
    /// barriers. Empty before the first batch; for a `format` that is no enumerator, a text that
    /// says so.
    [[nodiscard]] std::string describe_graph(GraphFormat format) const;

    /// The tiles that the last batch submitted or recorded was cut into, collected or not. Replaces
    /// `tiles`: in order of queries, and of a query in order of its points or row by row. Empty
    /// before the first batch, after one that failed as a whole, and where the CPU answered all.
    /// The field around contacts with gradient normals, a submission of its own, is left out.
    /// Batches that nobody asks about pay nothing for it. Fails with out_of_memory alone, where the
    /// host has no memory for the list.
    Status list_tiles(std::vector<TileReport>& tiles) const;

    /// For who works on the library's shaders: compiles those anew whose sources changed since
    /// this context had them last, and makes pipelines of what comes out otherwise than what is in
    /// use, which later batches use. Returns how many shaders that were; 0: all stays as it was.
    /// Waits for the compiler, the one that the library was built with, as a process of its own;
    /// the first call compiles all shaders, which takes seconds. The device is not waited for.
    ///
    /// `folder`: where the sources are; null: the folder that the library was built from.
    ///
    /// Fails with unavailable where the library was built without it, as release builds are (CMake
    /// option NEARFIELD_SHADER_RELOAD), which do not have a part of it; with not_ready while
    /// batches are in flight, which have to be collected first; with invalid_shader where a source
    /// cannot be read or compiled, with the compiler's words as reasons and in the log; as create()
    /// does where the device refuses a pipeline. All shaders in use stay in use then.
    [[nodiscard]] Expected<std::uint32_t> reload_shaders(const char* folder = nullptr);

private:
    class NEARFIELD_HIDDEN Implementation;
    explicit Context(std::unique_ptr<Implementation> implementation) noexcept;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace nearfield
