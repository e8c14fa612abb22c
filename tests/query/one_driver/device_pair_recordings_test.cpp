#include <tests/query/device_poses.hpp>
#include <tests/support/host_frames.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::HostGpu;
using test_support::KeptCommands;

constexpr std::uint64_t device_pair_recordings_seed = 29000;

/// Tables of pairs that are recorded into command buffers of the host.
class DevicePairRecordings : public DevicePosesTest {
protected:
    /// Of the context, which all tests share.
    static std::uint64_t next_frame() {
        static std::uint64_t frame = 0;
        return ++frame;
    }

    static constexpr VkDeviceSize header_bytes = sizeof(HeaderData);
    /// Records a copy of what stays on the device.
    void copy_residents(VkCommandBuffer commands, const PairsOnDevice& pairs, VkBuffer target) {
        const auto barrier = [&](VkPipelineStageFlags from, VkPipelineStageFlags to,
                                 VkAccessFlags written, VkAccessFlags seen) {
            VkMemoryBarrier memory{};
            memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            memory.srcAccessMask = written;
            memory.dstAccessMask = seen;
            gpu().vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
        };
        barrier(pairs.state.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, VK_ACCESS_TRANSFER_READ_BIT);
        VkDeviceSize offset = 0;
        const auto copy = [&](VkBuffer from, VkDeviceSize first, VkDeviceSize bytes) {
            const VkBufferCopy region{first, offset, bytes};
            gpu().vkCmdCopyBuffer(commands, from, target, 1, &region);
            offset += bytes;
        };
        for (const ArrayOnDevice& array : {pairs.pairs, pairs.points}) {
            copy(array.header.buffer, array.header.offset, header_bytes);
            copy(array.buffer, 0, array.size);
        }
        barrier(VK_PIPELINE_STAGE_TRANSFER_BIT, pairs.state.stages | VK_PIPELINE_STAGE_HOST_BIT,
                VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT);
    }
    [[nodiscard]] HostGpu::Buffer make_copy(const PairsOnDevice& pairs) {
        return gpu().make_buffer(2 * header_bytes + pairs.pairs.size + pairs.points.size);
    }
    /// Headers, and as many pairs and records as they say.
    static std::vector<std::uint32_t> words_of(const HostGpu::Buffer& copy,
                                               const PairsOnDevice& pairs) {
        std::vector<std::uint32_t> words;
        const std::byte* data = copy.data;
        const auto add = [&](std::size_t element, VkDeviceSize bytes) {
            HeaderData header;
            std::memcpy(&header, data, header_bytes);
            EXPECT_EQ(header.overflow, 0U);
            const std::size_t first = words.size();
            const std::size_t used = header_bytes + header.count * element;
            words.resize(first + used / sizeof(std::uint32_t));
            std::memcpy(words.data() + first, data, used);
            data += header_bytes + bytes;
        };
        add(sizeof(PairData), pairs.pairs.size);
        add(sizeof(PointData), pairs.points.size);
        return words;
    }
    std::vector<std::uint32_t> read_residents(const PairsOnDevice& pairs) {
        const HostGpu::Buffer copy = make_copy(pairs);
        gpu().submit(
            [&](VkCommandBuffer commands) { copy_residents(commands, pairs, copy.buffer); });
        gpu().finish();
        return words_of(copy, pairs);
    }

    /// Commands that write poses to a buffer, once the device has read what was there.
    VkCommandBuffer writing_of(const KeptCommands& kept, const DevicePoses& target,
                               const std::vector<HostPose>& poses) {
        const VkCommandBuffer commands = kept.begin();
        write_poses(commands, target, poses);
        kept.end(commands);
        return commands;
    }
    void write_poses(VkCommandBuffer commands, const DevicePoses& target,
                     const std::vector<HostPose>& poses) {
        const VkDeviceSize bytes = poses.size() * sizeof(HostPose);
        const HostGpu::Buffer source = gpu().make_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        std::memcpy(const_cast<std::byte*>(source.data), poses.data(), bytes);  // it is mapped
        VkMemoryBarrier memory{};  // for the write after the one before
        memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        memory.srcAccessMask = memory.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        gpu().vkCmdPipelineBarrier(
            commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
        const VkBufferCopy all{0, 0, bytes};
        gpu().vkCmdCopyBuffer(commands, source.buffer, target.buffer, 1, &all);
    }

    /// Brings a table up to date with each of the poses, so that it has room for all.
    template <class Query, class Use>
    void update_with_each(PairTable<Query>& table, PoseBuffer& buffer,
                          const std::vector<std::vector<HostPose>>& poses, const Use& use) {
        for (const std::vector<HostPose>& each : poses) {
            buffer.write(each);
            gpu().finish();
            const Status status = world().update(table, at_poses(buffer.poses()));
            ASSERT_TRUE(status.ok()) << status.text();
            use();
        }
    }

    /// Recorded once, and executed at poses that change on the device: with nothing of the CPU in
    /// between.
    template <class Query>
    void leave_residents(const Query& query) {
        Random random(device_pair_recordings_seed);
        const std::vector<std::vector<HostPose>> poses{any_poses(random), any_poses(random),
                                                       any_poses(random)};
        PoseBuffer buffer = make_buffer();
        PairTable<Query> reference(query, on_device);
        std::vector<std::vector<std::uint32_t>> expected;
        std::vector<double> last_rows;
        update_with_each(reference, buffer, poses, [&] {
            expected.push_back(read_residents(*reference.on_device()));
            last_rows = numbers_of_table(reference);
        });
        ASSERT_EQ(expected.size(), poses.size());
        EXPECT_NE(expected[0], expected[1]);
        EXPECT_GT(expected[0].size(), 1000U);

        PairTable<Query> table(query, on_device);
        update_with_each(table, buffer, poses, [] {});
        KeptCommands kept(host_device());
        const std::uint64_t frame = next_frame();
        const VkCommandBuffer search = kept.begin();
        const Status status =
            world().record(table, {.commands = search, .frame = frame}, at_poses(buffer.poses()));
        ASSERT_TRUE(status.ok()) << status.text();
        kept.end(search);
        const PairsOnDevice pairs = *table.on_device();
        std::vector<VkCommandBuffer> commands;
        std::vector<HostGpu::Buffer> copies;
        for (const std::vector<HostPose>& each : poses) {
            const VkCommandBuffer copying = kept.begin();
            copies.push_back(make_copy(pairs));
            copy_residents(copying, pairs, copies.back().buffer);
            kept.end(copying);
            commands.insert(commands.end(),
                            {writing_of(kept, buffer.poses(), each), search, copying});
        }
        ASSERT_NO_FATAL_FAILURE(change_the_world());
        for (int run = 0; run < 2; ++run) {
            kept.run(commands);
            for (std::size_t i = 0; i < poses.size(); ++i) {
                EXPECT_EQ(words_of(copies[i], pairs), expected[i]) << "poses " << i;
            }
        }
        context().frame_completed(frame);
        const Status collected = table.collect();
        ASSERT_TRUE(collected.ok()) << collected.text();
        EXPECT_EQ(numbers_of_table(table), last_rows);
        EXPECT_EQ(table.on_device()->revision, pairs.revision);
    }
    /// What was recorded is about the world as it was.
    void change_the_world() {
        ASSERT_TRUE(world().set_filter(added_.front(), 2, 4).ok());
        ASSERT_TRUE(world().remove(added_.back()).ok());
        added_.back() = add(world().instance(added_.front())->shape, {});
        const ShapeHandle shape = world().instance(added_[4])->shape;
        ASSERT_TRUE(context().update_shape(shape, rectangle({-5.0, -5.0}, {5.0, 5.0})).ok());
        context().trim();
        world().trim();
    }

    /// Recorded once, executed and collected at each of some poses.
    template <class Query, class... Reach>
    void collect_rows(const Query& query, Reach... reach) {
        Random random(device_pair_recordings_seed + 1);
        const std::vector<std::vector<HostPose>> poses{any_poses(random), any_poses(random),
                                                       any_poses(random), any_poses(random)};
        PoseBuffer buffer = make_buffer();
        PairTable<Query> reference(query, within((0.0 + ... + reach), on_device));
        std::vector<std::vector<double>> expected;
        update_with_each(reference, buffer, poses,
                         [&] { expected.push_back(numbers_of_table(reference)); });
        PairTable<Query> table(query, within((0.0 + ... + reach), on_device));
        update_with_each(table, buffer, poses, [] {});
        KeptCommands kept(host_device());
        const std::uint64_t frame = next_frame();
        const VkCommandBuffer search = kept.begin();
        ASSERT_TRUE(
            world()
                .record(table, {.commands = search, .frame = frame}, at_poses(buffer.poses()))
                .ok());
        kept.end(search);
        ASSERT_EQ(expected.size(), poses.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            kept.run(std::array{writing_of(kept, buffer.poses(), poses[i]), search});
            context().frame_completed(frame);
            for (int times = 0; times < 2; ++times) {
                const Status status = table.collect();
                ASSERT_TRUE(status.ok()) << status.text();
                EXPECT_EQ(numbers_of_table(table), expected[i]) << "poses " << i;
            }
            EXPECT_EQ(table.timings().device, 0.0);
        }
        EXPECT_GT(expected.front().size(), 50U);
    }
};

TEST_F(DevicePairRecordings, LeaveThePairsOfThePosesThatAreThen) {
    Random random(device_pair_recordings_seed);
    add_some(random, 2);
    leave_residents(PenetrationQuery{.tolerance = 0.03, .summary_only = true, .on_device = true});
    remove(std::exchange(added_, {}));
    add_some(random, 2);
    leave_residents(ContactQuery{.tolerance = 0.03, .contact_distance = 0.05, .on_device = true});
}

TEST_F(DevicePairRecordings, AreCollectedAsOftenAsTheyAreExecuted) {
    Random random(device_pair_recordings_seed);
    add_some(random, 2);
    collect_rows(PenetrationQuery{.tolerance = 0.03});
    collect_rows(PenetrationQuery{.tolerance = 1e-5, .points = PenetrationPoints::vertices});
    collect_rows(ContactQuery{.tolerance = 0.02, .contact_distance = 0.05});
    collect_rows(IntersectionTestQuery{});
    collect_rows(SeparationQuery{.tolerance = 0.01}, 0.2);
    collect_rows(ClosestPointQuery{.tolerance = 0.01}, 0.2);
}

/// Where validation layers see what one execution leaves to the next.
TEST_F(DevicePairRecordings, MayFollowThemselvesInOneCommandBuffer) {
    Random random(device_pair_recordings_seed);
    add_some(random, 2);
    const std::vector<std::vector<HostPose>> poses{any_poses(random), any_poses(random)};
    PoseBuffer buffer = make_buffer();
    const ContactQuery query{.tolerance = 0.03, .contact_distance = 0.05, .on_device = true};
    PairTable reference(query, on_device);
    std::vector<double> expected;
    update_with_each(reference, buffer, poses, [&] { expected = numbers_of_table(reference); });
    PairTable table(query, on_device);
    update_with_each(table, buffer, poses, [] {});
    KeptCommands kept(host_device());
    const std::uint64_t frame = next_frame();
    const VkCommandBuffer search = kept.begin(VK_COMMAND_BUFFER_LEVEL_SECONDARY);
    ASSERT_TRUE(
        world().record(table, {.commands = search, .frame = frame}, at_poses(buffer.poses())).ok());
    kept.end(search);
    const VkCommandBuffer primary = kept.begin();
    for (const std::vector<HostPose>& each : poses) {
        write_poses(primary, buffer.poses(), each);
        kept.execute(primary, search);
    }
    kept.end(primary);
    kept.run(std::array{primary});
    context().frame_completed(frame);
    ASSERT_TRUE(table.collect().ok());
    EXPECT_EQ(numbers_of_table(table), expected);
}

/// Each frame of the host records one of two tables, at poses of the world, and reads the other.
TEST_F(DevicePairRecordings, TakeTurnsInTheFramesOfAHost) {
    Random random(device_pair_recordings_seed);
    add_some(random, 2);
    HostFrames host(host_device(), 2);
    const ContactQuery query{.tolerance = 0.03, .contact_distance = 0.05};
    PairTable reference(query, on_device);
    std::array<PairTable<ContactQuery>, 2> tables{PairTable(query, on_device),
                                                  PairTable(query, on_device)};
    std::array<std::vector<double>, 2> expected;
    const std::uint64_t first = next_frame();
    for (int i = 0; i < 6; ++i) {
        const std::uint64_t frame = i == 0 ? first : next_frame();
        const std::size_t turn = frame % 2;
        const VkCommandBuffer commands = host.begin(frame);  // so frame - 2 is complete
        if (i >= 2) {
            EXPECT_FALSE(tables[turn].is_ready());
            context().frame_completed(frame - 2);
            EXPECT_TRUE(tables[turn].is_ready());
            const Status status = tables[turn].collect();
            ASSERT_TRUE(status.ok()) << status.text();
            EXPECT_EQ(numbers_of_table(tables[turn]), expected[turn]);
        }
        for (const InstanceHandle instance : added_) {
            ASSERT_TRUE(world().move(instance, any_pose(random, 3.0)).ok());
        }
        ASSERT_TRUE(world().update(reference).ok());
        expected[turn] = numbers_of_table(reference);
        ASSERT_TRUE(world().update(tables[turn]).ok());  // makes room
        const Status status = world().record(tables[turn], {.commands = commands, .frame = frame});
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(tables[turn].size(), 0U);
        host.submit(frame);
    }
    EXPECT_GT(expected[0].size(), 100U);
    host.wait(next_frame() - 1);
    context().frame_completed(next_frame());
}

}  // namespace
}  // namespace nearfield::test
