#include <tests/query/steady_state.hpp>
#include <tests/support/watched_loader.hpp>

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace nearfield::test {

std::uint64_t SteadyStateTest::allocations_below = 0;
std::vector<std::string> SteadyStateTest::created;
int SteadyStateTest::waits_and_submissions = 0;

namespace {

/// See batch().
Batch frame(ShapeHandle a, ShapeHandle b) {
    Batch batch;
    // All contacts in one square of GradientNormals: the number of fields is then the same in
    // every frame, whatever the forms.
    const Instance here{a, {{5.0, 5.0}, 0.0}};
    const Instance there{b, {{5.7, 5.1}, 0.3}};
    const Instance apart{b, {{8.5, 5.1}, 0.3}};
    for (const Technique technique : every_technique) {
        for (const PenetrationPoints points :
             {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            batch.add(PenetrationQuery{here, there, 0.08, points, false, technique});
        }
        batch.add(ContactQuery{here, there, 0.08, 0.05, {}, false, technique});
        batch.add(SeparationQuery{here, apart, 0.08, technique});
        batch.add(ClosestPointQuery{here, apart, 0.08, technique});
    }
    batch.add(drawn(ContactQuery{here, there, 0.08, 0.05, ContactNormals::gradient}));
    DistanceFieldQuery field;
    field.b = there;
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{4.0, 4.0}, {6.0, 6.0}};
    field.features = true;
    static constexpr Vector2 points[] = {{5.1, 5.2}, {4.7, 5.4}};
    field.points = points;
    for (const Technique technique : device_techniques) {
        field.technique = technique;
        batch.add(field);
        for (const IntersectionKind kind :
             {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
            batch.add(IntersectionQuery{here, there, 0.08, kind, false,
                                        IntersectionStrategy::stencil, technique});
        }
    }
    return batch;
}

}  // namespace

void SteadyStateTest::SetUp() {
    loader_.emplace(host_device(),
                    test_support::watched(host_device(), [](const test_support::WatchedCall& call) {
                        allocations_below += call.allocations;
                        if (call.makes() || call.destroys() || call.name.starts_with("vkMap")) {
                            created.emplace_back(call.name);
                        }
                        if (call.name.starts_with("vkWait") || call.name == "vkQueueSubmit") {
                            ++waits_and_submissions;
                        }
                    }));
    Expected<Context> made = Context::create(loader_->host(), on_demand({.timestamps = true}));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    watched_.emplace(std::move(*made));
    EXPECT_FALSE(created.empty()) << "nothing is counted";
    Random random(31);
    for (const double size : {1.0, 0.9, 1.1}) {
        rings_a_.push_back(coast(random, 60 + static_cast<int>(20 * size), 0.5));
        rings_b_.push_back(scaled_and_moved(with_holes(random, 3), size, {}));
    }
    const Expected<ShapeHandle> a = watched_->add_shape(rings_a_.front());
    const Expected<ShapeHandle> b = watched_->add_shape(rings_b_.front());
    ASSERT_TRUE(a.has_value() && b.has_value());
    a_ = *a;
    b_ = *b;
    batch_ = frame(a_, b_);
}

void SteadyStateTest::TearDown() {
    watched_.reset();
    loader_.reset();
    QueryTest::TearDown();
}

bool SteadyStateTest::deform(int frame) {
    const auto form = static_cast<std::size_t>(frame) % rings_a_.size();
    return watched_->update_shape(a_, rings_a_[form]).ok() &&
           watched_->update_shape(b_, rings_b_[form]).ok();
}

void SteadyStateTest::expect_answers(const Results& results) {
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        SCOPED_TRACE("query " + std::to_string(i));
        std::visit(
            []<class Result>(const Result& result) {
                EXPECT_TRUE(result.status.ok()) << result.status.text();
                const bool is_by_cpu = result.technique == Technique::cpu ||
                                       (result.technique == Technique::compute &&
                                        (std::is_same_v<Result, ClosestPointResult> ||
                                         std::is_same_v<Result, SeparationResult>));
                EXPECT_TRUE(is_by_cpu || !result.regions.empty());
            },
            results.results[i]);
    }
}

}  // namespace nearfield::test
