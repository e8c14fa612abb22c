// Measures queries of all pairs of a world in which everything moves, answered by the device and by
// the CPU, and prints tables in Markdown.

#include <nearfield/nearfield.hpp>

#include <tests/bench/clocks.hpp>
#include <tests/bench/crowd.hpp>
#include <tests/bench/take.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nearfield::bench::Crowd;
using nearfield::bench::median;
using nearfield::bench::processor_milliseconds;
using nearfield::bench::require;
using nearfield::bench::take;
using nearfield::bench::wall_milliseconds;

using nearfield::ContactQuery;
using nearfield::Context;
using nearfield::IntersectionTestQuery;
using nearfield::PairRow;
using nearfield::PairTable;
using nearfield::PenetrationPoints;
using nearfield::PenetrationQuery;
using nearfield::SeparationQuery;
using nearfield::Technique;

struct Times {
    double move = 0.0;  // of the CPU, as all that follow but `whole`
    double update = 0.0;
    double whole = 0.0;   // of the update, as a clock shows it
    double read = 0.0;    // of all rows
    double upload = 0.0;  // as a clock shows it, with recording: what the CPU does of the update
    std::vector<nearfield::PassTime> passes;
};

/// A number of a row, so that none is left out.
double number_of(const PairRow<PenetrationQuery>& row) {
    return row.count > 0 ? row.deepest.depth : 0.0;
}

double number_of(const PairRow<ContactQuery>& row) {
    return row.count;
}

double number_of(const PairRow<IntersectionTestQuery>& row) {
    return row.error_bound;
}

double number_of(const PairRow<SeparationQuery>& row) {
    return row.distance;
}

template <class Query>
double read_all(PairTable<Query>& table) {
    double sum = 0.0;
    for (const auto& row : table.rows()) {
        sum += number_of(row);
    }
    require(table.read_status());
    return sum;
}

template <class Query>
Times measure(Crowd& crowd, PairTable<Query>& table, int frames) {
    std::vector<double> move;
    std::vector<double> update;
    std::vector<double> whole;
    std::vector<double> read;
    std::vector<double> upload;
    Times times;
    double sum = 0.0;
    for (int frame = -2; frame < frames; ++frame) {
        const double start = processor_milliseconds();
        crowd.move();
        const double moved = processor_milliseconds();
        const double begin = wall_milliseconds();
        require(crowd.world().update(table));
        const double end = wall_milliseconds();
        const double updated = processor_milliseconds();
        sum += read_all(table);
        const double done = processor_milliseconds();
        if (frame >= 0) {
            move.push_back(moved - start);
            update.push_back(updated - moved);
            whole.push_back(end - begin);
            read.push_back(done - updated);
            upload.push_back(table.timings().plan + table.timings().record +
                             table.timings().decode);
        }
    }
    if (!std::isfinite(sum)) {
        throw std::runtime_error("depths are not finite");
    }
    times.passes = table.timings().passes;
    times.move = median(move);
    times.update = median(update);
    times.whole = median(whole);
    times.read = median(read);
    times.upload = median(upload);
    return times;
}

const char* kind_of(const PenetrationQuery& query) {
    return query.points == PenetrationPoints::vertices ? "penetration, vertices"
                                                       : "penetration, samples";
}

const char* kind_of(const ContactQuery& /*query*/) {
    return "contacts";
}

const char* kind_of(const IntersectionTestQuery& /*query*/) {
    return "intersection test";
}

const char* kind_of(const SeparationQuery& /*query*/) {
    return "separation";
}

/// Of queries whose answer is a distance.
constexpr double reach = 0.05;

template <class Query>
bool has_records(const Query& query) {
    if constexpr (requires { query.summary_only; }) {
        return !query.summary_only;
    } else {
        return false;
    }
}

template <class Query>
void compare(Context& context, std::uint32_t count, double side, const Query& query, int frames,
             bool shows_passes) {
    Crowd crowd(context, count, side);
    PairTable<Query> on_device(
        query, {.reach = reach, .hits_only = true, .technique = Technique::compute});
    PairTable<Query> on_cpu(query,
                            {.reach = reach, .hits_only = true, .technique = Technique::cpu});
    const Times device = measure(crowd, on_device, frames);
    const Times cpu = measure(crowd, on_cpu, frames);
    std::printf("| %u | %s | %s | %u | %u | %u | %.3f | %.3f | %.3f | %.3f | %.2f | %.2f |\n",
                count, kind_of(query), has_records(query) ? "yes" : "no", on_device.candidates(),
                on_device.size(), on_device.left_to_cpu(), device.move, device.upload, device.whole,
                device.read, cpu.update + cpu.read, device.whole / (cpu.update + cpu.read));
    if (shows_passes) {
        for (const nearfield::PassTime& pass : device.passes) {
            std::fprintf(stderr, "  %s %.3f\n", pass.name.c_str(), pass.milliseconds);
        }
    }
    std::fflush(stdout);
}

/// Says so if the device has no room for a world.
template <class Query>
void try_to_compare(Context& context, std::uint32_t count, double side, const Query& query,
                    int frames, bool shows_passes) {
    try {
        compare(context, count, side, query, frames, shows_passes);
    } catch (const std::runtime_error& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

/// Worlds of several sizes.
template <class Query>
void compare_all(Context& context, const Query& query, bool shows_passes) {
    compare(context, 1'000, 50.0, query, 20, shows_passes);
    try_to_compare(context, 1'000, 16.0, query, 10, false);
    try_to_compare(context, 1'000, 7.5, query, 5, false);
    try_to_compare(context, 40'000, 320.0, query, 5, shows_passes);
}

}  // namespace

int main(int count, char** arguments) {
    const bool shows_passes = count > 1 && std::string(arguments[1]) == "--passes";
    try {
        nearfield::Settings settings;
        settings.timestamps = shows_passes;
        Context context = take(Context::create_headless({}, settings));
        std::printf("Device: %s\n\n", context.device_name().c_str());
        std::puts(
            "| objects | query | records | pairs | rows | left | CPU: move | CPU: update | update "
            "| CPU: read all rows | cpu: update | update / cpu |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|");
        compare_all(context, IntersectionTestQuery{}, shows_passes);
        compare_all(context, SeparationQuery{.tolerance = 0.03}, shows_passes);
        ContactQuery contacts{.tolerance = 0.03, .contact_distance = 0.05, .summary_only = false};
        compare(context, 1'000, 50.0, contacts, 20, shows_passes);
        contacts.summary_only = true;
        compare_all(context, contacts, shows_passes);
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            PenetrationQuery query{.tolerance = 0.03, .points = points, .summary_only = false};
            compare(context, 1'000, 50.0, query, 20, shows_passes);
            try_to_compare(context, 1'000, 16.0, query, 5, false);
            query.summary_only = true;
            compare_all(context, query, shows_passes);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
