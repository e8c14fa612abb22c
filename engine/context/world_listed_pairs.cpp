// Queries of a world about lists of pairs that are the caller's own.

#include <engine/base/interruption.hpp>
#include <engine/context/call_within.hpp>
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

constexpr const char* test_pairs_call = "test_pairs";
constexpr const char* find_penetrations_call = "find_penetrations";

[[noreturn]] void refuse_lengths(const char* call, std::size_t a, std::size_t b,
                                 std::size_t answers) {
    refuse(call, std::to_string(a) + " and " + std::to_string(b) +
                     " instances form no pairs with space for " + std::to_string(answers) +
                     " answers");
}

}  // namespace

inline void World::Implementation::test_pairs_of_part(std::span<const InstanceHandle> a,
                                                      std::span<const InstanceHandle> b,
                                                      std::span<std::uint8_t> intersects,
                                                      Job& job) const {
    for (std::size_t i = 0; i < a.size(); ++i) {
        checkpoint();
        const std::uint32_t one = instances_.find(a[i], test_pairs_call);
        const std::uint32_t other = instances_.find(b[i], test_pairs_call);
        intersects[i] = instances_.intersect(one, other, job.overlap_test) ? 1 : 0;
    }
    finish_answers(a.size());
}

void World::Implementation::test_many_pairs(std::span<const InstanceHandle> a,
                                            std::span<const InstanceHandle> b,
                                            std::span<std::uint8_t> intersects) {
    jobs_.divide(a.size(), pairs_of_part,
                 [&](std::uint32_t job, std::size_t first, std::size_t end) {
                     const std::size_t count = end - first;
                     test_pairs_of_part(a.subspan(first, count), b.subspan(first, count),
                                        intersects.subspan(first, count), scratch_[job]);
                 });
}

/// Of few pairs, what goes on around them takes as long as they do.
inline void World::Implementation::test_pairs(std::span<const InstanceHandle> a,
                                              std::span<const InstanceHandle> b,
                                              std::span<std::uint8_t> intersects) {
    if (a.size() != intersects.size() || b.size() != intersects.size()) {
        refuse_lengths(test_pairs_call, a.size(), b.size(), intersects.size());
    }
    prepare();
    expect_answers(a.size());
    if (a.size() <= pairs_of_part) {
        test_pairs_of_part(a, b, intersects, scratch_.front());
    } else {
        test_many_pairs(a, b, intersects);
    }
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
        const std::uint32_t one = instances_.find(a[i], find_penetrations_call);
        const std::uint32_t other = instances_.find(b[i], find_penetrations_call);
        const PenetrationResult& result =
            find_penetration(query, one, other, reversed ? &reverse : nullptr, job);
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
            query.a = instance_of(instances_.find(a[i], find_penetrations_call));
            query.b = instance_of(instances_.find(b[i], find_penetrations_call));
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
    PenetrationQuery query = asked_of_cpu(find_penetrations_call, asked);
    query.records = false;
    if (a.size() != rows.size() || b.size() != rows.size()) {
        refuse_lengths(find_penetrations_call, a.size(), b.size(), rows.size());
    }
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

Status World::test_pairs(std::span<const InstanceHandle> a, std::span<const InstanceHandle> b,
                         std::span<std::uint8_t> intersects, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->test_pairs(a, b, intersects); });
}

Status World::find_penetrations(const PenetrationQuery& query, std::span<const InstanceHandle> a,
                                std::span<const InstanceHandle> b,
                                std::span<PairRow<PenetrationQuery>> rows, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_penetrations(query, a, b, rows); });
}

}  // namespace nearfield
