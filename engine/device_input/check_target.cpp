#include <engine/device_input/check_target.hpp>
#include <engine/geometry/number.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace nearfield::device_input {
namespace {

constexpr std::string_view signed_distance_name = "the target's image for the signed distance";
constexpr std::string_view feature_name = "the target's image for the feature";
constexpr std::string_view buffer_name = "the target's buffer";
constexpr std::string_view pairs_name = "the target's buffer of pairs";
constexpr std::string_view points_name = "the target's buffer of points";
constexpr std::string_view poses_name = "the buffer of the poses";

struct Layout {
    VkImageLayout layout{};
    const char* name = "";
    VkImageUsageFlags usage = 0;  ///< of which an image in this layout has at least one
};

// The layouts of a colour image that no feature or extension is needed for.
constexpr std::array<Layout, 6> layouts{{
    {VK_IMAGE_LAYOUT_UNDEFINED, "VK_IMAGE_LAYOUT_UNDEFINED", ~0U},
    {VK_IMAGE_LAYOUT_GENERAL, "VK_IMAGE_LAYOUT_GENERAL", ~0U},
    {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL",
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
    {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, "VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL",
     VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT},
    {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, "VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL",
     VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
    {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, "VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL",
     VK_IMAGE_USAGE_TRANSFER_DST_BIT},
}};

Status refused(std::string_view name, const std::string& why) {
    return {StatusCode::invalid_query, std::string(name) + " " + why};
}

std::string hexadecimal(std::uint32_t bits) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    do {
        text.insert(text.begin(), digits[bits % 16]);
        bits /= 16;
    } while (bits != 0);
    return "0x" + text;
}

std::string size_text(std::uint64_t width, std::uint64_t height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

// Messages are composed only after an error was found: a frame without errors allocates nothing.

Status no_layout(std::string_view name, VkImageLayout layout, const char* when,
                 const std::string& why) {
    return refused(name, "has the layout number " + std::to_string(static_cast<int>(layout)) + " " +
                             when + " the batch (TargetState::layout), " + why);
}

/// `when`: "before" or "after".
Status check_layout(const ImageTarget& target, VkImageLayout layout, std::string_view name,
                    const char* when) {
    const auto* const known = std::find_if(layouts.begin(), layouts.end(),
                                           [=](const Layout& one) { return one.layout == layout; });
    if (known == layouts.end()) {
        return no_layout(name, layout, when,
                         "which is none that a colour image has without an extension");
    }
    if ((known->usage & target.usage) == 0) {
        return no_layout(name, layout, when,
                         std::string(known->name) + ", and its usage, " +
                             hexadecimal(target.usage) + ", does not allow that layout");
    }
    return {};
}

Status check_state(const TargetState& state, std::string_view name, const char* when) {
    return state.stages == 0 && state.access != 0
               ? refused(name, std::string("has accesses ") + when +
                                   " the batch (TargetState::access), " +
                                   hexadecimal(state.access) + ", and no stages that make them")
               : Status();
}

Status check_states(const TargetState& before, const TargetState& after, std::string_view name) {
    Status status = check_state(before, name, "before");
    return status.ok() ? check_state(after, name, "after") : status;
}

Status check_image(const ImageTarget& target, VkFormat format, std::string_view name) {
    if (target.format != format) {
        return refused(
            name,
            "has the format number " + std::to_string(static_cast<int>(target.format)) + "; " +
                (format == VK_FORMAT_R32_SFLOAT ? "VK_FORMAT_R32_SFLOAT" : "VK_FORMAT_R32_UINT") +
                " (" + std::to_string(static_cast<int>(format)) + ") is what can be written");
    }
    if ((target.usage & VK_IMAGE_USAGE_STORAGE_BIT) == 0) {
        return refused(name, "was created with the usage " + hexadecimal(target.usage) +
                                 ", which lacks VK_IMAGE_USAGE_STORAGE_BIT");
    }
    if (target.view == VK_NULL_HANDLE) {
        return refused(name, "has no view to write through (ImageTarget::view)");
    }
    if (Status status = check_states(target.before, target.after, name); !status.ok()) {
        return status;
    }
    if (Status status = check_layout(target, target.before.layout, name, "before"); !status.ok()) {
        return status;
    }
    if (target.after.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
        return refused(name,
                       "is to be left in VK_IMAGE_LAYOUT_UNDEFINED after the batch "
                       "(TargetState::layout), which is no layout to leave an image in");
    }
    return check_layout(target, target.after.layout, name, "after");
}

Status check_bytes(const BufferTarget& target, double bytes, std::string_view what,
                   std::string_view name) {
    return bytes <= static_cast<double>(target.size)
               ? Status()
               : refused(name, "has " + std::to_string(target.size) + " bytes from offset " +
                                   std::to_string(target.offset) + " on; the " + std::string(what) +
                                   " may take " + geometry::number(bytes));
}

Status check_size(const ImageTarget& target, std::string_view name, std::uint64_t width,
                  std::uint64_t height) {
    const auto [across, up] = target.extent;
    if (target.image == VK_NULL_HANDLE || (width <= across && height <= up)) {
        return {};
    }
    return refused(name, "has " + size_text(across, up) + " texels; the field has " +
                             size_text(width, height) + " cells");
}

/// Of a storage buffer. `used`: "written".
Status check_place(std::string_view name, VkBufferUsageFlags usage, const char* used,
                   std::uint64_t offset, std::uint64_t offset_alignment) {
    if ((usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) == 0) {
        return refused(name, "was created with the usage " + hexadecimal(usage) +
                                 ", which lacks VK_BUFFER_USAGE_STORAGE_BUFFER_BIT");
    }
    return offset % offset_alignment == 0
               ? Status()
               : refused(name, std::string("is to be ") + used + " at the offset " +
                                   std::to_string(offset) + ", which is no multiple of " +
                                   std::to_string(offset_alignment) +
                                   " (minStorageBufferOffsetAlignment of this device)");
}

/// Bytes of a buffer.
struct Range {
    std::uint64_t first = 0;
    std::uint64_t size = 0;
};

/// Of a target: what is written, and its header.
std::array<Range, 2> ranges_of(const BufferTarget& target) {
    return {{{target.offset, target.size},
             {target.header_offset.value_or(0), target.header_offset ? sizeof(HeaderData) : 0}}};
}

bool overlap(const Range& i, const Range& j) {
    return i.first < j.first + j.size && j.first < i.first + i.size;
}

/// Whether two targets have bytes in common.
bool overlap(const BufferTarget& i, const BufferTarget& j) {
    const std::array<Range, 2> ranges = ranges_of(j);
    const auto is_in_j = [&](const Range& range) {
        return std::any_of(ranges.begin(), ranges.end(),
                           [&](const Range& other) { return overlap(range, other); });
    };
    const std::array<Range, 2> of_i = ranges_of(i);
    return i.buffer == j.buffer && std::any_of(of_i.begin(), of_i.end(), is_in_j);
}

/// Of a target that is otherwise good.
Status check_header(const BufferTarget& target, std::string_view name) {
    if (!target.header_offset) {
        return {};
    }
    const std::uint64_t offset = *target.header_offset;
    if ((target.usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT) == 0) {
        return refused(name, "was created with the usage " + hexadecimal(target.usage) +
                                 ", which lacks VK_BUFFER_USAGE_TRANSFER_DST_BIT, and the header "
                                 "goes there, too (BufferTarget::header_offset)");
    }
    if (offset % sizeof(std::uint32_t) != 0 || offset > UINT64_MAX - sizeof(HeaderData)) {
        return refused(name, "is to have its header at the offset " + std::to_string(offset) +
                                 ", which is no multiple of 4 that has bytes behind it");
    }
    const auto [range, header] = ranges_of(target);
    return overlap(range, header)
               ? refused(name, "is to have its header at the offset " + std::to_string(offset) +
                                   ", within the range that is written, from " +
                                   std::to_string(range.first) + " on " +
                                   std::to_string(range.size) + " bytes")
               : Status();
}

/// `smallest`: what it holds at least, in bytes.
Status check_buffer(const BufferTarget& target, std::string_view name, std::uint64_t smallest,
                    std::string_view what, std::uint64_t offset_alignment) {
    if (target.buffer == VK_NULL_HANDLE) {
        return refused(name, "is null (BufferTarget::buffer)");
    }
    if (Status status = check_place(name, target.usage, "written", target.offset, offset_alignment);
        !status.ok()) {
        return status;
    }
    if (target.size > UINT64_MAX - target.offset) {
        return refused(name,
                       "has no number of bytes that may be written "
                       "(BufferTarget::size), such as VK_WHOLE_SIZE");
    }
    if (Status status = check_bytes(target, static_cast<double>(smallest), what, name);
        !status.ok()) {
        return status;
    }
    Status status = check_states(target.before, target.after, name);
    return status.ok() ? check_header(target, name) : status;
}

std::string taken(std::uint32_t query) {
    return "is written by query " + std::to_string(query) +
           " of the same batch, and one place takes one result";
}

}  // namespace

void Targets::clear() {
    added_.clear();
}

void Targets::drop(std::uint32_t query) {
    while (!added_.empty() && added_.back().query == query) {
        added_.pop_back();
    }
}

Status Targets::add_image(const ImageTarget& target, VkFormat format, std::string_view name,
                          std::uint32_t query) {
    if (target.image == VK_NULL_HANDLE) {
        return {};
    }
    if (Status status = check_image(target, format, name); !status.ok()) {
        return status;
    }
    for (const OfQuery& other : added_) {
        if (other.image.image == target.image && other.image.level == target.level &&
            other.image.layer == target.layer) {
            return refused(name, taken(other.query));
        }
    }
    added_.push_back({query, target, {}});
    return {};
}

Status Targets::add(const FieldTarget& target, bool has_features, std::uint32_t query) {
    if (!has_features && target.feature.image != VK_NULL_HANDLE) {
        return refused(feature_name,
                       "is not null, and the query asks for none of these to stay "
                       "(DistanceFieldQuery::features_on_device)");
    }
    Status status =
        add_image(target.signed_distance, VK_FORMAT_R32_SFLOAT, signed_distance_name, query);
    return status.ok() ? add_image(target.feature, VK_FORMAT_R32_UINT, feature_name, query)
                       : status;
}

Status Targets::add(const BufferTarget& target, std::uint32_t query) {
    // Records and samples begin with a summary, of this size at most, even if there are none.
    if (Status status = check_buffer(target, buffer_name, sizeof(IntersectionSummaryData),
                                     "summary", offset_alignment_);
        !status.ok()) {
        return status;
    }
    for (const OfQuery& other : added_) {
        if (overlap(other.buffer, target)) {
            return refused(buffer_name, taken(other.query));
        }
    }
    added_.push_back({query, {}, target});
    return {};
}

Status check_room(const FieldTarget& target, std::uint64_t width, std::uint64_t height) {
    Status status = check_size(target.signed_distance, signed_distance_name, width, height);
    return status.ok() ? check_size(target.feature, feature_name, width, height) : status;
}

Status check_room(const BufferTarget& target, double bytes, std::string_view what) {
    return check_bytes(target, bytes, what, buffer_name);
}

Status check_pair_target(const PairTarget& target, std::uint64_t offset_alignment) {
    Status status =
        check_buffer(target.pairs, pairs_name, sizeof(PairData), "first pair", offset_alignment);
    if (status.ok()) {
        status = check_buffer(target.points, points_name, sizeof(PointData), "first point",
                              offset_alignment);
    }
    return status.ok() && overlap(target.pairs, target.points)
               ? refused(points_name, "has bytes in common with that of pairs")
               : status;
}

Status check_poses(const DevicePoses& poses, std::uint32_t elements, std::uint64_t offset_alignment,
                   std::uint64_t reached) {
    if (poses.buffer == VK_NULL_HANDLE) {
        return refused(poses_name, "is null (DevicePoses::buffer)");
    }
    if (Status status =
            check_place(poses_name, poses.usage, "read", poses.offset, offset_alignment);
        !status.ok()) {
        return status;
    }
    if (poses.stride < 4 * sizeof(float) || poses.stride % sizeof(float) != 0) {
        return refused(poses_name, "has an element every " + std::to_string(poses.stride) +
                                       " bytes (DevicePoses::stride); a multiple of 4 of at least "
                                       "16 is needed");
    }
    const std::uint64_t needed = bytes_of_poses(poses, elements);
    if (poses.size < needed) {
        return refused(poses_name, "has " + std::to_string(poses.size) + " bytes from offset " +
                                       std::to_string(poses.offset) +
                                       " on; the instances need elements up to " +
                                       std::to_string(elements - 1) + ", which is " +
                                       std::to_string(needed) + " bytes");
    }
    if (needed > reached) {
        return refused(poses_name, "is needed up to byte " + std::to_string(needed) +
                                       "; the device's shaders reach " + std::to_string(reached));
    }
    if (!(std::abs(poses.origin.x) <= largest_coordinate &&
          std::abs(poses.origin.y) <= largest_coordinate)) {
        return refused(poses_name, "has the origin (" + geometry::number(poses.origin.x) + ", " +
                                       geometry::number(poses.origin.y) +
                                       "); coordinates must be finite and at most " +
                                       geometry::number(largest_coordinate) + " in magnitude");
    }
    return check_state(poses.before, poses_name, "before");
}

}  // namespace nearfield::device_input
