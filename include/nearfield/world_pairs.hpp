#pragma once

#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

/// \file
/// One query for pairs of a world, answered frame after frame.

namespace nearfield {

struct PairsOnDevice;

/// Numbers of a search of the device for the pairs of a table.
struct PairTableCounts {
    /// Pairs whose boxes overlap; both orders of a pair count where both may have a row.
    std::uint32_t pairs = 0;
    std::uint32_t points = 0;         ///< near or inside the other shape of a pair
    std::uint32_t rows = 0;           ///< pairs that are hit, or may be
    std::uint32_t edge_groups = 0;    ///< of up to eight edges, near the other shape's box
    std::uint32_t edges = 0;          ///< of these groups, near the other shape's box
    std::uint32_t tested_points = 0;  ///< of these edges; `points` of them are near or inside

    /// True if all members are equal.
    friend bool operator==(const PairTableCounts&, const PairTableCounts&) = default;
};

/// The pairs of a PairTable, those of them that have a row, and the technique.
struct PairTableOptions {
    /// Pairs of instances whose boxes are at most this many world units apart along both axes are
    /// candidates: finite, >= 0; 0: the closed boxes overlap. The boxes include the rounding
    /// of their vertices, so no touching pair is lost. If the query has a larger contact distance,
    /// that counts. With `hits_only` the reach matters only for separations and closest points,
    /// because no other pair that is farther apart is hit. Filters apply (WorldInstance).
    double reach = 0.0;
    /// True: only pairs that are hit have a row. Penetrations are hit if `a` has a penetrating
    /// point; contacts if there is one or the shapes intersect; separations and closest points if
    /// the shapes intersect or are at most `reach` apart; containment if `a` is inside `b`; times
    /// of impact if they are not ImpactState::separated; other queries if the shapes intersect.
    /// Pairs whose status is an error have a row, too. False: all candidates have a row.
    bool hits_only = false;
    /// True: each update passes the pairs (PairTableInput::a and b). Rows have their order. A pair
    /// may be repeated and may name its instances in either order; boxes and filters do not matter.
    /// Not allowed for TimeOfImpactQuery.
    bool listed = false;
    /// The technique: Technique::cpu or Technique::compute. Rows agree as the answers of two
    /// techniques do (Technique). Technique::automatic stands for the query's own technique. If
    /// that is automatic, too, it is compute where only a device can answer: if the query's results
    /// stay on the device, if the poses are the host's (DevicePoses), or if commands are recorded.
    /// Otherwise compute on a hardware device for what it answers, else cpu; for a list always cpu.
    Technique technique = Technique::automatic;
    /// Technique::compute: the device has memory for at least these numbers before the first
    /// search. PairTable::found() of another table is a good value. If one of the last three is 0,
    /// it follows from the others: 4 groups and 8 edges per pair, 4 tested points per point.
    PairTableCounts reserve = {};
    /// Technique::compute: a factor, 1 to 1024. Recorded commands cannot search again, so
    /// World::record() provides memory for this many times what the previous search found. Where it
    /// has to grow, it at least doubles (if the factor is above 1), and does not wait.
    double headroom = 1.5;
};

/// One row of a PairTable: the answer to its query for one pair.
template <class Query>
struct PairRow : Query::Result::Values {
    InstanceHandle a;  ///< the query's `a`
    InstanceHandle b;  ///< the query's `b`
    /// Of this pair alone; if it is an error, ignore the rest. Context::answer() with the two
    /// instances returns the message.
    StatusCode status = StatusCode::ok;
    bool intersects = false;        ///< as ResultSummary::intersects
    double error_bound = 0.0;       ///< as ResultSummary::error_bound
    std::uint32_t index = 0;        ///< its position among the rows of its table
    std::uint32_t point_count = 0;  ///< the number of PairTable::points()
};

/// The parts of a PairTable that do not depend on the kind of its query.
class NEARFIELD_EXPORT PairTableBase {
public:
    /// The options that the table was made with.
    [[nodiscard]] const PairTableOptions& options() const noexcept;
    /// The number of rows.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// The number of candidates at the last update, hit or not, by the boxes of the CPU or the
    /// device; for a list, the number of its pairs. Both orders of a pair count where both have a
    /// row.
    [[nodiscard]] std::uint32_t candidates() const noexcept;
    /// The number of candidates that the CPU answered at the last update: pairs that have changed
    /// or, by Technique::compute, pairs found that single precision cannot decide; 0 for a list.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;
    /// By Technique::compute, what the last search found. For recorded commands that is the last
    /// execution that the device has finished, collected or not, even while it executes others. If
    /// a number exceeds capacity(), the numbers of later steps may be too low. Zeros before the
    /// first search, from World::submit() until collect(), and from World::record() until the
    /// device has executed the commands.
    [[nodiscard]] PairTableCounts found() const noexcept;
    /// By Technique::compute, the numbers that there is room for on the device; of rows and points
    /// at most those that a target (PairTarget) has space for.
    [[nodiscard]] PairTableCounts capacity() const noexcept;
    /// Frees all memory of the device, and drops the rows. The next search has memory for twice
    /// what the last one found. Does nothing from World::submit() until collect(), and until the
    /// frame of World::record() is complete; by then the device must be done with the commands.
    void trim() noexcept;
    /// The times of the last update. `plan`: finding pairs on the CPU, or the upload of what has
    /// changed; `device`: the wait; `decode`: pairs that the CPU answered; `total`: both halves,
    /// without the time between them.
    [[nodiscard]] const Timings& timings() const noexcept;

    /// Completes what World::submit() began: waits for the device, answers the undecided pairs on
    /// the CPU and makes the rows. If the memory was too small for all pairs, it grows, and the
    /// search is submitted and waited for again. By Technique::cpu the pairs have been answered
    /// already. Fails with not_ready if nothing was submitted; otherwise as World::update().
    ///
    /// If a target (PairTarget) is too small, it fails with overflow, and the table has all its
    /// rows nevertheless.
    ///
    /// After World::record() it neither submits nor waits, and may be called again (PairTable). It
    /// fails with not_ready if the frame is not complete, with not_executed if the device has not
    /// executed the commands, and with overflow if the memory was too small for all pairs; the
    /// reasons then name what exceeded it. The table has no rows after such an error, and the
    /// recorded commands stay valid.
    Status collect(const Limits& limits = {});
    /// True if collect() would not wait for what World::submit() began, or if the frame of
    /// World::record() is complete; never waits. Also true once the device is lost. False if
    /// nothing was submitted or recorded.
    [[nodiscard]] bool is_ready() const noexcept;

    /// The results on the device, for the host's shaders, if the query has `on_device`;
    /// PairsOnDevice (pairs_on_device.hpp) states how long they are valid. Fails with invalid_query
    /// if it has not, with not_ready if nothing was submitted or recorded, or the world has fewer
    /// than two instances.
    [[nodiscard]] Expected<PairsOnDevice> on_device() const;

    /// The reason why a span of rows, points or clusters is empty although it should not be: host
    /// memory ran out while they were made exact. Success otherwise, since the last update or
    /// collect().
    [[nodiscard]] const Status& read_status() const noexcept;

protected:
    struct NEARFIELD_HIDDEN State;
    explicit PairTableBase(std::unique_ptr<State> state) noexcept;  ///< of one kind of query
    ~PairTableBase();
    /// Takes the contents of another table, which can then only be destroyed or assigned to.
    PairTableBase(PairTableBase&&) noexcept;
    /// Drops its own contents and takes those of another table.
    PairTableBase& operator=(PairTableBase&&) noexcept;

    friend class World;
    std::unique_ptr<State> state_;  ///< never null, unless moved from
};

/// One query of pairs of instances in a world: PenetrationQuery, ContactQuery, IntersectionQuery,
/// ClosestPointQuery, SeparationQuery, IntersectionTestQuery, SeparationVectorQuery,
/// ContainmentQuery or TimeOfImpactQuery. World::update() brings the table up to date.
///
/// The pairs are found by their boxes, or given as a list (PairTableOptions::listed). A pair that
/// is found has one row for separations, intersection tests and times of impact, with the instance
/// added first as `a`; for other queries it has two, each instance being `a` once. Rows are in the
/// order in which instances were added: by `a`, then by `b`. Rows of a list are in its order.
///
/// Times of impact: PairTableInput has the poses that instances move to. Bounding boxes are then
/// those of the whole motions, turns included, so that no impact is missed. If both instances stand
/// still, the row says whether they touch.
///
/// By Technique::cpu, a pair that was found keeps its row as long as neither instance moves or
/// deforms. The rows are the same, bit for bit, as in a new table, and as the answers to queries of
/// the pairs one by one (Context::answer()).
///
/// By Technique::compute the device finds the pairs and answers PenetrationQuery, ContactQuery with
/// analytic normals, and IntersectionTestQuery. For SeparationQuery and ClosestPointQuery it
/// decides which pairs have a row. Only hits have rows: a table of all candidates is refused
/// (invalid_query). A list is answered as a batch is, hits or not: submit() waits for the device,
/// where nothing stays. The CPU's time in World::update() grows with the number of instances that
/// have moved and of pairs that the device could not decide, not with the number of pairs. The CPU
/// makes rows exact in double precision when they are read: one by row(), or all by rows(), which
/// are kept until the next update. Results agree with Technique::cpu's as the answers of two
/// techniques do (Technique); intersection tests, separations, closest points have the same rows.
///
/// Limits of Technique::compute: 2^18 instances, and some 50,000 instances whose boxes overlap that
/// of a single one. World::update() fails (too_large) beyond these, if the results of all pairs
/// need more memory than Settings::memory_limit, and if the pairs of one instance, or results that
/// stay on the device, need a larger buffer than the device's shaders can address. If all pairs at
/// once need more than either, the device searches them in parts, one after the other, with the
/// same rows; for contacts that takes up to twice as long.
///
/// World::update() waits for the device. A frame that has other work for the CPU calls
/// World::submit() first and collect() after that work. Two tables, used in turns, keep the rows of
/// the previous frame readable meanwhile.
///
/// Poses are the world's, or those that the host's commands write on the device (DevicePoses): rows
/// are exact at these too.
///
/// A host that submits for itself calls World::record(), submits its command buffer, and calls
/// collect() once it has said that the frame is complete (Context::frame_completed()):
/// - Synchronisation is as with Context::record(): the same queue, and no barrier of the host's
///   before or after, but for its poses (DevicePoses). What changes in the command buffer, primary
///   or secondary, is the compute pipeline, its descriptor set 0 and its push constants. With fewer
///   than two instances nothing is recorded.
/// - The same commands may be submitted any number of times, if the command buffer allows it; the
///   library does no work in between. Each execution finds the pairs of the instances, shapes and
///   filters that were recorded at the poses that are then in the buffer of DevicePoses, and leaves
///   results on the device. It waits for what the execution before, and the host's shaders after
///   that (OutputState), have read. An invalid pose counts as (0, 0), not turned.
/// - collect() makes the rows from the last execution, each time it is called. The device must not
///   execute the commands during this call, nor while rows are read.
/// - Where memory is too small, nothing searches again: the headers of results on the device say so
///   (`overflow`), collect() fails, and found() has the numbers. The next call of World::record()
///   at least doubles what was too small, collected or not, and what comes later in proportion.
///   PairTableOptions::headroom lets memory grow before that, `reserve` before anything was found.
///   World::update() grows all memory at once, and orders the instances by the poses on the device,
///   which makes later searches faster.
/// - What was recorded, with all handles of results on the device, holds until the table is
///   recorded, submitted or updated again, successfully or not, unless that fails with not_ready or
///   invalid_submission; until the table is destroyed or assigned to; and until reload_shaders().
///   By then the device must be done with it. Changes of the world and its shapes, and
///   Context::trim(), do not affect it; World::is_recorded() tells whether it still describes the
///   world.
/// - Until the frame that it was recorded for is complete, the table cannot be recorded, submitted
///   or updated again (not_ready). Later submissions of the commands are not known to the library.
///
/// A table is used with one world at a time; with another world it starts anew. It keeps its
/// memory, on the device too, from update to update, and describes the world as it was at the last
/// one.
///
/// Threads: as for the world. Lifetime: a table keeps what it needs of the world's context. A table
/// that is destroyed before it is collected waits for the device, but not for what was recorded.
template <class Query>
class NEARFIELD_EXPORT PairTable : public PairTableBase {
public:
    using Point = typename Query::Result::Point;  ///< what a row has several of; see the result

    /// A table without rows. The query's `a` and `b` are ignored, and so are the end poses of a
    /// time of impact. Its technique is that of the options, or automatic. World::update() rejects
    /// targets of the query (PenetrationQuery::target); those of a table are
    /// PairTableInput::target.
    explicit PairTable(const Query& query, const PairTableOptions& options = {});

    /// The query, as it was given.
    [[nodiscard]] const Query& query() const noexcept { return query_; }

    /// All rows, until the next update. See read_status().
    [[nodiscard]] std::span<const PairRow<Query>> rows() noexcept;
    /// One row; fails (invalid_query) if there are fewer. Makes no other row exact.
    [[nodiscard]] Expected<PairRow<Query>> row(std::uint32_t index);
    /// The points of a row of this table, in the order of the query's result; none if the query has
    /// `summary_only`. Valid until the next call of this function and the next update. See
    /// read_status().
    [[nodiscard]] std::span<const Point> points(const PairRow<Query>& row) noexcept;
    /// For contacts, the manifold of a row (ContactResult::manifold), also with `summary_only`.
    /// Valid as long as points().
    [[nodiscard]] std::span<const ContactCluster> manifold(
        const PairRow<Query>& row) noexcept requires std::is_same_v<Query, ContactQuery>;

private:
    struct NEARFIELD_HIDDEN Rows;
    [[nodiscard]] Rows& state() const noexcept;

    Query query_;
};

extern template class PairTable<PenetrationQuery>;
extern template class PairTable<ContactQuery>;
extern template class PairTable<IntersectionQuery>;
extern template class PairTable<ClosestPointQuery>;
extern template class PairTable<SeparationQuery>;
extern template class PairTable<IntersectionTestQuery>;
extern template class PairTable<SeparationVectorQuery>;
extern template class PairTable<ContainmentQuery>;
extern template class PairTable<TimeOfImpactQuery>;

}  // namespace nearfield
