#pragma once

#include <tests/query/device_pairs.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/watched_loader.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield::test {

/// The calls of the context whose device reaches little.
struct CallsOfParts {
    int dispatches = 0;  ///< indirect ones of the last recording: as many for each part
    int submissions = 0;
    int objects = 0;  ///< made or destroyed
    std::uint64_t allocations_below = 0;
};
inline CallsOfParts calls_of_parts;  // entry points have no user data

/// Two worlds that are alike: world() is on the device as it is, and small_world() on one whose
/// shaders reach so little of a buffer that pairs are searched in parts.
class DevicePairPartsTest : public DevicePairsOfHostTest {
protected:
    void TearDown() override {
        small_world_.reset();
        small_.reset();
        loader_.reset();
        DevicePairsOfHostTest::TearDown();
    }

    /// `reach`: in bytes. Before anything is added.
    void make_small(std::uint32_t reach, Settings settings = {}) {
        test_support::Lies lies =
            test_support::watched(host_device(), [](const test_support::WatchedCall& call) {
                calls_of_parts.dispatches *= call.name == "vkBeginCommandBuffer" ? 0 : 1;
                calls_of_parts.dispatches += call.name == "vkCmdDispatchIndirect" ? 1 : 0;
                calls_of_parts.submissions += call.name == "vkQueueSubmit" ? 1 : 0;
                calls_of_parts.objects += call.makes() || call.destroys() ? 1 : 0;
                calls_of_parts.allocations_below += call.allocations;
            });
        lies.properties = [reach](VkPhysicalDeviceProperties& properties) {
            properties.limits.maxStorageBufferRange = reach;
        };
        settings.pipelines_on_demand = true;
        loader_.emplace(host_device(), std::move(lies));
        Expected<Context> made = Context::create(loader_->host(), settings);
        ASSERT_TRUE(made.has_value()) << made.error().text();
        small_.emplace(std::move(*made));
        small_world_.emplace(std::move(*World::create(*small_)));
    }

    [[nodiscard]] Context& small_context() { return *small_; }
    [[nodiscard]] World& small_world() { return *small_world_; }

    /// Adds to both; what was added has a number.
    std::size_t add_shape_to_both(const Rings& rings) {
        shapes_of_both_.emplace_back(add_shape(rings), *small_->add_shape(rings));
        return shapes_of_both_.size() - 1;
    }
    void add_to_both(std::size_t shape, const Pose& pose) {
        const auto& [own, other] = shapes_of_both_[shape];
        added_.emplace_back(add(own, pose), *small_world_->add({.shape = other, .pose = pose}));
    }
    void move_both(std::size_t i, const Pose& pose) {
        ASSERT_TRUE(world().move(added_[i].first, pose).ok());
        ASSERT_TRUE(small_world_->move(added_[i].second, pose).ok());
    }
    void set_filter_of_both(std::size_t i, std::uint32_t category, std::uint32_t mask) {
        ASSERT_TRUE(world().set_filter(added_[i].first, category, mask).ok());
        ASSERT_TRUE(small_world_->set_filter(added_[i].second, category, mask).ok());
    }
    void remove_last_of_both() {
        ASSERT_TRUE(world().remove(added_.back().first).ok());
        ASSERT_TRUE(small_world_->remove(added_.back().second).ok());
        added_.pop_back();
    }
    [[nodiscard]] std::size_t size_of_both() const { return added_.size(); }
    template <class Query>
    struct Tables {
        PairTable<Query> whole;     ///< for world()
        PairTable<Query> in_parts;  ///< for small_world()
        int dispatches = 0;         ///< of a part
    };
    template <class Query>
    Tables<Query> tables_of(const Query& query, const PairTableOptions& options = on_device) {
        Expected<World> few = World::create(*small_);
        const ShapeHandle shape = *small_->add_shape(rectangle({0, 0}, {1, 1}));
        for (int i = 0; i < 2; ++i) {
            EXPECT_TRUE(few->add({.shape = shape}).has_value());
        }
        PairTable<Query> few_pairs(query, options);
        EXPECT_TRUE(few->update(few_pairs).ok());
        EXPECT_GT(calls_of_parts.dispatches, 0);
        return {PairTable<Query>(query, options), PairTable<Query>(query, options),
                calls_of_parts.dispatches};
    }
    /// Stars that overlap, all in a square.
    void add_crowd(Random& random, int count, double extent) {
        const std::size_t shape = add_shape_to_both(star(random, 20, 0.5));
        for (int i = 0; i < count; ++i) {
            add_to_both(shape, any_pose(random, extent));
        }
    }
    Random make_crowd(std::uint64_t seed, int count, double extent) {
        Random random(seed);
        add_crowd(random, count, extent);
        return random;
    }

    /// All that a table says but which of the edges that meet at a nearest point it names: that
    /// depends on the points that are searched together.
    template <class Query>
    static std::vector<double> numbers_of_parts(PairTable<Query>& table) {
        Numbers numbers;
        numbers.add(table.candidates(), table.left_to_cpu(), table.size());
        for (PairRow<Query> row : table.rows()) {
            numbers.add(row.a, row.b, row.status, row.intersects, row.error_bound);
            if constexpr (requires { row.deepest; }) {
                row.deepest.feature = {};
            }
            numbers.add(static_cast<const typename Query::Result::Values&>(row));
            for (auto record : table.points(row)) {
                if constexpr (requires { record.feature; }) {
                    record.feature = {};
                }
                numbers.add(record);
            }
            if constexpr (std::is_same_v<Query, ContactQuery>) {
                for (ContactCluster cluster : table.manifold(row)) {
                    cluster.extreme.feature = {};
                    numbers.add(cluster);
                }
            }
        }
        EXPECT_TRUE(table.read_status().ok()) << table.read_status().text();
        return numbers.list();
    }

private:
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> small_;
    std::optional<World> small_world_;
    std::vector<std::pair<ShapeHandle, ShapeHandle>> shapes_of_both_;
    std::vector<std::pair<InstanceHandle, InstanceHandle>> added_;
};

}  // namespace nearfield::test
