#include <tools/common/device_pair_runner.hpp>
#include <tools/common/library.hpp>
#include <tools/io/query_request.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

namespace nearfield::tools {
namespace {

/// Instances of the first group alone come first, those of the second alone last: a table has the
/// instance that was added first as `a` where a pair has one row.
unsigned rank_of(unsigned side) {
    return side == 1U ? 0U : side == 3U ? 1U : 2U;
}

template <class Query>
constexpr bool has_table =
    std::is_same_v<Query, PenetrationQuery> || std::is_same_v<Query, ContactQuery> ||
    std::is_same_v<Query, IntersectionTestQuery> || std::is_same_v<Query, SeparationQuery> ||
    std::is_same_v<Query, ClosestPointQuery>;

}  // namespace

bool is_for_device_pairs(const SceneQuery& query) {
    const QueryRequest& request = query.request;
    if (!query.all_pairs || !query.hits_only || request.technique != Technique::compute) {
        return false;
    }
    switch (request.type) {
        case QueryType::penetration:
        case QueryType::intersection_test:
            return true;
        case QueryType::contacts:
            return request.normals == ContactNormals::analytic;
        case QueryType::separation:
        case QueryType::closest_point:
            return request.tolerance > 0.0;  // otherwise each pair has its own
        default:
            return false;
    }
}

/// Of shapes that share a point: no others are hits, whatever the reach.
DevicePairRunner::Table DevicePairRunner::table_of(const QueryRequest& request) {
    Batch batch;
    add_query(batch, request, {}, {});
    return std::visit(
        []<class Query>(const Query& query) -> Table {
            if constexpr (has_table<Query>) {
                return PairTable<Query>(query,
                                        {.hits_only = true, .technique = Technique::compute});
            } else {
                throw std::logic_error("the device has no table of such pairs");
            }
        },
        batch.queries().front());
}

DevicePairRunner::DevicePairRunner(const QueryRequest& request, Context& context,
                                   const PairSelection& among)
    : request_(request),
      context_(context),
      world_(take(World::create(context))),
      table_(table_of(request)),
      order_(among.sound.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&among](std::size_t i, std::size_t j) {
        return rank_of(among.sides[i]) < rank_of(among.sides[j]);
    });
    for (const std::size_t i : order_) {
        WorldInstance instance;
        instance.shape = among.instances[i].shape;
        instance.pose = among.instances[i].pose;
        instance.category = among.sides[i];
        instance.mask = (among.sides[i] & 1U) << 1U | among.sides[i] >> 1U;
        handles_.push_back(take(world_.add(instance)));
        indices_.resize(std::max<std::size_t>(indices_.size(), handles_.back().index + 1U));
        indices_[handles_.back().index] = among.sound[i];
    }
    poses_.resize(order_.size());
}

Status DevicePairRunner::answer(std::span<const Instance> instances, const Limits& limits,
                                Timings& timings) {
    row_count_ = 0;
    std::transform(order_.begin(), order_.end(), poses_.begin(),
                   [&instances](std::size_t i) { return instances[i].pose; });
    if (Status status = world_.move(handles_, poses_); !status.ok()) {
        return status;
    }
    return std::visit(
        [&](auto& table) {
            Status status = world_.update(table, {}, limits);
            add_timings(table.timings(), timings);
            return status.ok() ? read_rows(table, limits) : status;
        },
        table_);
}

template <class Query>
Status DevicePairRunner::read_rows(PairTable<Query>& table, const Limits& limits) {
    rows_.resize(std::max<std::size_t>(rows_.size(), table.size()));
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        if (limits.cancel != nullptr && *limits.cancel) {
            return {StatusCode::cancelled, "not all pairs that the device found were read"};
        }
        if (Status status = read_row(table, i, rows_[i]); !status.ok()) {
            return status;
        }
    }
    row_count_ = table.size();
    const auto key = [](const Row& row) {
        return std::tuple(std::min(row.a, row.b), std::max(row.a, row.b), row.a);
    };
    std::sort(rows_.begin(), rows_.begin() + table.size(),
              [&key](const Row& one, const Row& other) { return key(one) < key(other); });
    return {};
}

template <class Query>
Status DevicePairRunner::read_row(PairTable<Query>& table, std::uint32_t index, Row& read) {
    using Result = typename Query::Result;
    const Expected<PairRow<Query>> row = table.row(index);
    if (!row.has_value()) {
        return row.error();
    }
    read.a = indices_[row->a.index];
    read.b = indices_[row->b.index];
    auto& result = std::holds_alternative<Result>(read.result) ? std::get<Result>(read.result)
                                                               : read.result.emplace<Result>();
    static_cast<typename Result::Values&>(result) = *row;
    result.technique = Technique::compute;
    result.intersects = row->intersects;
    result.error_bound = row->error_bound;
    if constexpr (requires { table.query().tolerance; }) {
        result.tolerance = table.query().tolerance;
        result.cell = result.tolerance * std::numbers::sqrt2;
    }
    if (row->status != StatusCode::ok) {
        result.status = error_of(table.query(), *row);
        return {};
    }
    result.status = {};
    if constexpr (requires { result.manifold; }) {
        const auto manifold = table.manifold(*row);
        result.manifold.assign(manifold.begin(), manifold.end());
    }
    if constexpr (requires { result.points; }) {
        const auto points = table.points(*row);
        result.points.assign(points.begin(), points.end());
    }
    return table.read_status();
}

/// A row has the code alone.
template <class Query>
Status DevicePairRunner::error_of(Query query, const PairRow<Query>& row) {
    const auto instance_of = [this](InstanceHandle handle) {
        const WorldInstance instance = take(world_.instance(handle));
        return Instance{instance.shape, instance.pose};
    };
    query.technique = Technique::cpu;
    query.a = instance_of(row.a);
    query.b = instance_of(row.b);
    const Status status = context_.answer(query).error();
    return status.ok() ? Status(row.status, "the device could not answer the pair") : status;
}

std::size_t DevicePairRunner::pair_count() const {
    return std::visit([](const auto& table) { return table.candidates(); }, table_);
}

}  // namespace nearfield::tools
