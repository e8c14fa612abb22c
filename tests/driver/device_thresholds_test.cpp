#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

/// Which technique Technique::automatic is in a context on a device of some type.
class DeviceThresholdsOf : public testing::Test {
protected:
    void make(VkPhysicalDeviceType type, const Settings& settings) {
        context_.reset();
        driver_.set_device_type(type);
        Expected<Context> made = Context::create(driver_.host(), settings);
        ASSERT_TRUE(made.has_value()) << made.error().text();
        context_.emplace(std::move(*made));
        const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        shape_ = *context_->add_shape(square);
    }
    ~DeviceThresholdsOf() override {
        context_.reset();
        EXPECT_EQ(driver_.breaches(), std::vector<std::string>{});
    }

    template <class Query>
    [[nodiscard]] Query query() const {
        Query query;
        query.a = {shape_, {}};
        query.b = {shape_, {{0.5, 0.5}, 0.1}};
        query.tolerance = 0.1;
        return query;
    }
    /// The technique of all the queries.
    [[nodiscard]] Technique chosen(const std::vector<AnyQuery>& queries) {
        Batch batch;
        for (const AnyQuery& any : queries) {
            std::visit([&](const auto& one) { batch.add(one); }, any);
        }
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        std::optional<Technique> technique;
        for (const AnyResult& result : results.results) {
            std::visit(
                [&](const ResultSummary& any) {
                    EXPECT_TRUE(any.status.ok()) << any.status.text();
                    EXPECT_EQ(technique.value_or(any.technique), any.technique);
                    technique = any.technique;
                },
                result);
        }
        return technique.value_or(Technique::automatic);
    }

    test_support::MockDriver driver_;
    std::optional<Context> context_;
    ShapeHandle shape_;
};

constexpr VkPhysicalDeviceType hardware[] = {
    VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
    VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER};

TEST_F(DeviceThresholdsOf, HardwareAreThoseOfTheSettings) {
    Settings settings;
    settings.device_thresholds = {.pairs = 3, .cells = 40};
    for (const VkPhysicalDeviceType type : hardware) {
        make(type, settings);
        std::vector<AnyQuery> queries(2, query<PenetrationQuery>());
        EXPECT_EQ(chosen(queries), Technique::cpu);
        queries.emplace_back(query<IntersectionQuery>());
        EXPECT_EQ(chosen(queries), Technique::compute);
        auto field = query<DistanceFieldQuery>();
        field.rectangle = Rectangle{{0.0, 0.0}, {0.5, 0.5}};  // 4 x 4 cells
        EXPECT_EQ(chosen({field, field}), Technique::cpu);
        EXPECT_EQ(chosen({field, field, field}), Technique::compute);
    }
}

TEST_F(DeviceThresholdsOf, HardwareAreManyPairsAndCellsByDefault) {
    make(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {});
    auto pair = query<PenetrationQuery>();
    pair.summary_only = true;
    pair.points = PenetrationPoints::vertices;
    EXPECT_EQ(chosen(std::vector<AnyQuery>(1999, pair)), Technique::cpu);
    EXPECT_EQ(chosen(std::vector<AnyQuery>(2000, pair)), Technique::compute);
    auto field = query<DistanceFieldQuery>();
    field.tolerance = 0.01;
    const double side = 0.01 * std::sqrt(2.0);
    field.rectangle = Rectangle{{0.0, 0.0}, {256.0 * side, 255.0 * side}};
    EXPECT_EQ(chosen({field}), Technique::cpu);
    field.rectangle->max.y += side;
    EXPECT_EQ(chosen({field}), Technique::compute);
}

TEST_F(DeviceThresholdsOf, SoftwareAreNone) {
    make(VK_PHYSICAL_DEVICE_TYPE_CPU, {.device_thresholds = {.pairs = 0, .cells = 0}});
    EXPECT_EQ(chosen({query<PenetrationQuery>(), query<DistanceFieldQuery>()}), Technique::cpu);
    auto resident = query<PenetrationQuery>();
    resident.on_device = true;
    EXPECT_EQ(chosen({resident}), Technique::compute);
}

}  // namespace
}  // namespace nearfield::test
