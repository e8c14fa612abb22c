#include <nearfield/nearfield.hpp>

#include <tests/bench/awkward_families.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::bench {
namespace {

using test::Rings;

constexpr int frames = 2;
// Shapes are 2 across.
constexpr double tolerance = 0.02;

Ring regular_ring(int vertices, double (*radius)(int vertex), double scale) {
    Ring ring;
    for (int i = 0; i < vertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / vertices;
        ring.push_back({scale * radius(i) * std::cos(angle), scale * radius(i) * std::sin(angle)});
    }
    return ring;
}

Rings nested_pentagons(int rings) {
    Rings all;
    for (int i = 0; i < rings; ++i) {
        all.push_back(regular_ring(
            5, [](int) { return 1.0; }, 1.0 - static_cast<double>(i) / rings));
    }
    return all;
}

Rings star_of_spikes(int spikes) {
    return {regular_ring(
        2 * spikes, [](int i) { return i % 2 == 0 ? 1.0 : 0.5; }, 1.0)};
}

struct AwkwardFamily {
    const char* name;
    Rings (*make)(int size);
    std::vector<int> sizes;
    std::vector<Technique> techniques;
    Pose pose;  // of the second shape
};

void add_query(bool contacts, Technique technique, const Instance& a, const Instance& b,
               Batch& batch) {
    if (contacts) {
        ContactQuery query{a, b, tolerance};
        query.contact_distance = 2.0 * tolerance;
        query.summary_only = true;
        query.technique = technique;
        batch.add(query);
    } else {
        PenetrationQuery query{a, b, tolerance};
        query.summary_only = true;
        query.technique = technique;
        batch.add(query);
    }
}

std::uint32_t count_of(const AnyResult& any) {
    return std::visit(
        [](const auto& result) -> std::uint32_t {
            if (!result.status.ok()) {
                throw std::runtime_error(result.status.text());
            }
            if constexpr (requires { result.count; }) {
                return static_cast<std::uint32_t>(result.count);
            }
            return 0;
        },
        any);
}

struct Measured {
    double seconds;
    std::uint32_t answers;
};

/// The least processor time over a few frames, that of the software device included.
Measured measure(Context& context, const AwkwardFamily& family, int size, bool contacts,
                 Technique technique) {
    const Rings rings = family.make(size);
    const Expected<ShapeHandle> a = context.add_shape(rings);
    const Expected<ShapeHandle> b = context.add_shape(rings);
    if (!a || !b) {
        throw std::runtime_error("a shape was refused");
    }
    Batch batch;
    Results results;
    Measured measured{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < frames; ++i) {
        batch.clear();
        add_query(contacts, technique, {*a, {}}, {*b, family.pose}, batch);
        const std::clock_t start = std::clock();
        if (Status status = context.run(batch, results); !status.ok()) {
            throw std::runtime_error(status.text());
        }
        measured.seconds =
            std::min(measured.seconds, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    measured.answers = count_of(results.results.front());
    static_cast<void>(context.remove_shape(*a));
    static_cast<void>(context.remove_shape(*b));
    return measured;
}

void print_row(Context& context, const AwkwardFamily& family, bool contacts, Technique technique) {
    std::string sizes;
    std::string seconds;
    std::string factors;
    std::string answers;
    double before = 0.0;
    for (const int size : family.sizes) {
        const Measured measured = measure(context, family, size, contacts, technique);
        const char* const comma = sizes.empty() ? "" : ", ";
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%s%.3g", comma, measured.seconds);
        seconds += text.data();
        if (before > 0.0) {
            std::snprintf(text.data(), text.size(), "%s%.1f", factors.empty() ? "" : ", ",
                          measured.seconds / before);
            factors += text.data();
        }
        before = measured.seconds;
        sizes += comma + std::to_string(size);
        answers += comma + std::to_string(measured.answers);
    }
    const std::string name(to_string(technique));
    std::printf("| %s | %s | %s | %s | %s | %s | %s |\n", family.name,
                contacts ? "contacts" : "penetration", name.c_str(), sizes.c_str(), seconds.c_str(),
                factors.c_str(), answers.c_str());
    std::fflush(stdout);
}

}  // namespace

void print_awkward_families(Context& context) {
    const std::vector<AwkwardFamily> families{
        {"nested pentagons with themselves (rings)",
         nested_pentagons,
         {250, 500, 1000, 2000},
         {Technique::cpu, Technique::compute, Technique::raster},
         {}},
        {"two stars that overlap (spikes of each)",
         star_of_spikes,
         {5000, 10000, 20000},
         {Technique::cpu},
         {{0.3, 0.2}, 0.0}},
        {"the same",
         star_of_spikes,
         {1250, 2500, 5000},
         {Technique::compute, Technique::raster},
         {{0.3, 0.2}, 0.0}}};
    std::printf(
        "\n| family | query | technique | sizes | seconds | factors | answers |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const AwkwardFamily& family : families) {
        for (const bool contacts : {true, false}) {
            for (const Technique technique : family.techniques) {
                print_row(context, family, contacts, technique);
            }
        }
    }
}

}  // namespace nearfield::bench
