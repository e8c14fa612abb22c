#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/host_table.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/pair_tables.hpp>

#include <chrono>
#include <map>
#include <string>
#include <thread>

namespace nearfield::test {
namespace {

const std::vector<Vector2> unit_ring{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
const std::vector<Vector2> triangle{{-0.8, -0.5}, {0.9, -0.4}, {0.1, 1.1}};

struct Shapes {
    explicit Shapes(Context& context) : a(add(context, unit_ring)), b(add(context, triangle)) {}

    static ShapeHandle add(Context& context, const std::vector<Vector2>& ring) {
        const Ring rings[] = {Ring(ring)};
        return *context.add_shape(rings);
    }

    ShapeHandle a;
    ShapeHandle b;
};

Context make_cpu() {
    Expected<Context> made = Context::create_cpu();
    EXPECT_TRUE(made.has_value()) << made.error().text();
    return std::move(*made);
}

/// Every query of every kind that Technique::cpu answers, by `technique`, which is cpu or
/// automatic.
Batch every_query_of_cpu(const Shapes& shapes, Technique technique) {
    Batch batch;
    const Batch every = every_query(shapes.a, shapes.b, 1);
    for (const AnyQuery& any : every.queries()) {
        std::visit(
            [&](auto query) {
                query.technique = technique;
                if constexpr (requires { query.gradient; }) {
                    if (query.gradient == GradientMethod::blended) {
                        query.gradient = GradientMethod::analytic;
                    }
                }
                batch.add(query);
            },
            any);
    }
    return batch;
}

class CpuContext : public QueryTest {};

TEST_F(CpuContext, AnswersEveryKindOfQueryAsAContextWithADeviceDoes) {
    Context alone = make_cpu();
    const Shapes shapes(alone);
    const Shapes shapes_beside(context());
    for (const Technique technique : {Technique::cpu, Technique::automatic}) {
        Results results;
        ASSERT_TRUE(alone.run(every_query_of_cpu(shapes, technique), results).ok());
        Results beside;
        ASSERT_TRUE(context().run(every_query_of_cpu(shapes_beside, Technique::cpu), beside).ok());
        for (const AnyResult& result : results.results) {
            std::visit(
                [](const ResultSummary& any) {
                    EXPECT_TRUE(any.status.ok()) << any.status.text();
                    EXPECT_EQ(any.technique, Technique::cpu);
                },
                result);
        }
        EXPECT_EQ(all_numbers(results), all_numbers(beside));
    }
}

TEST_F(CpuContext, RefusesWhatNeedsADeviceInTheResultsOfThoseQueriesAlone) {
    Context context = make_cpu();
    const Shapes shapes(context);
    const Instance a{shapes.a, {}};
    const Instance b{shapes.b, {}};
    Batch batch;
    const auto refused = [&](auto query, auto change) {
        change(query);
        return batch.add(query);
    };
    const PenetrationQuery penetration{a, b, 0.1};
    DistanceFieldQuery field;
    field.b = b;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    const auto raster = refused(penetration, [](auto& q) { q.technique = Technique::raster; });
    const auto compute = refused(penetration, [](auto& q) { q.technique = Technique::compute; });
    const auto resident = refused(penetration, [](auto& q) { q.on_device = true; });
    const auto blended = refused(field, [](auto& q) {
        q.gradients = true;
        q.gradient = GradientMethod::blended;
    });
    const auto answered = batch.add(penetration);
    Results results;
    ASSERT_TRUE(context.run(batch, results).ok());
    const auto expect_refused = [](const Status& status, const std::string& what) {
        EXPECT_EQ(status.code(), StatusCode::unsupported_technique);
        EXPECT_NE(status.message().find(what), std::string::npos) << status.text();
        EXPECT_NE(status.message().find("create_cpu"), std::string::npos) << status.text();
    };
    expect_refused(results[raster].status, "technique raster");
    expect_refused(results[compute].status, "technique compute");
    expect_refused(results[resident].status, "on_device");
    expect_refused(results[blended].status, "blended gradients");
    EXPECT_TRUE(results[answered].status.ok()) << results[answered].status.text();
    EXPECT_GT(results[answered].count, 0U);
    const Expected<Ticket> ticket = context.submit(batch);
    ASSERT_TRUE(ticket.has_value());
    EXPECT_EQ(context.on_device(*ticket, resident).error().code(),
              StatusCode::unsupported_technique);
    EXPECT_TRUE(context.is_ready(*ticket));
    ASSERT_TRUE(context.collect(*ticket, results).ok());
    EXPECT_TRUE(results[answered].status.ok());
}

TEST_F(CpuContext, RefusesCallsThatNeedADevice) {
    Context context = make_cpu();
    const Shapes shapes(context);
    Batch batch;
    batch.add(PenetrationQuery{{shapes.a, {}}, {shapes.b, {}}, 0.1});
    Recording recording;
    EXPECT_EQ(context.record(batch, recording).error().code(), StatusCode::no_device);
    const SemaphoreWait wait{};
    Submission submission;
    submission.waits = {&wait, 1};
    EXPECT_EQ(context.submit(batch, submission).error().code(), StatusCode::no_device);
    EXPECT_FALSE(reload_shaders(context).has_value());
    EXPECT_EQ(context.device_name(), "");
    EXPECT_EQ(context.memory_use().peak, 0U);
    EXPECT_EQ(*describe_graph(context, GraphFormat::text), "");
    EXPECT_TRUE(list_tiles(context)->empty());
    Results results;
    EXPECT_TRUE(context.run(batch, results).ok()) << "no batch was left in flight";
}

TEST_F(CpuContext, RefusesBadSettings) {
    Settings settings;
    settings.batches_in_flight = 0;
    EXPECT_EQ(Context::create_cpu(settings).error().code(), StatusCode::invalid_settings);
}

TEST_F(CpuContext, OneQueryIsAnsweredInOneLineOrRefusedWithItsStatus) {
    Context context = make_cpu();
    const Shapes shapes(context);
    const Expected<PenetrationResult> answer =
        context.answer(PenetrationQuery{{shapes.a, {}}, {shapes.b, {}}, 0.1});
    ASSERT_TRUE(answer.has_value()) << answer.error().text();
    EXPECT_GT(answer->count, 0U);
    EXPECT_EQ(answer->points.size(), answer->count);
    EXPECT_EQ(context.answer(PenetrationQuery{{shapes.a, {}}, {shapes.b, {}}, -1.0}).error().code(),
              StatusCode::invalid_query);
    EXPECT_EQ(context.answer(SeparationQuery{{shapes.a, {}}, {}, 0.1}).error().code(),
              StatusCode::unknown_shape);
}

/// Pipelines are created only for the techniques in Settings::techniques.
class TechniqueSettings : public HostTable {
protected:
    /// A context with these techniques; `made` counts calls by name.
    Context make_with(const DeviceTechniques& techniques) {
        const HostDevice& device = watch([this](const test_support::WatchedCall& call) {
            if (call.makes()) {
                ++made_[std::string(call.name)];
            }
        });
        Settings settings;
        settings.techniques = techniques;
        Expected<Context> made = Context::create(device, settings);
        EXPECT_TRUE(made.has_value()) << made.error().text();
        return std::move(*made);
    }

    static Status status_by(Context& context, Technique technique) {
        const Shapes shapes(context);
        PenetrationQuery query{{shapes.a, {}}, {shapes.b, {}}, 0.1};
        query.technique = technique;
        const Expected<PenetrationResult> result = context.answer(query);
        return result.error();
    }

    std::map<std::string, int> made_;
};

TEST_F(TechniqueSettings, WithoutRasterNoGraphicsPipelineIsMade) {
    make_host();
    Context context = make_with({.raster = false, .compute = true});
    EXPECT_EQ(made_["vkCreateGraphicsPipelines"], 0);
    EXPECT_GT(made_["vkCreateComputePipelines"], 0);
    EXPECT_TRUE(status_by(context, Technique::compute).ok());
    EXPECT_TRUE(status_by(context, Technique::automatic).ok());
    const Status refused = status_by(context, Technique::raster);
    EXPECT_EQ(refused.code(), StatusCode::unsupported_technique);
    EXPECT_NE(refused.message().find("Settings::techniques"), std::string::npos);
    EXPECT_EQ(made_["vkCreateGraphicsPipelines"], 0);
}

TEST_F(TechniqueSettings, WithoutComputeLessPipelinesAreMadeAndTheRasterAnswers) {
    make_host();
    { const Context all = make_with({}); }
    const int by_all = made_["vkCreateComputePipelines"];
    made_.clear();
    Context context = make_with({.raster = true, .compute = false});
    EXPECT_LT(made_["vkCreateComputePipelines"], by_all);
    EXPECT_GT(made_["vkCreateGraphicsPipelines"], 0);
    EXPECT_TRUE(status_by(context, Technique::raster).ok());
    EXPECT_EQ(status_by(context, Technique::compute).code(), StatusCode::unsupported_technique);
}

/// However long the driver takes.
TEST_F(TechniqueSettings, PipelinesMadeOnDemandAreInNoTime) {
    make_host();
    constexpr double each = 20.0;  // milliseconds
    int made = 0;
    const HostDevice& device = watch([&](const test_support::WatchedCall& call) {
        if (call.name == "vkCreateComputePipelines") {
            ++made;
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(each));
        }
    });
    Context context = *Context::create(device, on_demand());
    const Shapes shapes(context);
    const auto expect_without = [&](const auto& call) {
        made = 0;
        const auto start = std::chrono::steady_clock::now();
        const Timings timings = call();
        const std::chrono::duration<double, std::milli> whole =
            std::chrono::steady_clock::now() - start;
        EXPECT_GT(made, 5);
        EXPECT_GE(whole.count() - timings.total, each * made);
        EXPECT_LE(timings.plan, timings.total);
    };
    PenetrationQuery query{{shapes.a, {}}, {shapes.b, {}}, 0.1};
    query.technique = Technique::compute;
    expect_without([&] {
        Batch batch;
        batch.add(query);
        Results results;
        EXPECT_TRUE(context.run(batch, results).ok());
        return results.timings;
    });
    World world = *World::create(context);
    for (const ShapeHandle shape : {shapes.a, shapes.b}) {
        EXPECT_TRUE(world.add({.shape = shape}).has_value());
    }
    PairTable table(PenetrationQuery{.tolerance = 0.1}, on_device);
    expect_without([&] {
        EXPECT_TRUE(world.update(table).ok());
        return table.timings();
    });
}

TEST_F(TechniqueSettings, AutomaticChoosesAmongThoseThatAreThere) {
    make_host();
    Settings settings = on_demand();
    settings.techniques.raster = false;
    Context context = *Context::create(host(), settings);
    const Shapes shapes(context);
    const PenetrationQuery query{{shapes.a, {}}, {shapes.b, {}}, 0.1};
    EXPECT_NE(context.answer(query)->technique, Technique::raster);
    PenetrationQuery resident = query;
    resident.on_device = true;
    EXPECT_EQ(context.answer(resident)->technique, Technique::compute);
    DistanceFieldQuery blended;
    blended.b = query.b;
    blended.tolerance = 0.1;
    blended.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    blended.gradients = true;
    blended.gradient = GradientMethod::blended;
    const Status status = context.answer(blended).error();
    EXPECT_EQ(status.code(), StatusCode::unsupported_technique);
    EXPECT_NE(status.message().find("Settings::techniques"), std::string::npos) << status.text();
}

}  // namespace
}  // namespace nearfield::test
