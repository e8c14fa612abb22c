// How the rows of a table of pairs that the device found are read.

#include <engine/base/catch_to_status.hpp>
#include <engine/context/device_pair_state.hpp>
#include <engine/context/pair_row.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/point_search.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace nearfield {

DevicePairTable::DevicePairTable(const PenetrationQuery& query)
    : state_(std::make_unique<State>(query)) {}
DevicePairTable::~DevicePairTable() = default;
DevicePairTable::DevicePairTable(DevicePairTable&&) noexcept = default;
DevicePairTable& DevicePairTable::operator=(DevicePairTable&&) noexcept = default;

const PenetrationQuery& DevicePairTable::query() const noexcept {
    return state_->query;
}

std::uint32_t DevicePairTable::size() const noexcept {
    return state_->rows;
}

std::uint32_t DevicePairTable::candidates() const noexcept {
    return state_->candidates();
}

std::uint32_t DevicePairTable::left_to_cpu() const noexcept {
    return state_->left_to_cpu();
}

const Timings& DevicePairTable::timings() const noexcept {
    return state_->timings;
}

Expected<DevicePairTable::Row> DevicePairTable::row(std::uint32_t index) {
    Row row;
    Status status = catch_to_status([&] { row = state_->row(index); });
    return status.ok() ? Expected<Row>(row) : status;
}

Status DevicePairTable::records(std::uint32_t index, std::vector<PenetrationRecord>& records) {
    return catch_to_status([&] { state_->records(index, records); });
}

DevicePairTable::State::~State() {
    if (context_ != nullptr) {
        context_->shapes().release(held_);
    }
}

std::uint32_t DevicePairTable::State::candidates() const {
    return buffers_ == nullptr || instances_.size() < 2 ? 0 : buffers_->counts()[plan::pair_total];
}

std::uint32_t DevicePairTable::State::device_row(const char* call, std::uint32_t index) const {
    if (index >= rows) {
        refuse(call, "there is no row " + std::to_string(index) + "; the table has " +
                         std::to_string(rows));
    }
    return device_rows_.empty() ? index : device_rows_[index];
}

const DevicePairTable::State::Decided* DevicePairTable::State::find_decided(
    std::uint32_t row) const {
    const auto found =
        std::lower_bound(decided_.begin(), decided_.end(), row,
                         [](const Decided& one, std::uint32_t other) { return one.row < other; });
    return found != decided_.end() && found->row == row ? &*found : nullptr;
}

PenetrationQuery DevicePairTable::State::query_on_cpu(const plan::PairRowData& data,
                                                      bool with_records) const {
    PenetrationQuery on_cpu = query;
    on_cpu.a = instances_[data.a].instance;
    on_cpu.b = instances_[data.b].instance;
    on_cpu.technique = Technique::cpu;
    on_cpu.records = with_records;
    return on_cpu;
}

PenetrationResult DevicePairTable::State::answer_on_cpu(const plan::PairRowData& data,
                                                        bool with_records) {
    const PairInstance& a = instances_[data.a];
    const PairInstance& b = instances_[data.b];
    cpu_queries_.assign(1, query_on_cpu(data, with_records));
    context_->ring().answer(
        cpu_queries_,
        [&](ShapeHandle shape) { return shape == a.instance.shape ? a.polygon : b.polygon; },
        cpu_results_);
    return std::move(std::get<PenetrationResult>(cpu_results_.results.front()));
}

/// Plans the pair as if its points had been found by a batch.
void DevicePairTable::State::begin(const plan::PairRowData& data) {
    const PairInstance& a = instances_[data.a];
    const PairInstance& b = instances_[data.b];
    asked_ = query;
    plan_.points.clear();
    words_.clear();
    plan::PlannedQuery& planned = plan_.queries.front();
    planned.query = &asked_;
    planned.a = a.polygon;
    planned.b = b.polygon;
    planned.pose_a = a.instance.pose;
    planned.pose_b = b.instance.pose;
    planned.deviations = {a.polygon->deviation(), b.polygon->deviation()};
    planned.budget = plan::penetration_budget(query, planned.deviations);
    planned.technique = Technique::compute;
    auto& points = planned.work.emplace<plan::PlannedPoints>();
    points.source = plan::PointSource::device;
    points.margin = plan::margin_of_pair(a.data, b.data);
}

void DevicePairTable::State::add_point(const plan::FoundPointData& found) {
    plan::PlannedQuery& planned = plan_.queries.front();
    plan_.points.push_back({plan::found_point(planned, found), plan::PlannedPoint::no_tile});
    words_.push_back(found.word);
    ++planned.points().count;
}

DevicePairTable::Row DevicePairTable::State::row_of(const plan::PairRowData& data,
                                                    const PenetrationResult& result) const {
    Row row = nearfield::row_of<PenetrationQuery>(instances_[data.a].handle,
                                                  instances_[data.b].handle, result);
    row.record_count = query.records ? result.count : 0;
    return row;
}

DevicePairTable::Row DevicePairTable::State::row(std::uint32_t index) {
    const std::uint32_t number = device_row("row", index);
    const plan::PairRowData& data = buffers_->rows()[number];
    if (const Decided* const decided = find_decided(number)) {
        return decided->answer;
    }
    if ((data.count & plan::row_has_rival) != 0) {
        return row_of(data, answer_on_cpu(data, false));
    }
    begin(data);
    add_point({0, data.edge, data.number, data.word});
    PenetrationResult result;
    resolver_.begin(plan_, plan_.queries.front(), words_);
    resolver_.for_each_penetration(
        query.tolerance, [&](const PenetrationRecord& record) { result.deepest = record; });
    result.count = data.count & plan::row_count_mask;
    result.intersects = true;
    result.error_bound = plan_.queries.front().budget.bound;
    return row_of(data, result);
}

void DevicePairTable::State::records(std::uint32_t index, std::vector<PenetrationRecord>& records) {
    if (!query.records) {
        refuse("records", "the table's query does without records");
    }
    const std::uint32_t number = device_row("records", index);
    const plan::PairRowData& data = buffers_->rows()[number];
    if (find_decided(number) != nullptr) {
        records = answer_on_cpu(data, true).records;
        return;
    }
    records.clear();
    begin(data);
    for (const plan::FoundPointData& found :
         buffers_->records().subspan(data.first_record, data.record_count)) {
        add_point(found);
    }
    resolver_.begin(plan_, plan_.queries.front(), words_);
    resolver_.for_each_penetration(
        query.tolerance, [&](const PenetrationRecord& record) { records.push_back(record); });
}

}  // namespace nearfield
