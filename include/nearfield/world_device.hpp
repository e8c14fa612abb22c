#pragma once

#include <nearfield/export.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world_pairs.hpp>

#include <cstdint>
#include <memory>
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

    /// Of the last update. `plan`: what has changed is uploaded; `device`: from submission until
    /// the end of the wait; `decode`: pairs that the CPU answered.
    [[nodiscard]] const Timings& timings() const noexcept;

protected:
    struct NEARFIELD_HIDDEN State;

    /// A table without rows.
    explicit DevicePairTableBase(std::unique_ptr<State> state) noexcept;
    ~DevicePairTableBase();
    /// Takes the contents of another table, which can then only be destroyed or assigned to.
    DevicePairTableBase(DevicePairTableBase&&) noexcept;
    /// Likewise.
    DevicePairTableBase& operator=(DevicePairTableBase&&) noexcept;

    /// What the table holds.
    [[nodiscard]] State& state() const noexcept { return *state_; }

private:
    friend class World;
    std::unique_ptr<State> state_;
};

/// One query of all pairs of instances in a world, answered by the device: PenetrationQuery or
/// IntersectionTestQuery. Boxes, pairs and what is asked about them are computed there
/// (Technique::compute). The CPU's time in World::update() grows with the number of instances that
/// have moved and with that of pairs left to it, not with the number of pairs. A row is made exact,
/// in double precision, when it is read.
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
/// Intersection tests: one row per pair that intersects, with the instance added first as `a`: the
/// same pairs as in a PairTable with `hits_only`.
///
/// Used with one world at a time; a table that comes to another world starts anew. It keeps its
/// memory, on the device too, from update to update, and holds the world's shapes as they were at
/// the last update.
///
/// Threads: as for the world. Lifetime: the world's context must outlive the table.
template <class Query>
class NEARFIELD_EXPORT DevicePairTable : public DevicePairTableBase {
public:
    using Row = PairRow<Query>;                     ///< `first_record` is 0
    using Record = typename Query::Result::Record;  ///< what a row has several of; see the result

    /// A table without rows. `a` and `b` of the query are ignored. Its technique is
    /// Technique::compute, or automatic, which means the same; the others are rejected by
    /// World::update(), as are resident results.
    explicit DevicePairTable(const Query& query);

    /// The query, as it was given.
    [[nodiscard]] const Query& query() const noexcept { return query_; }

    /// The answer for one pair, made exact now; fails (invalid_query) if there are fewer rows.
    /// `row.record_count` is 0 if the query does without records.
    [[nodiscard]] Expected<Row> row(std::uint32_t index);
    /// Replaces `records` by those of a row, in order along the rings of `a`; also fails
    /// (invalid_query) if the query does without records.
    Status records(std::uint32_t index, std::vector<Record>& records);

private:
    Query query_;
};

extern template class DevicePairTable<PenetrationQuery>;
extern template class DevicePairTable<IntersectionTestQuery>;

}  // namespace nearfield
