#include <engine/context/call_within.hpp>
#include <engine/context/pair_row.hpp>
#include <engine/context/pair_table_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/plan/pair_question.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace nearfield {
namespace {

/// How far apart the boxes of a pair may be.
template <class Query>
double reach_of(const PairTable<Query>& table) {
    const double reach = table.selection().reach;
    if constexpr (requires { table.query().contact_distance; }) {
        return std::max(reach, table.query().contact_distance);
    } else {
        return reach;
    }
}

template <class Result>
auto* records_of(Result& result) {
    if constexpr (requires { result.samples; }) {
        return &result.samples;
    } else if constexpr (requires { result.records; }) {
        return &result.records;
    } else {
        return static_cast<std::vector<NoRecord>*>(nullptr);
    }
}

template <class Query>
bool is_hit(const PairRow<Query>& row, double reach) {
    if (row.status != StatusCode::ok) {
        return true;
    }
    if constexpr (requires { row.state; }) {
        return row.state != ImpactState::separated;
    } else if constexpr (requires { row.inside; }) {
        return row.inside;
    } else if constexpr (requires { row.distance; }) {
        return row.intersects || row.distance <= reach;
    } else if constexpr (requires { row.count; }) {
        return row.intersects || row.count > 0;
    } else {
        return row.intersects;
    }
}

template <class Query>
void check(const PairTable<Query>& table) {
    const double reach = table.selection().reach;
    if (!(reach >= 0.0 && reach <= largest_coordinate)) {
        refuse("update", "the reach is " + geometry::number(reach) +
                             "; it must be a finite number of at least 0");
    }
    static_cast<void>(asked_of_cpu("update", table.query()));
}

}  // namespace

PairTableBase::PairTableBase(const PairSelection& selection)
    : selection_(selection), state_(std::make_unique<State>()) {}
PairTableBase::~PairTableBase() = default;
PairTableBase::PairTableBase(PairTableBase&&) noexcept = default;
PairTableBase& PairTableBase::operator=(PairTableBase&&) noexcept = default;

std::uint32_t PairTableBase::candidates() const noexcept {
    return static_cast<std::uint32_t>(state_->list.pairs().size());
}

std::uint32_t PairTableBase::answered() const noexcept {
    return state_->answered;
}

/// Answers the candidates that are new or have changed.
template <class Query>
void World::Implementation::answer_new_pairs(PairTable<Query>& table) {
    constexpr std::size_t queries_at_a_time = 4096;
    const auto pairs = table.state_->list.pairs();
    table.state_->answered = 0;
    table.answered_.rows.clear();
    table.answered_.records.clear();
    Query query = table.query_;
    query.technique = Technique::cpu;
    const auto fresh = table.state_->list.new_pairs();
    for (std::size_t first = 0; first < fresh.size(); first += queries_at_a_time) {
        batch_.clear();
        candidates_.clear();
        const std::size_t count = std::min(queries_at_a_time, fresh.size() - first);
        for (const std::uint32_t i : fresh.subspan(first, count)) {
            query.a = instance_of(pairs[i].a);
            query.b = instance_of(pairs[i].b);
            if constexpr (requires { query.end_a; }) {
                query.end_a = table.state_->motions.end(pairs[i].a);
                query.end_b = table.state_->motions.end(pairs[i].b);
            }
            batch_.add(query);
            candidates_.push_back({i, pairs[i].b});
        }
        run_batch();
        append_rows(table);
    }
}

template <class Query>
void World::Implementation::append_rows(PairTable<Query>& table) {
    using Result = typename Query::Result;
    auto& [rows, records] = table.answered_;
    const auto pairs = table.state_->list.pairs();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Result& result = *std::get_if<Result>(&results_.results[i]);
        const world::PairList::Pair& pair = pairs[candidates_[i].number];
        PairRow<Query>& row = rows.emplace_back(
            row_of<Query>(instances_.handle(pair.a), instances_.handle(pair.b), result));
        row.first_record = static_cast<std::uint32_t>(records.size());
        if (const auto* const found = records_of(result)) {
            row.record_count = static_cast<std::uint32_t>(found->size());
            records.insert(records.end(), found->begin(), found->end());
        }
    }
    table.state_->answered += static_cast<std::uint32_t>(candidates_.size());
}

/// Appends consecutive rows and their records to a table's content.
template <class Content>
void append(const Content& from, std::size_t first, std::size_t end, Content& to) {
    if (first == end) {
        return;
    }
    const std::size_t row = to.rows.size();
    const std::size_t record = from.rows[first].first_record;
    const std::size_t end_record =
        from.rows[end - 1].first_record + from.rows[end - 1].record_count;
    const std::size_t to_record = to.records.size();
    if (to_record + end_record - record > UINT32_MAX) {
        throw StatusException(
            {StatusCode::too_large, "update: the table has more records than 32 bits can count"});
    }
    to.rows.insert(to.rows.end(), from.rows.begin() + static_cast<std::ptrdiff_t>(first),
                   from.rows.begin() + static_cast<std::ptrdiff_t>(end));
    to.records.insert(to.records.end(), from.records.begin() + static_cast<std::ptrdiff_t>(record),
                      from.records.begin() + static_cast<std::ptrdiff_t>(end_record));
    if (to_record == record) {
        return;  // always so without records
    }
    for (std::size_t i = row; i < to.rows.size(); ++i) {
        to.rows[i].first_record += static_cast<std::uint32_t>(to_record - record);
    }
}

/// Puts the rows that stay and the new ones into the order of the candidates.
template <class Query>
void World::Implementation::merge_rows(PairTable<Query>& table) {
    constexpr std::uint32_t none = world::PairList::none;
    PairTableBase::State& state = *table.state_;
    const auto pairs = state.list.pairs();
    auto& merged = table.before_;
    merged.rows.clear();
    merged.records.clear();
    state.row_of_before.resize(pairs.size());
    std::size_t next_answered = 0;
    for (std::size_t i = 0; i < pairs.size();) {
        if (pairs[i].before == none) {
            const PairRow<Query>& row = table.answered_.rows[next_answered++];
            const bool is_listed =
                !table.selection_.hits_only || is_hit(row, table.selection_.reach);
            state.row_of_before[i] =
                is_listed ? static_cast<std::uint32_t>(merged.rows.size()) : none;
            append(table.answered_, next_answered - 1, next_answered - (is_listed ? 0 : 1), merged);
            ++i;
            continue;
        }
        // A run of pairs that stay has its rows, if they are listed, in one piece.
        const auto to_row = static_cast<std::uint32_t>(merged.rows.size());
        std::uint32_t first = none;
        std::uint32_t end = 0;
        const std::size_t begin = i;
        for (; i < pairs.size() && pairs[i].before == pairs[begin].before + (i - begin); ++i) {
            const std::uint32_t row = state.row_of[pairs[i].before];
            if (row != none) {
                first = std::min(first, row);
                end = row + 1;
            }
            state.row_of_before[i] = row == none ? none : to_row + row - first;
        }
        append(table.now_, std::min(first, end), end, merged);
    }
    std::swap(table.now_, table.before_);
    state.row_of.swap(state.row_of_before);
}

template <class Query, class FindPairs>
void World::Implementation::update(PairTable<Query>& table, const FindPairs& find_pairs) {
    PairTableBase::State& state = *table.state_;
    const auto start_anew = [&] {
        state.motions.clear();
        state.list.clear();
        state.row_of.clear();
        table.now_.rows.clear();
        table.now_.records.clear();
    };
    try {
        check(table);
        prepare();
        if (state.world.lock() != identity_) {
            start_anew();
            state.world = identity_;
        }
        find_pairs();
        answer_new_pairs(table);
        merge_rows(table);
    } catch (...) {
        start_anew();
        throw;
    }
}

template <class Query>
void World::Implementation::update(PairTable<Query>& table) {
    update(table, [&] {
        table.state_->list.update(instances_, reach_of(table), !plan::is_symmetric<Query>);
    });
}

void World::Implementation::update(PairTable<TimeOfImpactQuery>& table,
                                   std::span<const InstanceHandle> moving,
                                   std::span<const Pose> ends) {
    update(table, [&] {
        require_moves("update", moving, ends);
        PairTableBase::State& state = *table.state_;
        state.motions.update(instances_, moving, ends);
        state.list.update(instances_, state.motions, reach_of(table));
    });
}

Status World::update(PairTable<PenetrationQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<ContactQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<IntersectionQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<ClosestPointQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<SeparationQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<IntersectionTestQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<SeparationVectorQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<ContainmentQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(PairTable<TimeOfImpactQuery>& table, std::span<const InstanceHandle> moving,
                     std::span<const Pose> ends, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table, moving, ends); });
}

}  // namespace nearfield
