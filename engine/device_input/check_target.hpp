#pragma once

#include <nearfield/device_poses.hpp>
#include <nearfield/on_device.hpp>
#include <nearfield/pairs_on_device.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace nearfield::device_input {

/// The host's images and buffers that the queries of a batch write to. Checks what the host states
/// about them, and that no two queries write to the same place.
class Targets {
public:
    /// `offset_alignment`: of storage buffers on the device, in bytes.
    explicit Targets(std::uint64_t offset_alignment) : offset_alignment_(offset_alignment) {}

    /// Forgets the queries of the batch before.
    void clear();
    /// Forgets this query, the last one added: it is rejected and writes nothing.
    void drop(std::uint32_t query);
    /// Adds what a query writes to. Returns success, or what is wrong with it: then drop it.
    /// `has_features`: of the field's features, some stay on the device.
    [[nodiscard]] Status add(const FieldTarget& target, bool has_features, std::uint32_t query);
    [[nodiscard]] Status add(const BufferTarget& target, std::uint32_t query);

private:
    struct OfQuery {
        std::uint32_t query = 0;
        ImageTarget image;    // or
        BufferTarget buffer;  // if its handle is not null
    };

    [[nodiscard]] Status add_image(const ImageTarget& target, VkFormat format,
                                   std::string_view name, std::uint32_t query);

    std::uint64_t offset_alignment_;
    std::vector<OfQuery> added_;
};

/// Checks that a field of this many cells fits the images.
[[nodiscard]] Status check_room(const FieldTarget& target, std::uint64_t width,
                                std::uint64_t height);
/// Checks that this many bytes fit the range of the buffer; `what` they are: "records".
[[nodiscard]] Status check_room(const BufferTarget& target, double bytes, std::string_view what);

/// Checks what the host states about the buffers for the pairs of a table.
[[nodiscard]] Status check_pair_target(const PairTarget& target, std::uint64_t offset_alignment);

/// Bytes from the first of so many poses of the host's to the end of the last one.
[[nodiscard]] constexpr std::uint64_t bytes_of_poses(const DevicePoses& poses,
                                                     std::uint32_t elements) {
    return elements == 0 ? 0 : std::uint64_t{poses.stride} * (elements - 1) + 4 * sizeof(float);
}
/// Checks what the host states about the buffer of its poses. `elements`: of which it needs room;
/// `offset_alignment`: of storage buffers on the device, bytes, and the most bytes that shaders
/// reach of one.
[[nodiscard]] Status check_poses(const DevicePoses& poses, std::uint32_t elements,
                                 std::uint64_t offset_alignment, std::uint64_t reached);

}  // namespace nearfield::device_input
