// Queries of a world about lists of pairs that are the caller's own.

#include <engine/base/interruption.hpp>
#include <engine/context/pair_row.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/plan/error_budget.hpp>

#include <algorithm>
#include <string>

namespace nearfield {
namespace {

/// The number of pairs that a job takes at a time.
constexpr std::size_t pairs_of_part = 128;
constexpr std::size_t pairs_of_batch = 4096;

}  // namespace

void World::Implementation::require_pairs(const char* call, std::span<const InstanceHandle> a,
                                          std::span<const InstanceHandle> b,
                                          std::size_t answers) const {
    if (a.size() != answers || b.size() != answers) {
        refuse(call, std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " instances form no pairs with space for " + std::to_string(answers) +
                         " answers");
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        static_cast<void>(instances_.find(a[i], call));
        static_cast<void>(instances_.find(b[i], call));
    }
}

void World::Implementation::test_pairs(std::span<const InstanceHandle> a,
                                       std::span<const InstanceHandle> b,
                                       std::span<std::uint8_t> intersects) {
    require_pairs("test_pairs", a, b, intersects.size());
    prepare();
    expect_answers(a.size());
    jobs_.divide(
        a.size(), pairs_of_part, [&](std::uint32_t job, std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) {
                checkpoint();
                const bool meet =
                    instances_.intersect(a[i].index, b[i].index, scratch_[job].overlap_test);
                intersects[i] = meet ? 1 : 0;
                finish_answers(1);
            }
        });
}

const PenetrationResult& World::Implementation::find_penetration(
    const PenetrationQuery& query, std::uint32_t a, std::uint32_t b,
    const cpu::PointPenetration::Reverse* reverse, Job& job) const {
    PenetrationResult& result = job.penetration_result;
    result.status = {};
    result.intersects = false;
    result.count = 0;
    result.deepest = {};
    if (!instances_.is_placed(a) || !instances_.is_placed(b)) {
        result.status = Status(StatusCode::unknown_shape, "");
        return result;
    }
    const plan::Deviations deviations{instances_.deviation(a), instances_.deviation(b)};
    result.error_bound = plan::penetration_budget(query, deviations).bound;
    result.status = plan::check_deviations(query.tolerance, deviations, result.error_bound);
    if (result.status.ok()) {
        result.status = plan::check_resolution(
            query.tolerance, std::max(instances_.magnitude(a), instances_.magnitude(b)));
    }
    if (result.status.ok() && instances_.boxes_meet(a, b)) {
        job.penetration->answer(query, instances_.edges(a), instances_.edges(b), reverse, result);
    }
    return result;
}

void World::Implementation::find_penetrations(const PenetrationQuery& query,
                                              std::span<const InstanceHandle> a,
                                              std::span<const InstanceHandle> b,
                                              std::span<PairRow<PenetrationQuery>> rows,
                                              Job& job) const {
    if (!job.penetration) {
        job.penetration.emplace();
    }
    cpu::PointPenetration::Reverse reverse;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        checkpoint();
        const bool reversed = i > 0 && a[i] == b[i - 1] && b[i] == a[i - 1];
        const PenetrationResult& result =
            find_penetration(query, a[i].index, b[i].index, reversed ? &reverse : nullptr, job);
        rows[i] = row_of<PenetrationQuery>(a[i], b[i], result);
        reverse.intersects = result.intersects;
        finish_answers(1);
    }
}

void World::Implementation::find_sampled_penetrations(PenetrationQuery query,
                                                      std::span<const InstanceHandle> a,
                                                      std::span<const InstanceHandle> b,
                                                      std::span<PairRow<PenetrationQuery>> rows) {
    for (std::size_t first = 0; first < rows.size(); first += pairs_of_batch) {
        const std::size_t end = std::min(first + pairs_of_batch, rows.size());
        batch_.clear();
        for (std::size_t i = first; i < end; ++i) {
            query.a = instance_of(a[i].index);
            query.b = instance_of(b[i].index);
            batch_.add(query);
        }
        run_batch();
        for (std::size_t i = first; i < end; ++i) {
            rows[i] = row_of<PenetrationQuery>(
                a[i], b[i], *std::get_if<PenetrationResult>(&results_.results[i - first]));
        }
    }
}

void World::Implementation::find_penetrations(const PenetrationQuery& asked,
                                              std::span<const InstanceHandle> a,
                                              std::span<const InstanceHandle> b,
                                              std::span<PairRow<PenetrationQuery>> rows) {
    PenetrationQuery query = asked_of_cpu("find_penetrations", asked);
    query.records = false;
    require_pairs("find_penetrations", a, b, rows.size());
    prepare();
    if (query.points == PenetrationPoints::boundary) {
        find_sampled_penetrations(query, a, b, rows);
        return;
    }
    expect_answers(a.size());
    jobs_.divide(a.size(), pairs_of_part,
                 [&](std::uint32_t job, std::size_t first, std::size_t end) {
                     const std::size_t count = end - first;
                     find_penetrations(query, a.subspan(first, count), b.subspan(first, count),
                                       rows.subspan(first, count), scratch_[job]);
                 });
}

}  // namespace nearfield
