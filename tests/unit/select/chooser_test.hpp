#pragma once

#include <engine/plan/query_shapes.hpp>
#include <engine/select/technique_selector.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::select {

inline Technique technique_of(const AnyQuery& query) {
    return std::visit([](const auto& asked) { return asked.technique; }, query);
}

class ChooserTest : public testing::Test {
protected:
    void SetUp() override {
        test::Random random(1);
        ASSERT_TRUE(small_.assign(test::star(random, 12, 0.5)).ok());
        ASSERT_TRUE(large_.assign(test::coast(random, 4000, 0.2)).ok());
    }

    [[nodiscard]] plan::FindShape find() const {
        return [this](ShapeHandle handle) -> const geometry::Polygon* {
            return handle.index == 0 ? &small_ : handle.index == 1 ? &large_ : nullptr;
        };
    }

    static PenetrationQuery penetration(double tolerance) {
        PenetrationQuery query;
        query.a.shape = {0, 0};
        query.b = {{1, 0}, {{0.4, 0.1}, 0.3}};
        query.tolerance = tolerance;
        return query;
    }
    static DistanceFieldQuery field(double tolerance) {
        DistanceFieldQuery query;
        query.b.shape = {1, 0};
        query.tolerance = tolerance;
        query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        return query;
    }

    std::vector<AnyQuery> choose(const CostModel& costs, std::vector<AnyQuery> queries,
                                 std::uint64_t largest_range = std::uint64_t{1} << 27U) const {
        std::vector<plan::QueryShapes> shapes;
        plan::find_shapes(queries, find(), shapes);
        TechniqueSelector(costs, {}, largest_range).choose(queries, shapes);
        return queries;
    }

    /// A device that is fast after a fixed cost, and a processor without a fixed cost.
    static CostModel costs() {
        CostModel costs;
        costs.raster.submission = costs.compute.submission = 60.0;
        costs.raster.latency = costs.compute.latency = 40.0;
        QueryCosts& cpu = costs.cpu.answer;
        cpu.points = cpu.closest = cpu.intersection = cpu.field = cpu.features = {1.0, 0.01, 1.0};
        costs.raster.device.points = costs.raster.device.field = {1.0, 0.01, 0.01};
        costs.compute.device.points = costs.compute.device.field = {1.0, 0.01, 0.02};
        return costs;
    }

    geometry::Polygon small_;
    geometry::Polygon large_;
};

}  // namespace nearfield::select
