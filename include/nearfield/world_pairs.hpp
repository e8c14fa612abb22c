#pragma once

#include <nearfield/export.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/status.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// \file
/// One query of all pairs of a world, asked again frame after frame.

namespace nearfield {

/// The pairs of a world that a PairTable asks about.
struct PairSelection {
    /// Pairs of instances whose bounding boxes are at most this far apart along both axes are
    /// candidates: world units, >= 0; 0: the closed boxes overlap. Up to the rounding of their
    /// vertices: shapes touch up to that, and no touching pair is lost. The contact distance of a
    /// query that has one counts if it is larger. Filters apply (WorldInstance).
    double reach = 0.0;
    /// True: the table has only the pairs that are hit: a contact or penetrating point was found,
    /// or the shapes intersect or, for separations and closest points, are at most `reach` apart;
    /// for containment those with `a` inside `b`; for times of impact those that are not
    /// ImpactState::separated; and all whose status is an error. False: all candidates.
    bool hits_only = false;
};

/// One row of a PairTable: the answer to its query for one pair.
template <class Query>
struct PairRow : Query::Result::Values {
    InstanceHandle a;  ///< the query's `a`
    InstanceHandle b;  ///< the query's `b`
    /// Of this pair alone; if it is an error, ignore the rest. Context::answer() with the two
    /// instances returns the message.
    StatusCode status = StatusCode::ok;
    bool intersects = false;         ///< as ResultSummary::intersects
    double error_bound = 0.0;        ///< as ResultSummary::error_bound
    std::uint32_t first_record = 0;  ///< in PairTable::records()
    std::uint32_t record_count = 0;  ///< consecutive ones
};

/// The parts of a PairTable that do not depend on the kind of its query.
class NEARFIELD_EXPORT PairTableBase {
public:
    /// The pairs asked about.
    [[nodiscard]] const PairSelection& selection() const noexcept { return selection_; }
    /// The number of candidates at the last update, hit or not.
    [[nodiscard]] std::uint32_t candidates() const noexcept;
    /// The number of candidates that the last update answered anew; the others had not changed.
    [[nodiscard]] std::uint32_t answered() const noexcept;

protected:
    /// A table that holds nothing yet.
    explicit PairTableBase(const PairSelection& selection);
    ~PairTableBase();
    /// Takes the contents of another table, which can then only be destroyed or assigned to.
    PairTableBase(PairTableBase&&) noexcept;
    /// Likewise.
    PairTableBase& operator=(PairTableBase&&) noexcept;

private:
    friend class World;
    struct NEARFIELD_HIDDEN State;
    PairSelection selection_;
    std::unique_ptr<State> state_;
};

/// One query of all pairs of instances in a world: PenetrationQuery, ContactQuery,
/// IntersectionQuery, ClosestPointQuery, SeparationQuery, IntersectionTestQuery,
/// SeparationVectorQuery, ContainmentQuery or TimeOfImpactQuery. World::update() brings the table
/// up to date; a pair neither of whose instances has moved or deformed since the last update keeps
/// its row. The rows are the same, bit for bit, as in a new table.
///
/// Separations, intersection tests and times of impact have one row per pair, with the instance
/// added first as `a`; the other queries have two, each instance being `a` once. Rows are in
/// ascending order of the pairs, in the order in which their instances were added: by `a`, then by
/// `b`.
///
/// Times of impact: World::update() is told where instances move to. Bounding boxes are then those
/// of the whole motions, turns included, so that no impact is missed. A pair keeps its row if, in
/// addition, both motions are those of the last update; of two that stand still, it says whether
/// they touch.
///
/// Used with one world at a time; a table that comes to another world starts anew. It keeps its
/// memory from update to update. All spans are borrowed until the next update.
template <class Query>
class PairTable : public PairTableBase {
public:
    using Record = typename Query::Result::Record;  ///< what a row has several of; see the result

    /// A table without rows. `a` and `b` of the query are ignored, as are the end poses of a time
    /// of impact. Technique::automatic means Technique::cpu; the others are rejected by
    /// World::update(), as are resident results.
    explicit PairTable(const Query& query, const PairSelection& selection = {})
        : PairTableBase(selection), query_(query) {}

    /// The query, as it was given.
    [[nodiscard]] const Query& query() const noexcept { return query_; }
    /// One row per pair.
    [[nodiscard]] std::span<const PairRow<Query>> rows() const noexcept { return now_.rows; }
    /// The records of all rows, in the order of the rows.
    [[nodiscard]] std::span<const Record> records() const noexcept { return now_.records; }
    /// The records of one row.
    [[nodiscard]] std::span<const Record> records(const PairRow<Query>& row) const noexcept {
        return records().subspan(row.first_record, row.record_count);
    }

private:
    friend class World;

    struct Content {
        std::vector<PairRow<Query>> rows;
        std::vector<Record> records;
    };
    Query query_;
    Content now_;
    Content answered_;  // by the last update
    Content before_;    // memory for the next update
};

}  // namespace nearfield
