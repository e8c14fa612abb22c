#pragma once

#include <tests/query/device_pairs.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace nearfield::test {

/// x, y, cosine and sine.
using HostPose = std::array<float, 4>;

/// A buffer with room for poses, and another one from which they are copied to it.
class PoseBuffer {
public:
    PoseBuffer(test_support::HostGpu& gpu, std::size_t elements, std::uint32_t stride,
               VkDeviceSize offset)
        : gpu_(&gpu) {
        poses_.offset = offset;
        poses_.size = stride * elements;
        poses_.stride = stride;
        poses_.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        poses_.before = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
        poses_.buffer = gpu.make_buffer(bytes(), poses_.usage).buffer;
        source_ = gpu.make_buffer(bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    }

    [[nodiscard]] DevicePoses& poses() { return poses_; }
    /// Has the device write them, once it is done with the reading of earlier ones.
    void write(const std::vector<HostPose>& poses) {
        auto* const data = const_cast<std::byte*>(source_.data);  // it is mapped
        for (std::size_t i = 0; i < poses.size(); ++i) {
            std::memcpy(data + poses_.offset + i * poses_.stride, poses[i].data(),
                        sizeof(HostPose));
        }
        gpu_->submit([this](VkCommandBuffer commands) {
            gpu_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 0,
                                       nullptr);
            const VkBufferCopy all{0, 0, bytes()};
            gpu_->vkCmdCopyBuffer(commands, source_.buffer, poses_.buffer, 1, &all);
        });
    }

private:
    [[nodiscard]] VkDeviceSize bytes() const { return poses_.offset + poses_.size; }

    test_support::HostGpu* gpu_;
    DevicePoses poses_;
    test_support::HostGpu::Buffer source_;
};

/// A world whose instances are at poses that commands of the host write.
class DevicePosesTest : public DevicePairsOfHostTest {
protected:
    [[nodiscard]] PoseBuffer make_buffer(std::uint32_t stride = 16, VkDeviceSize offset = 0) {
        return {gpu(), added_.size(), stride, offset};
    }

    /// Instances of all kinds of shapes.
    void add_some(Random& random, int of_each) {
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = 0; i < of_each; ++i) {
                added_.push_back(add(shape, {}));
            }
        }
    }
    /// `x`: of their centres, in their own frame.
    void add_squares(int count, double x = 0.0) {
        const ShapeHandle square = add_shape(rectangle({x - 1.0, -1.0}, {x + 1.0, 1.0}));
        for (int i = 0; i < count; ++i) {
            added_.push_back(add(square, {}));
        }
    }
    /// Shapes far from their origin come near the others too.
    [[nodiscard]] HostPose any_host_pose(Random& random, const Vector2& centre) {
        const double angle = random.between(-4.0, 4.0);
        const double length = random.between(0.9925, 1.0075);
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        const double x = random.between(-3.0, 3.0) - cosine * centre.x + sine * centre.y;
        const double y = random.between(-3.0, 3.0) - sine * centre.x - cosine * centre.y;
        return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(length * cosine),
                static_cast<float>(length * sine)};
    }
    /// Of all instances, by the index of their handles.
    [[nodiscard]] std::vector<HostPose> any_poses(Random& random) {
        std::vector<HostPose> poses(added_.size());
        for (std::size_t i = 0; i < added_.size(); ++i) {
            const bool is_far = i / 2 == 11;  // see some_shapes()
            poses[added_[i].index] =
                any_host_pose(random, is_far ? Vector2{100.0, -50.0} : Vector2{});
        }
        return poses;
    }

    std::vector<InstanceHandle> added_;
};

}  // namespace nearfield::test
