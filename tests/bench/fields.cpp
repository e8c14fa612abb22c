// Distance fields, of 1024 x 1024 cells but for many small ones, by the techniques compute and cpu.
// Time: a whole frame. CPU: of all threads, those of a software device included, which depends less
// on other load. `submission`: until the calling thread has submitted, its processor's time.

#include <nearfield/nearfield.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::bench {
namespace {

/// What is asked about a coast or a star: values, features too, or a number of points.
struct Field {
    std::string name;
    int coast_vertices = 0;  ///< 0: a star of 50 vertices
    bool features = false;
    int points = 0;
};

DistanceFieldQuery field_of(const test::Rings& rings, Context& context, double half, double cells) {
    DistanceFieldQuery query;
    query.b = {take(context.add_shape(rings)), {{}, 0.2}};
    query.rectangle = Rectangle{{-half, -half}, {half, half}};
    query.tolerance = 2.0 * half / (cells - 0.5) / std::numbers::sqrt2;
    return query;
}

/// `points` must outlive the query.
DistanceFieldQuery large_field(Context& context, const Field& field, std::vector<Vector2>& points) {
    test::Random random(2);
    DistanceFieldQuery query =
        field_of(field.coast_vertices > 0 ? test::coast(random, field.coast_vertices, 0.5)
                                          : test::star(random, 50, 0.4),
                 context, 1.5, 1024.0);
    query.b.pose.translation = {0.01, -0.02};
    query.features = field.features;
    for (int i = 0; i < field.points; ++i) {
        points.push_back({random.between(-1.4, 1.4), random.between(-1.4, 1.4)});
    }
    query.points = points;
    query.values = points.empty();
    return query;
}

/// `make(context, points)` makes the queries, and the points that they ask about.
template <class Make>
void add_fields(const std::string& name, Make make) {
    for (const Technique technique : {Technique::compute, Technique::cpu}) {
        add("fields/" + name + "/" + to_string(technique), 21,
            [=](State& state) {
                Context context = take(Context::create_headless());
                Batch batch;
                std::vector<Vector2> points;
                for (DistanceFieldQuery& query : make(context, points)) {
                    query.technique = technique;
                    batch.add(query);
                }
                Results results;
                run(state, [&]() -> Numbers {
                    const double start = processor_milliseconds();
                    const Ticket ticket = take(context.submit(batch));
                    const double submitted = processor_milliseconds();
                    require(context.collect(ticket, results));
                    return {{"submission ms", submitted - start},
                            {"device ms", results.timings.device}};
                });
            })
            ->MeasureProcessCPUTime()
            ->UseRealTime();
    }
}

const bool fields_are_added = [] {
    for (const Field& field :
         {Field{"coast, 8,000 vertices", 8000}, Field{"the same with features", 8000, true},
          Field{"1,000 points of it", 8000, false, 1000}, Field{"star, 50 vertices"},
          Field{"coast, 100,000 vertices", 100'000}}) {
        add_fields(field.name, [field](Context& context, std::vector<Vector2>& points) {
            return std::vector<DistanceFieldQuery>{large_field(context, field, points)};
        });
    }
    add_fields("1,000 stars, 32 x 32 cells each",
               [](Context& context, std::vector<Vector2>& /*points*/) {
                   std::vector<DistanceFieldQuery> queries;
                   for (std::uint64_t seed = 0; seed < 1000; ++seed) {
                       test::Random random(seed);
                       queries.push_back(field_of(test::star(random, 50, 0.4), context, 1.1, 32.0));
                   }
                   return queries;
               });
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
