#pragma once

#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/query.hpp>
#include <nearfield/resident_pairs.hpp>
#include <nearfield/result.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world_pairs.hpp>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

/// \file
/// All pairs of a world, found and examined by the device.

namespace nearfield {

/// The parts of a DevicePairTable that do not depend on the kind of its query.
class NEARFIELD_EXPORT DevicePairTableBase {
public:
    /// The number of rows.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// The number of pairs whose bounding boxes overlap, as the device computes them.
    [[nodiscard]] std::uint32_t candidates() const noexcept;
    /// The number of candidates that the CPU answered during the last update.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;

    /// Of the last update. `plan`: what has changed is uploaded; `device`: the wait; `decode`:
    /// pairs that the CPU answered; `total`: of both halves, without what is between them.
    [[nodiscard]] const Timings& timings() const noexcept;

    /// Waits for the device after World::submit(), has the CPU answer the pairs that are left to
    /// it, and fills the rows. Submits again, and waits, where there was no room for all pairs; the
    /// memory has grown then. Fails with not_ready if nothing was submitted; otherwise as
    /// World::update().
    ///
    /// After World::record(), neither submits nor waits, and may be called again (DevicePairTable).
    /// Fails with not_ready if the frame is not complete, with not_executed if the device has not
    /// executed the commands, and with overflow if there was no room for all pairs; the reasons
    /// then say of what there were more. The table has no rows after an error, and what was
    /// recorded stays as it is.
    Status collect(const Limits& limits = {});
    /// True if the device has finished what World::submit() began, or if the frame of
    /// World::record() is complete; never waits. Also true once the device is lost. False if
    /// nothing was submitted or recorded.
    [[nodiscard]] bool is_ready() const noexcept;

    /// What the device leaves for the host's shaders, if the query is resident; see ResidentPairs
    /// for how long. Fails with invalid_query if it is not, with not_ready if nothing was submitted
    /// or recorded, or the world has fewer than two instances.
    [[nodiscard]] Expected<ResidentPairs> resident() const;

protected:
    /// A table without rows; see DevicePairTable. The query is one of those that it has.
    DevicePairTableBase(const AnyQuery& query, double reach);
    ~DevicePairTableBase();
    /// Takes the contents of another table, which can then only be destroyed or assigned to.
    DevicePairTableBase(DevicePairTableBase&&) noexcept;
    /// Likewise.
    DevicePairTableBase& operator=(DevicePairTableBase&&) noexcept;

    /// Reads a row.
    Status read(std::uint32_t index, PairRow<PenetrationQuery>& row);
    /// Likewise.
    Status read(std::uint32_t index, PairRow<ContactQuery>& row);
    /// Likewise.
    Status read(std::uint32_t index, PairRow<IntersectionTestQuery>& row);
    /// Likewise.
    Status read(std::uint32_t index, PairRow<ClosestPointQuery>& row);
    /// Likewise.
    Status read(std::uint32_t index, PairRow<SeparationQuery>& row);
    /// Reads the records of a row.
    Status read(std::uint32_t index, std::vector<PenetrationRecord>& records);
    /// Likewise.
    Status read(std::uint32_t index, std::vector<ContactRecord>& records);
    /// Fails: there are none.
    Status read(std::uint32_t index, std::vector<NoRecord>& records);
    /// Reads the manifold of a row.
    Status read(std::uint32_t index, std::vector<ContactCluster>& manifold);

private:
    friend class World;
    struct NEARFIELD_HIDDEN State;
    std::unique_ptr<State> state_;
};

/// Queries whose answer is a distance.
template <class Query>
concept HasDistance = requires(const typename Query::Result& result) {
    result.distance;
};

/// One query of all pairs of instances in a world, answered by the device: PenetrationQuery,
/// ContactQuery, IntersectionTestQuery, SeparationQuery or ClosestPointQuery. Boxes, pairs and what
/// is asked about them are computed there (Technique::compute). The CPU's time in World::update()
/// grows with the number of instances that have moved and with that of pairs left to it, not with
/// the number of pairs. A row is made exact, in double precision, when it is read.
///
/// Only pairs that are hit have a row, in ascending order of the pairs, in the order in which their
/// instances were added: by `a`, then by `b`. Filters apply (WorldInstance). Where single precision
/// cannot decide, the CPU answers the pair.
///
/// Penetrations: one row per ordered pair of which `a` has a point that penetrates `b`. A pair
/// whose boundaries cross without such a point, where they overlap by less than the samples tell,
/// has no row. Rows agree with those of a PairTable as the answers of two techniques do
/// (Technique).
///
/// Contacts: two rows per pair that has contacts or intersects, each instance being `a` once, as in
/// a PairTable with `hits_only`, with which rows agree as the answers of two techniques do. Normals
/// are analytic.
///
/// Intersection tests: one row per pair that intersects, with the instance added first as `a`: the
/// same pairs as in a PairTable with `hits_only`.
///
/// Separations and closest points: a row for each pair that intersects or is at most `reach` apart,
/// the same as in a PairTable with that reach and `hits_only`: of separations one, with the
/// instance added first as `a`, of closest points two. The device finds the pairs; a row that is
/// read is answered by the CPU.
///
/// Limits: 2^18 instances, and some 50,000 instances whose boxes overlap with that of a single one;
/// World::update() fails (too_large) beyond these, where what is found of all pairs needs more
/// memory than Settings::memory_limit, and where the pairs of one instance, or results that stay on
/// the device, need more of one buffer than the device's shaders reach. Where all pairs at once
/// need more than either, the device searches them in parts, one after the other, with the same
/// rows; of contacts that takes up to twice as long.
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
///   leaves resident results. It waits for what the execution before, and the host's shaders after
///   that (ResidentState), have read. A pose that is none is taken for (0, 0), not turned.
/// - collect() fills the rows from the last execution, each time it is called. The device must not
///   execute the commands during this call, nor while rows are read.
/// - Where memory is too small, nothing searches again: the headers of resident results say so
///   (`overflow`), and collect() fails. The next call of World::record() makes room for what was
///   found, collected or not; later steps of the search have not seen what earlier ones had no room
///   for, so that up to five calls can be needed. World::update() makes room for all at once, and
///   orders the instances by the poses on the device, which makes later searches faster.
/// - What was recorded, with all handles of resident results, holds until the table is recorded,
///   submitted or updated again, successfully or not, unless that fails with not_ready or
///   invalid_submission; until the table is destroyed or assigned to; and until reload_shaders().
///   By then the device must be done with it. Whatever happens to the world, its shapes or
///   Context::trim() changes nothing about it: World::is_recorded() tells whether it is still about
///   the world as it is.
/// - Until the frame that it was recorded for is complete, the table cannot be recorded, submitted
///   or updated again (not_ready). Later submissions of the commands are not known to the library.
///
/// Used with one world at a time; a table that comes to another world starts anew. It keeps its
/// memory, on the device too, from update to update, and holds the world's shapes as they were at
/// the last update.
///
/// Threads: as for the world. Lifetime: the world's context must outlive the table. A table
/// that is destroyed before it is collected waits for the device, but not for what was recorded.
template <class Query>
class DevicePairTable : public DevicePairTableBase {
public:
    using Row = PairRow<Query>;                     ///< `first_record` is 0
    using Record = typename Query::Result::Record;  ///< what a row has several of; see the result

    /// A table without rows. `a` and `b` of the query are ignored. Its technique is
    /// Technique::compute, or automatic, which means the same; the others are rejected by
    /// World::update(), as are targets (PenetrationQuery::target).
    explicit DevicePairTable(const Query& query) : DevicePairTableBase(query, 0.0), query_(query) {}
    /// The same for separations and closest points of shapes that are farther apart. `reach`: world
    /// units, >= 0.
    DevicePairTable(const Query& query, double reach) requires HasDistance<Query>
        : DevicePairTableBase(query, reach), query_(query) {}

    /// The query, as it was given.
    [[nodiscard]] const Query& query() const noexcept { return query_; }

    /// The answer for one pair, made exact now; fails (invalid_query) if there are fewer rows.
    /// `row.record_count` is 0 if the query does without records.
    [[nodiscard]] Expected<Row> row(std::uint32_t index) {
        Row row;
        Status status = read(index, row);
        return status.ok() ? Expected<Row>(row) : status;
    }
    /// Replaces `records` by those of a row, in the order of the query's result; also fails
    /// (invalid_query) if the query does without records.
    Status records(std::uint32_t index, std::vector<Record>& records) {
        return read(index, records);
    }
    /// Of contacts: replaces `manifold` by that of a row (ContactResult::manifold).
    Status manifold(std::uint32_t index, std::vector<ContactCluster>& manifold) requires
        std::is_same_v<Query, ContactQuery> {
        return read(index, manifold);
    }

private:
    Query query_;
};

}  // namespace nearfield
