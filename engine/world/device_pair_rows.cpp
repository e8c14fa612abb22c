// How the rows of pairs that the device found are read.

#include <engine/device_input/pair_search.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/device_pairs.hpp>

#include <algorithm>
#include <utility>
#include <variant>

namespace nearfield {

std::uint32_t DevicePairs::device_row(std::uint32_t index) const {
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

const AnyResult* DevicePairs::find_decided(std::uint32_t row) const {
    const auto found =
        std::lower_bound(decided_.begin(), decided_.end(), row,
                         [](const Decided& one, std::uint32_t other) { return one.row < other; });
    return found != decided_.end() && found->row == row
               ? &decided_results_[static_cast<std::size_t>(found - decided_.begin())]
               : nullptr;
}

AnyQuery DevicePairs::query_on_cpu(const shaders::PairRowData& data, bool with_records) const {
    AnyQuery on_cpu = query_;
    std::visit(
        [&](auto& query) {
            query.technique = Technique::cpu;
            if constexpr (requires { query.on_device; }) {
                query.on_device = false;
            }
            if constexpr (requires { query.a, query.b; }) {
                query.a = instances_[data.a].instance;
                query.b = instances_[data.b].instance;
            }
            if constexpr (requires { query.summary_only; }) {
                query.summary_only = !with_records;
            }
        },
        on_cpu);
    return on_cpu;
}

const AnyResult& DevicePairs::answer_on_cpu(const shaders::PairRowData& data, bool with_records) {
    ask_cpu(
        1, with_records, [&](std::size_t) -> const shaders::PairRowData& { return data; },
        [](std::size_t, const AnyResult&) {});
    return questions_.front().result;
}

const device_input::PlannedQuery& DevicePairs::plan_pair(const shaders::PairRowData& data) {
    const PairInstance& a = instances_[data.a];
    const PairInstance& b = instances_[data.b];
    device_input::PlannedQuery& planned = of_a_;
    planned.query = &query_;
    planned.a = polygon_of(a.instance.shape);
    planned.b = polygon_of(b.instance.shape);
    planned.pose_a = a.instance.pose;
    planned.pose_b = b.instance.pose;
    planned.deviations = {planned.a->deviation(), planned.b->deviation()};
    planned.budget = device_input::pair_budget(query_, planned.deviations);
    planned.technique = Technique::compute;
    auto& points = planned.work.emplace<device_input::PlannedPoints>();
    points.source = device_input::PointSource::device;
    points.outside = question_.reach > 0.0;
    points.margin =
        device_input::margin_of_pair(a.place, planned.a->radius(), b.place, planned.b->radius());
    if (poses_) {
        points.margin += 2.0 * (rounding_of(a) + rounding_of(b));
    }
    return planned;
}

void DevicePairs::row(std::uint32_t index, PairRow<PenetrationQuery>& row) {
    const std::uint32_t number = device_row(index);
    const shaders::PairRowData data = pair_of(number);
    if (const AnyResult* const decided = find_decided(number)) {
        fill(row, data, std::get<PenetrationResult>(*decided));
        return;
    }
    if ((data.count & shaders::row_to_resolve) != 0) {
        fill(row, data, std::get<PenetrationResult>(answer_on_cpu(data, false)));
        return;
    }
    const device_input::PlannedQuery& planned = plan_pair(data);
    const batch::PenetrationSummary summary =
        resolver_.summarize_penetration(planned, {*planned.a, planned.pose_a},
                                        {*planned.b, planned.pose_b}, data, question_.tolerance);
    PenetrationResult result;
    result.count = summary.count;
    result.deepest = summary.deepest;
    result.intersects = true;
    result.error_bound = of_a_.budget.bound;
    fill(row, data, result);
}

void DevicePairs::row(std::uint32_t index, PairRow<IntersectionTestQuery>& row) {
    const shaders::PairRowData data = pair_of(device_row(index));
    IntersectionTestResult result;
    result.intersects = true;
    for (const std::uint32_t instance : {data.a, data.b}) {
        const PairInstance& entry = instances_[instance];
        const geometry::Polygon& polygon = *polygon_of(entry.instance.shape);
        const geometry::TransformedPolygon placed(polygon, entry.instance.pose);
        result.error_bound +=
            geometry::placement_rounding(placed, placed.box()) + polygon.deviation();
    }
    fill(row, data, result);
}

void DevicePairs::records(std::uint32_t index, std::vector<PenetratingPoint>& records) {
    const std::uint32_t number = device_row(index);
    const shaders::PairRowData data = pair_of(number);
    // As row() has it.
    if (find_decided(number) != nullptr || (data.count & shaders::row_to_resolve) != 0) {
        records = std::get<PenetrationResult>(answer_on_cpu(data, true)).points;
        return;
    }
    const device_input::PlannedQuery& planned = plan_pair(data);
    resolver_.begin(planned, {*planned.a, planned.pose_a}, {*planned.b, planned.pose_b},
                    points_of(number, data.first_point, data.point_count));
    static_cast<void>(resolver_.list_penetrations(question_.tolerance, records));
}

/// Both directions of the pair, with the points that the device found.
void DevicePairs::find_contacts(const shaders::PairRowData& data, std::uint32_t row) {
    of_b_ = plan_pair(data);
    std::swap(of_b_.a, of_b_.b);
    std::swap(of_b_.pose_a, of_b_.pose_b);
    std::swap(of_b_.deviations.a, of_b_.deviations.b);
    contact_decoder_.find({of_a_, points_of(row, data.first_point, data.point_count)},
                          {of_b_, points_of(row, data.first_of_b, data.count_of_b)},
                          of_a_.budget.cell, found_contacts_);
}

ContactResult& DevicePairs::contacts_of(const shaders::PairRowData& data, std::uint32_t row) {
    contacts_.manifold.clear();
    contacts_.points.clear();
    if (find_decided(row) != nullptr) {
        const auto& answer = std::get<ContactResult>(answer_on_cpu(data, question_.records));
        contacts_.manifold = answer.manifold;
        contacts_.points = answer.points;
        return contacts_;
    }
    find_contacts(data, row);
    contacts_.cell = of_a_.budget.cell;
    found_contacts_.write(*of_a_.a, *of_a_.b, std::get<ContactQuery>(query_), contacts_);
    return contacts_;
}

bool DevicePairs::do_intersect(const shaders::PairRowData& data) {
    if ((data.count & shaders::row_intersects) != 0) {
        return true;
    }
    edges_.clear();
    return queries::intersect(plan_pair(data), edges_, overlap_test_);
}

void DevicePairs::row(std::uint32_t index, PairRow<ContactQuery>& row) {
    const std::uint32_t number = device_row(index);
    const shaders::PairRowData data = pair_of(number);
    if (const AnyResult* const decided = find_decided(number)) {
        fill(row, data, std::get<ContactResult>(*decided));
        return;
    }
    contacts_.count = data.count & shaders::row_count_mask;
    if ((data.count & shaders::row_to_resolve) != 0) {
        find_contacts(data, number);
        contacts_.count = found_contacts_.count();
    }
    contacts_.intersects = do_intersect(data);
    const auto deviation_of = [this](std::uint32_t instance) {
        return polygon_of(instances_[instance].instance.shape)->deviation();
    };
    contacts_.error_bound =
        device_input::pair_budget(query_, {deviation_of(data.a), deviation_of(data.b)}).bound;
    fill(row, data, contacts_);
}

void DevicePairs::records(std::uint32_t index, std::vector<ContactPoint>& records) {
    const std::uint32_t number = device_row(index);
    std::swap(records, contacts_of(pair_of(number), number).points);
}

void DevicePairs::manifold(std::uint32_t index, std::vector<ContactCluster>& manifold) {
    const std::uint32_t number = device_row(index);
    std::swap(manifold, contacts_of(pair_of(number), number).manifold);
}

}  // namespace nearfield
