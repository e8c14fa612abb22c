// How the rows of a table of pairs that the device found are read.

#include <engine/base/catch_to_status.hpp>
#include <engine/context/device_pair_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/plan/point_search.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

namespace nearfield {

DevicePairTableBase::DevicePairTableBase(const AnyQuery& query, double reach)
    : state_(std::make_unique<State>(query, reach)) {}
DevicePairTableBase::~DevicePairTableBase() = default;
DevicePairTableBase::DevicePairTableBase(DevicePairTableBase&&) noexcept = default;
DevicePairTableBase& DevicePairTableBase::operator=(DevicePairTableBase&&) noexcept = default;

std::uint32_t DevicePairTableBase::size() const noexcept {
    return state_->rows;
}

std::uint32_t DevicePairTableBase::candidates() const noexcept {
    return state_->candidates();
}

std::uint32_t DevicePairTableBase::left_to_cpu() const noexcept {
    return state_->left_to_cpu();
}

const Timings& DevicePairTableBase::timings() const noexcept {
    return state_->timings;
}

Expected<ResidentPairs> DevicePairTableBase::resident() const {
    ResidentPairs pairs;
    Status status = catch_to_status([&] { pairs = state_->resident(); });
    return status.ok() ? Expected<ResidentPairs>(pairs) : status;
}

Status DevicePairTableBase::read(std::uint32_t index, PairRow<PenetrationQuery>& row) {
    return catch_to_status([&] { state_->row(index, row); });
}

Status DevicePairTableBase::read(std::uint32_t index, PairRow<ContactQuery>& row) {
    return catch_to_status([&] { state_->row(index, row); });
}

Status DevicePairTableBase::read(std::uint32_t index, PairRow<IntersectionTestQuery>& row) {
    return catch_to_status([&] { state_->row(index, row); });
}

Status DevicePairTableBase::read(std::uint32_t index, PairRow<ClosestPointQuery>& row) {
    return catch_to_status([&] { state_->row(index, row); });
}

Status DevicePairTableBase::read(std::uint32_t index, PairRow<SeparationQuery>& row) {
    return catch_to_status([&] { state_->row(index, row); });
}

Status DevicePairTableBase::read(std::uint32_t index, std::vector<PenetrationRecord>& records) {
    return catch_to_status([&] { state_->records(index, records); });
}

Status DevicePairTableBase::read(std::uint32_t index, std::vector<ContactRecord>& records) {
    return catch_to_status([&] { state_->records(index, records); });
}

Status DevicePairTableBase::read(std::uint32_t index, std::vector<NoRecord>& records) {
    return catch_to_status([&] { state_->records(index, records); });
}

Status DevicePairTableBase::read(std::uint32_t index, std::vector<ContactCluster>& manifold) {
    return catch_to_status([&] { state_->manifold(index, manifold); });
}

DevicePairTableBase::State::State(const AnyQuery& query, double reach)
    : query_(query), question_(plan::pair_question(query, reach)) {
    plan_.queries.resize(2);
}

DevicePairTableBase::State::~State() {
    if (context_ != nullptr) {
        report_open_frame();
        set_submitted(false);
        instances_.clear(&context_->shapes());
    }
}

ResidentPairs DevicePairTableBase::State::resident() const {
    if (!question_.resident) {
        refuse("resident", "the table's query does without results that stay on the device");
    }
    if (buffers_ == nullptr || instances_.size() < 2) {
        throw StatusException({StatusCode::not_ready,
                               "resident: no pairs were searched; the table was not submitted, or "
                               "there were fewer than two instances"});
    }
    return buffers_->outputs().pairs();
}

std::uint32_t DevicePairTableBase::State::candidates() const {
    const bool has_searched = buffers_ != nullptr && instances_.size() > 1 && !is_submitted_;
    return has_searched ? buffers_->candidates() : 0;
}

std::uint32_t DevicePairTableBase::State::device_row(const char* call, std::uint32_t index) const {
    if (index >= rows) {
        refuse(call, "there is no row " + std::to_string(index) + "; the table has " +
                         std::to_string(rows));
    }
    // A dropped row comes before that of the table if fewer than `index` others lie before it.
    std::uint32_t dropped = 0;
    auto count = static_cast<std::uint32_t>(dropped_rows_.size());
    while (count > 0) {
        const std::uint32_t half = count / 2;
        const bool is_before = dropped_rows_[dropped + half] - (dropped + half) <= index;
        dropped += is_before ? half + 1 : 0;
        count = is_before ? count - half - 1 : half;
    }
    return index + dropped;
}

const AnyResult* DevicePairTableBase::State::find_decided(std::uint32_t row) const {
    const auto found =
        std::lower_bound(decided_.begin(), decided_.end(), row,
                         [](const Decided& one, std::uint32_t other) { return one.row < other; });
    return found != decided_.end() && found->row == row
               ? &decided_results_.results[static_cast<std::size_t>(found - decided_.begin())]
               : nullptr;
}

AnyQuery DevicePairTableBase::State::query_on_cpu(const plan::PairRowData& data,
                                                  bool with_records) const {
    AnyQuery on_cpu = query_;
    std::visit(
        [&](auto& query) {
            query.technique = Technique::cpu;
            if constexpr (requires { query.resident; }) {
                query.resident = false;
            }
            if constexpr (requires { query.a, query.b; }) {
                query.a = instances_[data.a].instance;
                query.b = instances_[data.b].instance;
            }
            if constexpr (requires { query.records; }) {
                query.records = with_records;
            }
        },
        on_cpu);
    return on_cpu;
}

const AnyResult& DevicePairTableBase::State::answer_on_cpu(const plan::PairRowData& data,
                                                           bool with_records) {
    cpu_queries_.assign(1, query_on_cpu(data, with_records));
    context_->ring().answer(
        cpu_queries_, [this](ShapeHandle shape) { return polygon_of(shape); }, cpu_results_);
    return cpu_results_.results.front();
}

void DevicePairTableBase::State::require_records() const {
    if (!question_.records) {
        refuse("records", "the table's query does without records");
    }
}

/// Plans the pair as if its points had been found by a batch.
void DevicePairTableBase::State::begin(const plan::PairRowData& data) {
    const PairInstance& a = instances_[data.a];
    const PairInstance& b = instances_[data.b];
    plan_.points.clear();
    words_.clear();
    plan::PlannedQuery& planned = plan_.queries.front();
    planned.query = &query_;
    planned.a = polygon_of(a.instance.shape);
    planned.b = polygon_of(b.instance.shape);
    planned.pose_a = a.instance.pose;
    planned.pose_b = b.instance.pose;
    planned.deviations = {planned.a->deviation(), planned.b->deviation()};
    planned.budget = plan::pair_budget(query_, planned.deviations);
    planned.technique = Technique::compute;
    auto& points = planned.work.emplace<plan::PlannedPoints>();
    points.source = plan::PointSource::device;
    points.outside = question_.reach > 0.0;
    points.margin =
        plan::margin_of_pair(a.place, planned.a->radius(), b.place, planned.b->radius());
    if (poses_) {
        points.margin += 2.0 * (rounding_of(a) + rounding_of(b));
    }
}

void DevicePairTableBase::State::add_points(std::span<const plan::FoundPointData> found,
                                            plan::PlannedQuery& planned) {
    plan::PlannedPoints& points = planned.points();
    points.first = static_cast<std::uint32_t>(plan_.points.size());
    points.count = static_cast<std::uint32_t>(found.size());
    plan_.points.resize(points.end());
    words_.resize(points.end());
    plan::FoundPlaces place_of(planned);
    for (std::uint32_t i = 0; i < points.count; ++i) {
        plan_.points[points.first + i] = {place_of(found[i]), plan::PlannedPoint::no_tile};
        words_[points.first + i] = found[i].word;
    }
}

void DevicePairTableBase::State::row(std::uint32_t index, PairRow<PenetrationQuery>& row) {
    const std::uint32_t number = device_row("row", index);
    const plan::PairRowData data = pair_of(number);
    if (const AnyResult* const decided = find_decided(number)) {
        fill(row, data, std::get<PenetrationResult>(*decided));
        return;
    }
    if ((data.count & plan::row_to_resolve) != 0) {
        fill(row, data, std::get<PenetrationResult>(answer_on_cpu(data, false)));
        return;
    }
    begin(data);
    const plan::FoundPointData deepest{0, data.edge, data.number, data.word};
    add_points({&deepest, 1}, plan_.queries.front());
    PenetrationResult result;
    resolver_.begin(plan_, plan_.queries.front(), words_);
    resolver_.for_each_penetration(question_.tolerance, [&](const records::ResolvedPoint& point) {
        records::write(point, result.deepest);
    });
    result.count = data.count & plan::row_count_mask;
    result.intersects = true;
    result.error_bound = plan_.queries.front().budget.bound;
    fill(row, data, result);
}

void DevicePairTableBase::State::row(std::uint32_t index, PairRow<IntersectionTestQuery>& row) {
    const plan::PairRowData data = pair_of(device_row("row", index));
    IntersectionTestResult result;
    result.intersects = true;
    for (const std::uint32_t instance : {data.a, data.b}) {
        const PairInstance& entry = instances_[instance];
        const geometry::Polygon& polygon = *polygon_of(entry.instance.shape);
        const geometry::TransformedPolygon placed(polygon, entry.instance.pose);
        result.error_bound +=
            localize::placement_rounding(placed, placed.box()) + polygon.deviation();
    }
    fill(row, data, result);
}

void DevicePairTableBase::State::records(std::uint32_t index,
                                         std::vector<PenetrationRecord>& records) {
    require_records();
    const std::uint32_t number = device_row("records", index);
    const plan::PairRowData data = pair_of(number);
    // As row() has it.
    if (find_decided(number) != nullptr || (data.count & plan::row_to_resolve) != 0) {
        records = std::get<PenetrationResult>(answer_on_cpu(data, true)).records;
        return;
    }
    begin(data);
    add_points(buffers_->records(number, data.first_record, data.record_count),
               plan_.queries.front());
    resolver_.begin(plan_, plan_.queries.front(), words_);
    static_cast<void>(resolver_.list_penetrations(question_.tolerance, records));
}

void DevicePairTableBase::State::records(std::uint32_t /*index*/,
                                         std::vector<NoRecord>& /*records*/) const {
    require_records();
}

}  // namespace nearfield
