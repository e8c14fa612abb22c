#include <engine/base/interruption.hpp>
#include <engine/batch/gradient_contacts.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/query_timer.hpp>

namespace nearfield::batch {

void GradientContacts::complete(BatchRunner& main) {
    Results& results = main.results();
    for (const std::uint32_t index : main.with_gradient_normals()) {
        const device_input::PlannedQuery& planned = main.plan().queries[index];
        auto& result = std::get<ContactResult>(results.results[index]);
        if (!result.status.ok()) {
            continue;
        }
        try {
            {
                const queries::QueryTimer timer(main.plan().times, index, &QueryTime::answer);
                const std::uint32_t reverse = planned.points().reverse;
                decoder_.find({planned, main.points_of(index)},
                              {main.plan().queries[reverse], main.points_of(reverse)}, result.cell,
                              contacts_);
            }
            set_normals(planned, result, results.timings);
            if (result.status.ok()) {
                const queries::QueryTimer timer(main.plan().times, index, &QueryTime::answer);
                contacts_.write(*planned.a, *planned.b, std::get<ContactQuery>(*planned.query),
                                result);
            }
        } catch (const Interrupted& interrupted) {
            queries::cut_short(interrupted.status(), results.results[index]);
        }
    }
}

void GradientContacts::set_normals(const device_input::PlannedQuery& planned, ContactResult& result,
                                   Timings& timings) {
    const auto& asked = std::get<ContactQuery>(*planned.query);
    const std::span<const AnyQuery> fields =
        normals_.fields_around(contacts_, asked, asked.technique, result.cell);
    if (fields.empty()) {
        return;
    }
    // Use B as it was submitted, whatever it is now.
    const auto find_shape = [&planned](ShapeHandle shape) {
        return shape == ShapeHandle{} ? nullptr : planned.b;
    };
    Laps laps;
    runner_.submit(fields, find_shape, laps);
    runner_.collect(laps);
    const Results& found = runner_.results();
    timings.localize += found.timings.localize;
    timings.plan += found.timings.plan;
    timings.record += found.timings.record;
    timings.device += found.timings.device;
    timings.decode += found.timings.decode;
    result.status = normals_.set(found.results, contacts_);
}

}  // namespace nearfield::batch
