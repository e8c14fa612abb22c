#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::test {
namespace {

constexpr std::uint64_t chosen_technique_seed = 1618;

/// Which technique answers, and what none can.
using ChosenTechnique = QueryTest;

/// Settings by which no amount of work selects a hardware device.
Settings never_a_device() {
    Settings settings;
    settings.device_thresholds = {.pairs = UINT64_MAX, .cells = UINT64_MAX};
    return on_demand(settings);
}

TEST_F(ChosenTechnique, AutomaticIsTheCpuForWhatItAnswers) {
    Expected<Context> made = Context::create(host_device(), never_a_device());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(chosen_technique_seed);
    const PlacedPair pair(
        *made,
        {{"A", star(random, 9, 0.5)}, {"B", star(random, 9, 0.5)}, {}, {{0.5, 0.2}, 0.0}, 0.05},
        Technique::automatic);
    const auto expect = [&](const auto& query, Technique technique) {
        const auto result = run_alone(*made, query);
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.technique, technique);
    };
    const auto expect_resident = [&](auto query) {
        expect(query, Technique::cpu);
        query.on_device = true;
        expect(query, Technique::compute);
    };
    expect_resident(pair.penetration());
    expect_resident(pair.penetration(PenetrationPoints::vertices));
    expect_resident(pair.contacts(0.1));
    expect_resident(pair.intersection(IntersectionKind::volume_volume));
    DistanceFieldQuery field{pair.instance_a(), pair.instance_b(), 0.05, std::nullopt};
    expect_resident(field);
    field.gradients = true;
    expect_resident(field);
    field.gradient = GradientMethod::blended;
    expect(field, Technique::raster);
    ContactQuery contacts = pair.contacts(0.1);
    contacts.normals = ContactNormals::gradient;
    expect(contacts, Technique::cpu);
    expect(pair.separation(), Technique::cpu);
    expect(pair.closest_point(), Technique::cpu);
    const Instance a = pair.instance_a();
    const Instance b = pair.instance_b();
    expect(IntersectionTestQuery{a, b}, Technique::cpu);
    expect(TimeOfImpactQuery{a, b, a.pose, b.pose, 0.1}, Technique::cpu);
    expect(SeparationVectorQuery{a, b, 0.1}, Technique::cpu);
    expect(ContainmentQuery{a, b}, Technique::cpu);
}

/// Compute refuses a field where too many edges are equally near to a cell, which it finds out
/// while it answers.
TEST_F(ChosenTechnique, AutomaticFieldsAreNotRefused) {
    Settings settings;
    settings.device_thresholds = {.pairs = 0, .cells = 0};
    Expected<Context> made = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const Expected<ShapeHandle> shape =
        made->add_shape(scaled_and_moved(regular(25000), 1e-5, {0.3, 0.3}));
    ASSERT_TRUE(shape.has_value());
    DistanceFieldQuery field{.b = {*shape, {}},
                             .tolerance = 0.05,
                             .rectangle = Rectangle{{0.35, 0.35}, {0.6, 0.6}},
                             .features = true};
    EXPECT_TRUE(run_alone(*made, field).status.ok());
    field.technique = Technique::compute;
    EXPECT_EQ(run_alone(*made, field).status.code(), StatusCode::too_large);
    // The device alone has results that stay there.
    field.technique = Technique::automatic;
    field.on_device = true;
    EXPECT_EQ(run_alone(*made, field).status.code(), StatusCode::too_large);
}

TEST_F(ChosenTechnique, WhatTheCpuDoesNotAnswerIsRefusedByName) {
    const PlacedPair pair(context(),
                          {{"A", regular(5)}, {"B", regular(7)}, {}, {{0.5, 0.2}, 0.0}, 0.05},
                          Technique::cpu);
    const auto expect_refused = [](const Status& status, const std::string& what) {
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find(what), std::string::npos) << status.message();
    };
    DistanceFieldQuery field{pair.instance_a(), pair.instance_b(), 0.05, std::nullopt};
    field.technique = Technique::cpu;
    field.gradients = true;
    field.gradient = GradientMethod::blended;
    expect_refused(run_alone(context(), field).status, "blended");
    PenetrationQuery none = pair.penetration();
    none.technique = static_cast<Technique>(17);
    expect_refused(run_alone(context(), none).status, "no enumerator");
    PenetrationQuery fine = pair.penetration(PenetrationPoints::vertices);
    fine.tolerance = 1e-13;
    fine.a.pose.translation.x = 1e3;
    expect_refused(run_alone(context(), fine).status, "below what double precision resolves");
}

}  // namespace
}  // namespace nearfield::test
