#pragma once

#include <tests/query/query_test.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/numbers.hpp>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Shapes of all kinds.
inline std::vector<Rings> some_shapes(Random& random) {
    std::vector<Rings> shapes{star(random, 50, 0.5),
                              star(random, 7, 0.3),
                              comb(8),
                              with_holes(random, 5),
                              several_parts(random, 3),
                              spiral(2.0, 0.2, 60),
                              coast(random, 300, 0.3),
                              pentagram(),
                              needle(1e-6),
                              rectangle({-1.0, -1.0}, {1.0, 1.0}),
                              with_repeated_vertices(random, star(random, 20, 0.6), 0.3)};
    shapes.push_back(scaled_and_moved(star(random, 30, 0.5), 0.05, {100.0, -50.0}));
    shapes.push_back(scaled_and_moved(coast(random, 200, 0.3), 8.0, {0.0, 0.0}));
    return shapes;
}

// A row, a record and a cluster of the device are those of the CPU, as the answers of two
// techniques are.

inline void expect_equal(const PenetratingPoint& found, const PenetratingPoint& truth,
                         double tolerance) {
    EXPECT_NEAR(found.depth, truth.depth, tolerance / 1000.0);
    EXPECT_EQ(found.position, truth.position);
    if (truth.unique && found.unique) {
        EXPECT_NEAR(found.nearest.x, truth.nearest.x, 0.1 * tolerance + 0.1 * truth.depth);
        EXPECT_NEAR(found.nearest.y, truth.nearest.y, 0.1 * tolerance + 0.1 * truth.depth);
    }
}
inline void expect_equal(const ContactPoint& found, const ContactPoint& truth, double tolerance) {
    EXPECT_NEAR(found.distance, truth.distance, tolerance / 1000.0);
    EXPECT_EQ(found.position, truth.position);
    EXPECT_EQ(found.on, truth.on);
    EXPECT_EQ(found.inside, truth.inside);
    if (truth.unique && found.unique) {
        EXPECT_NEAR(found.nearest.x, truth.nearest.x, 0.1 * tolerance + 0.1 * truth.distance);
        EXPECT_NEAR(found.nearest.y, truth.nearest.y, 0.1 * tolerance + 0.1 * truth.distance);
    }
}
inline void expect_equal(const ContactCluster& found, const ContactCluster& truth,
                         double tolerance) {
    const double near = tolerance / 100.0;
    EXPECT_NEAR(found.first.x, truth.first.x, near);
    EXPECT_NEAR(found.last.y, truth.last.y, near);
    EXPECT_NEAR(found.normal.x, truth.normal.x, 1e-3);
    EXPECT_NEAR(found.extreme.distance, truth.extreme.distance, near);
}
inline void expect_equal(const PenetrationValues& found, const PenetrationValues& truth,
                         double tolerance) {
    EXPECT_EQ(found.count, truth.count);
    expect_equal(found.deepest, truth.deepest, tolerance);
}
inline void expect_equal(const ContactValues& found, const ContactValues& truth,
                         double /*tolerance*/) {
    EXPECT_EQ(found.count, truth.count);
}
inline void expect_equal(const IntersectionTestValues& /*found*/,
                         const IntersectionTestValues& /*truth*/, double /*tolerance*/) {}
/// Of distances: the same, bit for bit.
template <class Values>
void expect_equal(const Values& found, const Values& truth, double /*tolerance*/) {
    EXPECT_EQ(found.distance, truth.distance);
    EXPECT_EQ(found.direction, truth.direction);
    EXPECT_EQ(found.unique, truth.unique);
}
template <class Element>
void expect_all_equal(std::span<const Element> found, std::span<const Element> truth,
                      double tolerance) {
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        expect_equal(found[i], truth[i], tolerance);
    }
}

template <class Query>
void expect_rows_of_cpu(PairTable<Query>& device, PairTable<Query>& cpu) {
    ASSERT_EQ(device.size(), cpu.size());
    double tolerance = 0.0;
    if constexpr (requires(Query query) { query.tolerance; }) {
        tolerance = cpu.query().tolerance;
    }
    const auto rows = device.rows();
    ASSERT_EQ(rows.size(), device.size()) << device.read_status().text();
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE("row " + std::to_string(i));
        const PairRow<Query>& found = rows[i];
        const PairRow<Query>& truth = cpu.rows()[i];
        ASSERT_EQ(found.a, truth.a);
        ASSERT_EQ(found.b, truth.b);
        EXPECT_EQ(found.index, i);
        EXPECT_EQ(found.status, truth.status);
        EXPECT_EQ(found.intersects, truth.intersects);
        EXPECT_EQ(found.error_bound, truth.error_bound);
        EXPECT_EQ(found.point_count, truth.point_count);
        if (truth.status != StatusCode::ok) {
            continue;
        }
        using Values = typename Query::Result::Values;
        expect_equal(static_cast<const Values&>(found), static_cast<const Values&>(truth),
                     tolerance);
        if constexpr (requires { cpu.query().summary_only; }) {
            expect_all_equal(device.points(found), cpu.points(truth), tolerance);
        }
        if constexpr (std::is_same_v<Query, ContactQuery>) {
            expect_all_equal(device.manifold(found), cpu.manifold(truth), tolerance);
        }
    }
}

/// All that a table says.
template <class Query>
std::vector<double> numbers_of_table(PairTable<Query>& table) {
    std::vector<double> numbers = rows_of(table);
    EXPECT_EQ(table.rows().size(), table.size()) << table.read_status().text();
    numbers.insert(numbers.end(), {1.0 * table.candidates(), 1.0 * table.left_to_cpu()});
    return numbers;
}

/// What a test asks of a world again and again, by the device and by the CPU.
template <class Query>
struct Tables {
    explicit Tables(const Query& query, double reach = 0.0)
        : device(query, within(reach, on_device)), cpu(query, within(reach, on_cpu)) {}

    PairTable<Query> device;
    PairTable<Query> cpu;
};

/// How long a random history is, how many instances it starts with, and how far these scatter.
struct History {
    int steps;
    int instances;
    double extent;
};

/// A world whose pairs the device finds.
class DevicePairsTest : public QueryTest {
protected:
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
        return *handle;
    }
    [[nodiscard]] static Pose any_pose(Random& random, double extent) {
        return {.translation = {random.between(-extent, extent), random.between(-extent, extent)},
                .angle = random.between(-4.0, 4.0)};
    }
    /// Removes instances that were added.
    void remove(const std::vector<InstanceHandle>& instances) {
        for (const InstanceHandle handle : instances) {
            ASSERT_TRUE(world().remove(handle).ok());
        }
    }

    World& world() { return *world_; }

    /// Updates both tables, and compares all that they say.
    template <class Query>
    void compare(Tables<Query>& tables, const PairTableInput& input = {}) {
        const Status status = world().update(tables.device, input);
        ASSERT_TRUE(status.ok()) << status.text();
        ASSERT_TRUE(world().update(tables.cpu, input).ok());
        EXPECT_GE(tables.device.candidates(), tables.device.size());
        expect_rows_of_cpu(tables.device, tables.cpu);
    }
    template <class Query>
    void compare(const Query& query, double reach = 0.0) {
        Tables<Query> tables(query, reach);
        compare(tables);
    }

    /// Any sequence of changes: adds, moves, filters and removes instances of some_shapes(), which
    /// deform, and calls `compare` after each step. In some steps one of these happens alone.
    template <class Compare>
    void run_history(Random& random, const History& history, const Compare& compare) {
        std::vector<ShapeHandle> shapes;
        for (const Rings& rings : some_shapes(random)) {
            shapes.push_back(add_shape(rings));
        }
        const auto any_of_shapes = [&] {
            return shapes[static_cast<std::size_t>(
                random.whole(0, static_cast<int>(shapes.size()) - 1))];
        };
        std::vector<InstanceHandle> present;
        for (int step = 0; step < history.steps; ++step) {
            SCOPED_TRACE("step " + std::to_string(step));
            const int alone = step == 0 ? adding : random.whole(adding, 2 * kinds_of_changes);
            const auto happens = [alone](int kind) {
                return alone == kind || alone >= kinds_of_changes;
            };
            if (happens(adding)) {
                for (int i = step == 0 ? history.instances : random.whole(0, 20); i > 0; --i) {
                    present.push_back(add(any_of_shapes(), any_pose(random, history.extent)));
                }
            }
            for (const InstanceHandle handle : present) {
                if (happens(moving) && random.whole(0, 3) == 0) {
                    ASSERT_TRUE(world().move(handle, any_pose(random, history.extent)).ok());
                }
                if (happens(filtering) && random.whole(0, 30) == 0) {
                    const auto bits = static_cast<std::uint32_t>(random.whole(1, 3));
                    ASSERT_TRUE(world().set_filter(handle, bits, 3 - bits / 2).ok());
                }
            }
            for (int i = happens(removing) ? random.whole(0, 10) : 0; i > 0 && !present.empty();
                 --i) {
                ASSERT_TRUE(world().remove(present.back()).ok());
                present.pop_back();
            }
            if (alone == deforming || (happens(deforming) && random.whole(0, 2) == 0)) {
                const Rings rings =
                    random.whole(0, 1) == 0 ? star(random, 40, 0.4) : with_holes(random, 4);
                ASSERT_TRUE(context().update_shape(any_of_shapes(), rings).ok());
            }
            ASSERT_NO_FATAL_FAILURE(compare());
        }
        remove(present);
    }

private:
    enum Change { adding, moving, filtering, removing, deforming, kinds_of_changes };

    std::optional<World> world_;
    std::vector<ShapeHandle> shapes_;
};

/// What a table of pairs leaves on the device: as many of each as the headers say.
struct PairContents {
    HeaderData pair_header;
    HeaderData point_header;
    std::vector<PairData> pairs;
    std::vector<PointData> points;
};

/// The same with the host's side of the device.
class DevicePairsOfHostTest : public DevicePairsTest {
protected:
    void SetUp() override {
        DevicePairsTest::SetUp();
        gpu_.emplace(host_device());
    }
    void TearDown() override {
        DevicePairsTest::TearDown();
        gpu_.reset();
    }

    test_support::HostGpu& gpu() { return *gpu_; }

    PairContents read(const PairsOnDevice& on_device) {
        PairContents all;
        all.pair_header = read(on_device.pairs, on_device.state, all.pairs);
        all.point_header = read(on_device.points, on_device.state, all.points);
        return all;
    }

private:
    template <class Data>
    HeaderData read(const ArrayOnDevice& array, const OutputState& state, std::vector<Data>& all) {
        const auto copy = [&](VkBuffer buffer, VkDeviceSize offset, void* to, std::size_t bytes) {
            const auto words = gpu().read(buffer, offset, bytes, state);
            std::memcpy(to, words.data(), bytes);
        };
        HeaderData header;
        copy(array.header.buffer, array.header.offset, &header, sizeof(header));
        EXPECT_LE(header.count, array.capacity);
        EXPECT_EQ(array.size, array.capacity * sizeof(Data));
        all.resize(std::min(header.count, array.capacity));
        if (!all.empty()) {
            copy(array.buffer, array.offset, all.data(), all.size() * sizeof(Data));
        }
        return header;
    }

    std::optional<test_support::HostGpu> gpu_;
};

}  // namespace nearfield::test
