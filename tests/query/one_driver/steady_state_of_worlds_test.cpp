#include <tests/query/steady_state.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

class SteadyStateOfWorlds : public SteadyStateTest {
protected:
    void SetUp() override {
        SteadyStateTest::SetUp();
        Expected<World> made = World::create(watched());
        ASSERT_TRUE(made.has_value()) << made.error().text();
        world_.emplace(std::move(*made));
    }
    void TearDown() override {
        world_.reset();
        SteadyStateTest::TearDown();
    }

    World& world() { return *world_; }
    /// Twenty instances of the frame's first shapes, in turns.
    void add_instances(std::size_t shapes) {
        for (std::size_t i = 0; i < 20; ++i) {
            const auto instance = world().add({.shape = shapes_of_frame()[i % shapes]});
            ASSERT_TRUE(instance.has_value()) << instance.error().text();
            instances_.push_back(*instance);
        }
    }
    /// The same poses again and again, so that warming up has seen all.
    bool move_instances(int number) {
        bool ok = true;
        for (std::size_t i = 0; i < instances_.size(); ++i) {
            ok = world().move(instances_[i], pose_of(i, 0.7 * (number % 8))).ok() && ok;
        }
        return ok;
    }

    std::vector<InstanceHandle> instances_;

private:
    static Pose pose_of(std::size_t i, double angle) {
        const auto place = static_cast<double>(i);
        return {{0.8 * place, 0.0}, angle + place};
    }

    std::optional<World> world_;
};

TEST_F(SteadyStateOfWorlds, DevicePairsOfMovingInstancesAllocateAndCreateNothing) {
    add_instances(2);
    PairTable<PenetrationQuery> table({.tolerance = 0.08}, on_device);
    PairTable intersections(IntersectionTestQuery{}, on_device);
    PairTable contacts(ContactQuery{.tolerance = 0.08, .contact_distance = 0.1}, on_device);
    std::size_t read = 0;
    std::uint32_t rows = 0;
    expect_nothing_made(200, [&](int number) {
        bool ok = move_instances(number) && world().update(table).ok();
        for (const auto& row : table.rows()) {
            read += table.points(row).size();
        }
        rows = table.size();
        ok = world().update(intersections).ok() && ok;
        for (std::uint32_t row = 0; row < intersections.size(); ++row) {
            ok = intersections.row(row).has_value() && ok;
        }
        ok = world().submit(contacts).ok() && contacts.collect().ok() && ok;
        for (const auto& row : contacts.rows()) {
            read += contacts.points(row).size() + contacts.manifold(row).size();
        }
        return ok && table.read_status().ok() && contacts.read_status().ok();
    });
    EXPECT_GT(rows, 10U);
    EXPECT_GT(read, 1000U);
}

TEST_F(SteadyStateOfWorlds, QuestionsForTheDeviceAllocateAndCreateNothing) {
    // Pairs at the same place, so that the CPU answers some questions.
    for (std::size_t i = 0; i < 20; ++i) {
        const Pose pose{{0.8 * static_cast<double>(i / 2), 0.0}, 0.0};
        const auto instance = world().add({.shape = shapes_of_frame()[0], .pose = pose});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        instances_.push_back(*instance);
    }
    std::vector<Segment> segments;
    std::vector<Vector2> points;
    for (int i = 0; i < 300; ++i) {
        points.push_back({0.03 * i, 0.01 * (i % 50)});
        segments.push_back({{0.03 * i, -3.0}, {0.02 * i, 3.0}});
    }
    const ShapeHandle asked = shapes_of_frame()[1];
    std::vector<RayHit> hits(segments.size());
    std::vector<NearestHit> near(points.size());
    const std::vector<Pose> poses(300, Pose{{3.6, 0.0}, 0.3});
    std::vector<std::uint8_t> meets(poses.size());
    const WorldOptions by_device{.technique = Technique::compute};
    WorldRequest rays;
    WorldRequest nearest;
    expect_nothing_made(200, [&](int number) {
        const double angle = 0.7 * (number % 8);
        // The last two move together.
        const bool ok = world().move(instances_[18], {{7.2, 0.0}, angle}).ok() &&
                        world().move(instances_[19], {{7.2, 0.0}, angle}).ok() &&
                        world().submit(nearest, {}, points, by_device).ok() &&
                        world().cast_rays(segments, hits, by_device).ok() &&
                        world().submit(rays, segments).ok() && nearest.collect(near).ok() &&
                        world().test_poses(asked, poses, meets, by_device).ok() &&
                        rays.collect(hits).ok();
        return ok;
    });
    EXPECT_GT(nearest.left_to_cpu(), 10U);
    EXPECT_NE(hits[10].instance, InstanceHandle{});
}

/// The tables that the CPU answers, of one kind of query each.
template <class Query>
class SteadyStateOfTables : public SteadyStateOfWorlds {};
using QueriesOfTables = testing::Types<PenetrationQuery, ContactQuery, IntersectionQuery,
                                       ClosestPointQuery, SeparationQuery, IntersectionTestQuery,
                                       SeparationVectorQuery, ContainmentQuery, TimeOfImpactQuery>;
TYPED_TEST_SUITE(SteadyStateOfTables, QueriesOfTables);

TYPED_TEST(SteadyStateOfTables, OfTheCpuAllocateNothing) {
    this->add_instances(2);
    TypeParam query{};
    if constexpr (requires { query.tolerance; }) {
        query.tolerance = 0.08;
    }
    if constexpr (std::is_same_v<TypeParam, ContactQuery>) {
        query.contact_distance = 0.1;
    }
    for (const bool hits_only : {false, true}) {
        PairTable<TypeParam> table(
            query, {.reach = 0.1, .hits_only = hits_only, .technique = Technique::cpu});
        PairTable<TypeParam> listed(query, {.hits_only = hits_only,
                                            .listed = !std::is_same_v<TypeParam, TimeOfImpactQuery>,
                                            .technique = Technique::cpu});
        const std::span<const InstanceHandle> all = this->instances_;
        const PairTableInput pairs{.a = all.first(19), .b = all.subspan(1)};
        std::size_t read = 0;
        this->expect_nothing_made(100, [&](int number) {
            bool ok = this->move_instances(number) && this->world().update(table).ok();
            ok = ok && (!listed.options().listed || this->world().update(listed, pairs).ok());
            for (const auto& row : table.rows()) {
                read += 1 + table.points(row).size();
            }
            return ok;
        });
        EXPECT_GT(table.candidates(), 10U);
        constexpr bool may_be_none = std::is_same_v<TypeParam, ContainmentQuery>;
        EXPECT_GE(read, may_be_none ? 0U : 100U);
    }
}

/// The number of pairs changes from frame to frame.
TEST_F(SteadyStateOfWorlds, BatchesOfAllPairsFoundAllocateNothing) {
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<Instance> instances(20);
    Batch batch;
    Results results;
    std::size_t fewest = SIZE_MAX;
    std::size_t most = 0;
    expect_nothing_made(200, [&](int number) {
        for (std::size_t i = 0; i < instances.size(); ++i) {
            const double step = 0.5 + 0.1 * (number % 8);
            instances[i] = {shapes[i % 2],
                            {{step * static_cast<double>(i), 0.0}, 0.7 * (number % 8)}};
        }
        const auto pairs = watched().find_overlapping_boxes(instances, 0.0);
        batch.clear();
        for (const InstancePair& pair : *pairs) {
            batch.add(ContactQuery{instances[pair.first], instances[pair.second], 0.08, 0.1});
        }
        fewest = std::min(fewest, pairs->size());
        most = std::max(most, pairs->size());
        return watched().run(batch, results).ok() && results.results.size() == pairs->size();
    });
    EXPECT_LT(fewest + 10, most);
}

/// Places of the instances in a buffer of the host.
struct HostPlaces {
    explicit HostPlaces(test_support::HostGpu& gpu) {
        std::vector<std::array<float, 4>> places;
        for (int i = 0; i < 20; ++i) {
            places.push_back({0.8F * static_cast<float>(i), 0.0F, 0.6F, 0.8F});
        }
        poses.size = sizeof(places[0]) * places.size();
        poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        const auto buffer = gpu.make_buffer(poses.size, poses.usage);
        poses.buffer = buffer.buffer;
        std::memcpy(const_cast<std::byte*>(buffer.data), places.data(),
                    poses.size);  // it is mapped
    }

    DevicePoses poses;
};

TEST_F(SteadyStateOfWorlds, DevicePairsAtPosesOfTheHostAllocateAndCreateNothing) {
    add_instances(2);
    test_support::HostGpu gpu(host_device());
    const HostPlaces places(gpu);
    PairTable<PenetrationQuery> table({.tolerance = 0.08, .on_device = true}, on_device);
    std::size_t read = 0;
    expect_nothing_made(200, [&](int) {
        const bool ok = world().submit(table, at_poses(places.poses)).ok() && table.on_device() &&
                        table.collect().ok();
        for (const auto& row : table.rows()) {
            read += table.points(row).size();
        }
        return ok && table.read_status().ok();
    });
    EXPECT_GT(table.size(), 10U);
    EXPECT_GT(read, 1000U);
}

TEST_F(SteadyStateOfWorlds, RecordedDevicePairsAllocateCreateWaitForAndSubmitNothing) {
    add_instances(1);
    test_support::HostGpu gpu(host_device());
    const HostPlaces places(gpu);
    test_support::HostFrames host(host_device(), 1);
    std::uint64_t frame = 0;
    for (const PairTableInput& input : {PairTableInput{}, at_poses(places.poses)}) {
        PairTable table(ContactQuery{.tolerance = 0.08, .contact_distance = 0.1, .on_device = true},
                        on_device);
        ASSERT_TRUE(world().update(table).ok());  // makes room
        expect_nothing_made(100, [&](int number) {
            VkCommandBuffer commands = VK_NULL_HANDLE;
            by_others([&] { commands = host.begin(frame); });
            const bool ok =
                move_instances(number) &&
                world().record(table, {.commands = commands, .frame = frame}, input).ok();
            by_others([&] {
                host.submit(frame);
                host.wait(frame);
            });
            watched().frame_completed(frame++);
            return ok && world().is_recorded(table) && table.is_ready() && table.collect().ok() &&
                   table.size() > 0;
        });
        EXPECT_EQ(waits_and_submissions, 0);
    }
}

}  // namespace
}  // namespace nearfield::test
