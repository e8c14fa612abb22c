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
/// One query of the pairs of a world, asked again frame after frame.

namespace nearfield {

struct PairsOnDevice;

/// Which pairs a PairTable asks about, which of them have a row, and who answers.
struct PairTableOptions {
    /// Pairs of instances whose bounding boxes are at most this far apart along both axes are
    /// candidates: world units, >= 0; 0: the closed boxes overlap. Up to the rounding of their
    /// vertices: shapes touch up to that, and no touching pair is lost. The contact distance of a
    /// query that has one counts if it is larger. With `hits_only` the reach matters to separations
    /// and closest points alone, as no other pair that is farther apart is hit. Filters apply
    /// (WorldInstance).
    double reach = 0.0;
    /// True: the table has only the pairs that are hit. Of penetrations these are the ones of which
    /// `a` has a penetrating point; of contacts those that have one or intersect; of separations
    /// and closest points those that intersect or are at most `reach` apart; of containment those
    /// with `a` inside `b`; of times of impact those that are not ImpactState::separated; of other
    /// queries those that intersect; and of all queries those whose status is an error.
    /// False: all candidates.
    bool hits_only = false;
    /// True: the pairs are those that each update is given (PairTableInput::a and b), in that
    /// order, in either order of their instances, and again as often as they are named, whatever
    /// their boxes and filters. The query is not TimeOfImpactQuery.
    bool listed = false;
    /// Who answers: Technique::cpu or Technique::compute. Rows are the same, as answers of the two
    /// techniques are (Technique). Technique::automatic leaves it to the query's own technique, and
    /// if that is automatic, too, takes compute where nothing else can: if the query is resident,
    /// if the poses are the host's (DevicePoses), or if commands are recorded; and otherwise on a
    /// hardware device, for what compute answers; else cpu.
    Technique technique = Technique::automatic;
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
    std::uint32_t index = 0;        ///< its place among the rows of its table
    std::uint32_t point_count = 0;  ///< the number of PairTable::points()
};

/// The parts of a PairTable that do not depend on the kind of its query.
class NEARFIELD_EXPORT PairTableBase {
public:
    /// Which pairs are asked about, and who answers.
    [[nodiscard]] const PairTableOptions& options() const noexcept;
    /// The number of rows.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// The number of candidates at the last update, hit or not, as the CPU or the device computes
    /// their boxes; of a list, of its pairs. Both orders of a pair count where both have a row.
    [[nodiscard]] std::uint32_t candidates() const noexcept;
    /// How many of them the last update had the CPU answer: those of which something has changed,
    /// or, by Technique::compute, those that single precision cannot decide.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;
    /// Of the last update. `plan`: pairs are found on the CPU, or what has changed is uploaded;
    /// `device`: the wait; `decode`: pairs that the CPU answered; `total`: of both halves, without
    /// what is between them.
    [[nodiscard]] const Timings& timings() const noexcept;

    /// Makes the rows of what World::submit() began: waits for the device, has the CPU answer the
    /// pairs that are left to it, and, where there was no room for all pairs, submits again and
    /// waits; the memory has grown then. By Technique::cpu the pairs have been answered already.
    /// Fails with not_ready if nothing was submitted; otherwise as World::update().
    ///
    /// After World::record(), neither submits nor waits, and may be called again (PairTable). Fails
    /// with not_ready if the frame is not complete, with not_executed if the device has not
    /// executed the commands, and with overflow if there was no room for all pairs; the reasons
    /// then say of what there were more. The table has no rows after an error, and what was
    /// recorded stays as it is.
    Status collect(const Limits& limits = {});
    /// True if collect() would not wait for what World::submit() began, or if the frame of
    /// World::record() is complete; never waits. Also true once the device is lost. False if
    /// nothing was submitted or recorded.
    [[nodiscard]] bool is_ready() const noexcept;

    /// What the device leaves for the host's shaders, if the query is resident; see PairsOnDevice
    /// (pairs_on_device.hpp) for how long. Fails with invalid_query if it is not, with not_ready if
    /// nothing was submitted or recorded, or the world has fewer than two instances.
    [[nodiscard]] Expected<PairsOnDevice> on_device() const;

    /// Why a span of rows, points or clusters is empty that should not be: host memory ran out
    /// where they were made exact. Success since the last update or collect() otherwise.
    [[nodiscard]] const Status& read_status() const noexcept;

protected:
    struct NEARFIELD_HIDDEN State;
    explicit PairTableBase(std::unique_ptr<State> state) noexcept;  ///< of one kind of query
    ~PairTableBase();
    /// Takes the contents of another table, which can then only be destroyed or assigned to.
    PairTableBase(PairTableBase&&) noexcept;
    /// Likewise.
    PairTableBase& operator=(PairTableBase&&) noexcept;

    friend class World;
    std::unique_ptr<State> state_;  ///< never null, unless moved from
};

/// One query of pairs of instances in a world: PenetrationQuery, ContactQuery, IntersectionQuery,
/// ClosestPointQuery, SeparationQuery, IntersectionTestQuery, SeparationVectorQuery,
/// ContainmentQuery or TimeOfImpactQuery. World::update() brings the table up to date.
///
/// The pairs are found by their boxes, or given as a list (PairTableOptions::listed). Of pairs that
/// are found, separations, intersection tests and times of impact have one row, with the instance
/// added first as `a`; the other queries have two, each instance being `a` once. Rows are in
/// ascending order of the pairs, in the order in which their instances were added: by `a`, then by
/// `b`. Rows of a list are in its order.
///
/// Times of impact: PairTableInput says where instances move to. Bounding boxes are then those of
/// the whole motions, turns included, so that no impact is missed; of two that stand still, the row
/// says whether they touch.
///
/// By Technique::cpu, a pair that was found and neither of whose instances has moved or deformed
/// since the last update, nor moves otherwise, keeps its row. The rows are the same, bit for bit,
/// as in a new table, and as the answers to queries of the pairs one by one (Context::answer()).
///
/// By Technique::compute the device finds the pairs and answers the query: PenetrationQuery;
/// ContactQuery with analytic normals; IntersectionTestQuery; of SeparationQuery and
/// ClosestPointQuery, which pairs have a row. Only hits have rows: a table of all candidates, or of
/// a list, is refused (invalid_query). The CPU's time in World::update() grows with the number of
/// instances that have moved and with that of pairs left to it, not with the number of pairs. What
/// is read is made exact then, in double precision, or answered by the CPU: one row by row(), or
/// all by rows(), which are kept until the next update. Results are those of Technique::cpu as the
/// answers of two techniques are (Technique); intersection tests, separations and closest points
/// have the same rows.
///
/// Limits of Technique::compute: 2^18 instances, and some 50,000 instances whose boxes overlap with
/// that of a single one; World::update() fails (too_large) beyond these, where what is found of all
/// pairs needs more memory than Settings::memory_limit, and where the pairs of one instance, or
/// results that stay on the device, need more of one buffer than the device's shaders reach. Where
/// all pairs at once need more than either, the device searches them in parts, one after the other,
/// with the same rows; of contacts that takes up to twice as long.
///
/// World::update() waits for the device. A frame that has other work for the CPU calls
/// World::submit() first and collect() after that work; what needs the rows of the frame before
/// meanwhile has two tables, in turns.
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
/// - The same commands may be submitted any number of times, if their command buffer was begun so;
///   the library does no work in between. Each execution finds the pairs of the instances, shapes
///   and filters that were recorded at the poses that are then in the buffer of DevicePoses, and
///   leaves results on the device. It waits for what the execution before, and the host's shaders
///   after that (OutputState), have read. A pose that is none is taken for (0, 0), not turned.
/// - collect() makes the rows from the last execution, each time it is called. The device must not
///   execute the commands during this call, nor while rows are read.
/// - Where memory is too small, nothing searches again: the headers of results on the device say so
///   (`overflow`), and collect() fails. The next call of World::record() makes room for what was
///   found, collected or not; later steps of the search have not seen what earlier ones had no room
///   for, so that up to five calls can be needed. World::update() makes room for all at once, and
///   orders the instances by the poses on the device, which makes later searches faster.
/// - What was recorded, with all handles of results on the device, holds until the table is
/// recorded,
///   submitted or updated again, successfully or not, unless that fails with not_ready or
///   invalid_submission; until the table is destroyed or assigned to; and until reload_shaders().
///   By then the device must be done with it. Whatever happens to the world, its shapes or
///   Context::trim() changes nothing about it: World::is_recorded() tells whether it is still about
///   the world as it is.
/// - Until the frame that it was recorded for is complete, the table cannot be recorded, submitted
///   or updated again (not_ready). Later submissions of the commands are not known to the library.
///
/// Used with one world at a time; a table that comes to another world starts anew. It keeps its
/// memory, on the device too, from update to update, and describes the world as it was at the last
/// one.
///
/// Threads: as for the world. Lifetime: the world's context must outlive the table. A table
/// that is destroyed before it is collected waits for the device, but not for what was recorded.
template <class Query>
class NEARFIELD_EXPORT PairTable : public PairTableBase {
public:
    using Point = typename Query::Result::Point;  ///< what a row has several of; see the result

    /// A table without rows. Of the query, `a` and `b` are ignored, as are the end poses of a time
    /// of impact. Its technique is that of the options, or automatic; targets
    /// (PenetrationQuery::target) are rejected by World::update().
    explicit PairTable(const Query& query, const PairTableOptions& options = {});

    /// The query, as it was given.
    [[nodiscard]] const Query& query() const noexcept { return query_; }

    /// All rows, until the next update. See read_status().
    [[nodiscard]] std::span<const PairRow<Query>> rows() noexcept;
    /// One row; fails (invalid_query) if there are fewer. Makes no other exact.
    [[nodiscard]] Expected<PairRow<Query>> row(std::uint32_t index);
    /// The points of a row of this table, in the order of the query's result; none if the query
    /// does without. Valid until the next call of this function and the next update. See
    /// read_status().
    [[nodiscard]] std::span<const Point> points(const PairRow<Query>& row) noexcept;
    /// Of contacts: the manifold of a row (ContactResult::manifold), also where the query asks
    /// for the summary alone. Valid as long as points().
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
