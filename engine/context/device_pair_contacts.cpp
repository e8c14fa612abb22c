// How the contacts of a pair that the device found are read.

#include <engine/context/device_pair_state.hpp>

#include <utility>
#include <variant>

namespace nearfield {

/// Both directions of the pair, with the points that the device found.
void DevicePairTableBase::State::find_contacts(const plan::PairRowData& data, std::uint32_t row) {
    begin(data);
    plan::PlannedQuery& of_a = plan_.queries[0];
    plan::PlannedQuery& of_b = plan_.queries[1];
    of_b = of_a;
    std::swap(of_b.a, of_b.b);
    std::swap(of_b.pose_a, of_b.pose_b);
    std::swap(of_b.deviations.a, of_b.deviations.b);
    of_a.points().reverse = 1;
    add_points(buffers_->records(row, data.first_record, data.record_count), of_a);
    add_points(buffers_->records(row, data.first_of_b, data.count_of_b), of_b);
    contact_decoder_.find(plan_, of_a, words_, of_a.budget.cell, found_contacts_);
}

ContactResult& DevicePairTableBase::State::contacts_of(const plan::PairRowData& data,
                                                       std::uint32_t row) {
    contacts_.manifold.clear();
    contacts_.records.clear();
    if (find_decided(row) != nullptr) {
        const auto& answer = std::get<ContactResult>(answer_on_cpu(data, question_.records));
        contacts_.manifold = answer.manifold;
        contacts_.records = answer.records;
        return contacts_;
    }
    find_contacts(data, row);
    const plan::PlannedQuery& planned = plan_.queries.front();
    contacts_.cell = planned.budget.cell;
    found_contacts_.write(*planned.a, *planned.b, std::get<ContactQuery>(query_), contacts_);
    return contacts_;
}

bool DevicePairTableBase::State::do_intersect(const plan::PairRowData& data) {
    if ((data.count & plan::row_intersects) != 0) {
        return true;
    }
    begin(data);
    edges_.clear();
    return intersection_test_.intersect(plan_.queries.front(), edges_);
}

void DevicePairTableBase::State::row(std::uint32_t index, PairRow<ContactQuery>& row) {
    const std::uint32_t number = device_row("row", index);
    const plan::PairRowData data = pair_of(number);
    if (const AnyResult* const decided = find_decided(number)) {
        fill(row, data, std::get<ContactResult>(*decided));
        return;
    }
    contacts_.count = data.count & plan::row_count_mask;
    if ((data.count & plan::row_to_resolve) != 0) {
        find_contacts(data, number);
        contacts_.count = found_contacts_.count();
    }
    contacts_.intersects = do_intersect(data);
    const auto deviation_of = [this](std::uint32_t instance) {
        return polygon_of(instances_[instance].instance.shape)->deviation();
    };
    contacts_.error_bound =
        plan::pair_budget(query_, {deviation_of(data.a), deviation_of(data.b)}).bound;
    fill(row, data, contacts_);
}

void DevicePairTableBase::State::records(std::uint32_t index, std::vector<ContactRecord>& records) {
    require_records();
    const std::uint32_t number = device_row("records", index);
    std::swap(records, contacts_of(pair_of(number), number).records);
}

void DevicePairTableBase::State::manifold(std::uint32_t index,
                                          std::vector<ContactCluster>& manifold) {
    const std::uint32_t number = device_row("manifold", index);
    std::swap(manifold, contacts_of(pair_of(number), number).manifold);
}

}  // namespace nearfield
