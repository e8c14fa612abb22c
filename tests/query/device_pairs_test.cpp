#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 24000;

/// Penetrations of all pairs of a world that the device finds, compared with those of the CPU.
class DevicePairs : public QueryTest {
protected:
    /// What a test asks of a world again and again.
    struct Tables {
        explicit Tables(const PenetrationQuery& query) : device(query), cpu(query) {}

        DevicePairTable device;
        PairTable<PenetrationQuery> cpu;
    };

    void SetUp() override {
        Expected<World> made = World::create(context());
        ASSERT_TRUE(made.has_value());
        world_.emplace(std::move(*made));
    }
    void TearDown() override {
        world_.reset();
        for (const ShapeHandle shape : shapes_) {
            EXPECT_TRUE(context().remove_shape(shape).ok());
        }
        QueryTest::TearDown();
    }

    ShapeHandle add_shape(const Rings& rings) {
        const Expected<ShapeHandle> shape = context().add_shape(rings);
        EXPECT_TRUE(shape.has_value()) << shape.error().message();
        shapes_.push_back(*shape);
        return *shape;
    }
    InstanceHandle add(ShapeHandle shape, const Pose& pose) {
        const Expected<InstanceHandle> handle = world_->add({.shape = shape, .pose = pose});
        EXPECT_TRUE(handle.has_value()) << handle.error().message();
        instances_.push_back(*handle);
        return *handle;
    }
    [[nodiscard]] static Pose any_pose(Random& random, double extent) {
        return {.translation = {random.between(-extent, extent), random.between(-extent, extent)},
                .angle = random.between(-4.0, 4.0)};
    }

    static void expect_equal(const PenetrationRecord& found, const PenetrationRecord& truth,
                             double tolerance) {
        const double near = tolerance / 1000.0;
        EXPECT_NEAR(found.depth, truth.depth, near);
        EXPECT_EQ(found.point.x, truth.point.x);
        EXPECT_EQ(found.point.y, truth.point.y);
        if (truth.unique && found.unique) {
            EXPECT_NEAR(found.nearest.x, truth.nearest.x, 0.1 * tolerance + 0.1 * truth.depth);
            EXPECT_NEAR(found.nearest.y, truth.nearest.y, 0.1 * tolerance + 0.1 * truth.depth);
        }
    }

    /// Updates both tables, and compares their rows and records.
    void compare(Tables& tables) {
        const Status status = world().update(tables.device);
        ASSERT_TRUE(status.ok()) << status.message();
        ASSERT_TRUE(world().update(tables.cpu).ok());
        const double tolerance = tables.cpu.query().tolerance;
        std::uint32_t next = 0;
        std::vector<PenetrationRecord> records;
        for (const PairRow<PenetrationQuery>& truth : tables.cpu.rows()) {
            if (truth.count == 0 && truth.status == StatusCode::ok) {
                continue;
            }
            ASSERT_LT(next, tables.device.size());
            const auto row = tables.device.row(next);
            ASSERT_TRUE(row.has_value()) << row.error().message();
            ASSERT_EQ(row->a, truth.a) << "row " << next;
            ASSERT_EQ(row->b, truth.b) << "row " << next;
            EXPECT_EQ(row->status, truth.status);
            EXPECT_EQ(row->count, truth.count) << "row " << next;
            EXPECT_EQ(row->intersects, truth.intersects);
            EXPECT_EQ(row->error_bound, truth.error_bound);
            if (truth.status == StatusCode::ok) {
                expect_equal(row->deepest, truth.deepest, tolerance);
            }
            if (tables.cpu.query().records) {
                ASSERT_TRUE(tables.device.records(next, records).ok());
                const auto all = tables.cpu.records(truth);
                ASSERT_EQ(records.size(), all.size()) << "row " << next;
                for (std::size_t i = 0; i < all.size(); ++i) {
                    expect_equal(records[i], all[i], tolerance);
                }
            }
            ++next;
        }
        EXPECT_EQ(next, tables.device.size());
    }

    World& world() { return *world_; }

    std::optional<World> world_;
    std::vector<ShapeHandle> shapes_;
    std::vector<InstanceHandle> instances_;
};

std::vector<Rings> some_shapes(Random& random) {
    std::vector<Rings> shapes{star(random, 50, 0.5),          star(random, 7, 0.3),
                              comb(8),                        with_holes(random, 5),
                              several_parts(random, 3),       spiral(2.0, 0.2, 60),
                              coast(random, 300, 0.3),        pentagram(),
                              needle(1e-6),                   rectangle({-1.0, -1.0}, {1.0, 1.0}),
                              with_repeated_vertices(random, star(random, 20, 0.6), 0.3)};
    shapes.push_back(scaled_and_moved(star(random, 30, 0.5), 0.05, {100.0, -50.0}));
    shapes.push_back(scaled_and_moved(coast(random, 200, 0.3), 8.0, {0.0, 0.0}));
    return shapes;
}

TEST_F(DevicePairs, AreThoseOfTheCpu) {
    for_each_case(seed, 6, [&](Random& random) {
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            std::vector<InstanceHandle> added;
            for (const Rings& rings : some_shapes(random)) {
                const ShapeHandle shape = add_shape(rings);
                for (int i = random.whole(1, 5); i > 0; --i) {
                    added.push_back(add(shape, any_pose(random, 5.0)));
                }
            }
            Tables tables({.tolerance = random.scale(1e-3, 0.1), .points = points});
            compare(tables);
            for (const InstanceHandle handle : added) {
                ASSERT_TRUE(world().remove(handle).ok());
            }
        }
    });
}

TEST_F(DevicePairs, OfAnEmptyWorldAreNone) {
    Tables tables({.tolerance = 0.1});
    compare(tables);
    add(add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0})), {});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
    EXPECT_FALSE(tables.device.row(0).has_value());
}

}  // namespace
}  // namespace nearfield::test
