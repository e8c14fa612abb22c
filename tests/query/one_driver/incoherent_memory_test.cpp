#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/incoherent_memory.hpp>
#include <tests/support/pair_tables.hpp>

#include <vector>

namespace nearfield::test {
namespace {

using test_support::FakeLoader;

class IncoherentMemory : public QueryTest {
protected:
    /// The answers of two batches whose shapes and poses differ, the second in the buffers of the
    /// first.
    [[nodiscard]] static std::vector<double> answers(const HostDevice& host) {
        Settings settings;
        settings.batches_in_flight = 1;
        Expected<Context> context = Context::create(host, on_demand(settings));
        EXPECT_TRUE(context.has_value()) << context.error().text();
        Random random(7100);
        const ShapeHandle a = *context->add_shape(coast(random, 100, 0.5));
        const ShapeHandle b = *context->add_shape(with_holes(random, 3));
        std::vector<double> numbers;
        Expected<World> world = World::create(*context);
        EXPECT_TRUE(world.has_value()) << world.error().text();
        PairTable<PenetrationQuery> table({.tolerance = 0.05}, on_device);
        WorldRequest rays;
        WorldRequest near_points;
        for (int i = 0; i < 2; ++i) {
            add_pairs(*world, {a, b}, table, numbers);
            add_hits(*world, a, rays, near_points, numbers);
            Results results;
            const Status status = context->run(every_query(a, b, i), results);
            EXPECT_TRUE(status.ok()) << status.text();
            const std::vector<double> more = all_numbers(results);
            numbers.insert(numbers.end(), more.begin(), more.end());
            EXPECT_TRUE(context->update_shape(a, coast(random, 80, 0.4)).ok());
        }
        return numbers;
    }

    /// What rays hit, what is near their starts, and whether a shape there meets anything.
    static void add_hits(World& world, ShapeHandle shape, WorldRequest& rays,
                         WorldRequest& near_points, std::vector<double>& numbers) {
        const WorldOptions by_device{.technique = Technique::compute};
        std::vector<Segment> segments;
        std::vector<Vector2> points;
        for (int i = 0; i < 100; ++i) {
            points.push_back({0.05 * i - 2.0, 0.03 * (i % 10)});
            segments.push_back({points.back(), {0.3 * (i % 7), 2.0}});
        }
        std::vector<RayHit> hits(segments.size());
        std::vector<NearestHit> near(points.size());
        EXPECT_TRUE(world.submit(rays, segments, by_device).ok());
        EXPECT_TRUE(rays.collect(hits).ok());
        EXPECT_TRUE(world.submit(near_points, {}, points, by_device).ok());
        EXPECT_TRUE(near_points.collect(near).ok());
        EXPECT_EQ(rays.left_to_cpu() + near_points.left_to_cpu(), 0U);
        std::vector<Pose> poses;
        for (const Vector2& point : points) {
            poses.push_back({point, point.y});
        }
        std::vector<std::uint8_t> meets(poses.size());
        EXPECT_TRUE(world.test_poses(shape, poses, meets, by_device).ok());
        numbers.insert(numbers.end(), meets.begin(), meets.end());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            numbers.push_back(hits[i].parameter);
            numbers.push_back(near[i].distance);
        }
    }

    /// The rows and records of all pairs, after more instances were added.
    static void add_pairs(World& world, const std::vector<ShapeHandle>& shapes,
                          PairTable<PenetrationQuery>& table, std::vector<double>& numbers) {
        for (const ShapeHandle shape : shapes) {
            const auto x = static_cast<double>(world.size());
            const Pose pose{{0.5 * x, 0.0}, x};
            EXPECT_TRUE(world.add({.shape = shape, .pose = pose}).has_value());
        }
        const Status status = world.update(table);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_GT(table.size(), 0U);
        for (std::uint32_t row = 0; row < table.size(); ++row) {
            numbers.push_back(table.row(row)->deepest.depth);
            for (const PenetratingPoint& record : points_of(table, row)) {
                numbers.push_back(record.depth);
            }
        }
    }
};

TEST_F(IncoherentMemory, ChangesNoAnswer) {
    const std::vector<double> coherent = answers(host_device());
    EXPECT_GT(coherent.size(), 10'000U);
    const FakeLoader fake(host_device(), test_support::incoherent_memory());
    EXPECT_EQ(answers(fake.host()), coherent);
}

}  // namespace
}  // namespace nearfield::test
