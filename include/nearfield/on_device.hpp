#pragma once

#include <nearfield/shape.hpp>

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <optional>

/// \file
/// Outputs on the device: results that stay on the device (Context::on_device()), for the host's
/// own shaders. The GLSL header nearfield/nearfield.glsl declares the same structures.
///
/// A query may name images or a buffer of the host as the target (FieldTarget, BufferTarget). The
/// following paragraphs describe nearfield's own.
///
/// Images and buffers belong to the batch of the query. Their contents are valid once the device
/// has executed the batch. Commands that the host submits to the same queue after Context::submit()
/// see them without a barrier, in the stages and by the accesses that OutputState states. Other
/// stages, accesses, layouts or queues need a barrier, semaphore or ownership transfer by the host,
/// which must return the images to the stated state.
///
/// They stay valid until the batch is collected, so collect it after the device has finished the
/// commands that read them. Afterwards another batch reuses them, and no handle may be used.

namespace nearfield {

/// The synchronisation state in which the host's commands find an output on the device.
struct OutputState {
    /// Vertex, fragment and compute shader; for buffers also vertex input and indirect commands.
    /// Only stages that the host's queue family has.
    VkPipelineStageFlags stages = 0;
    /// VK_ACCESS_SHADER_READ_BIT; for buffers also the reading of vertex attributes and of indirect
    /// commands, if the queue family has these stages.
    VkAccessFlags access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< of images
    /// The owner; VK_QUEUE_FAMILY_IGNORED if shared with HostDevice::reader_families.
    std::uint32_t queue_family = 0;
};

/// How the host uses an image or buffer of its own before or after the batch that writes it, on the
/// same queue. The library records the barriers that follow from it. Semaphores, and transfers of
/// ownership between queue families, are the host's.
struct TargetState {
    /// Before: stages that the batch waits for. After: stages that wait for the batch. 0: none; a
    /// semaphore or a fence of the host's orders the uses. Stages that the queue's family lacks are
    /// left out, so that the defaults suit one that only computes.
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;  ///< in these stages; 0 if there are none
    /// For images. Before: the present layout; VK_IMAGE_LAYOUT_UNDEFINED discards the contents, any
    /// other keeps the texels beyond the cells. After: the final layout.
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;

    /// True if all members are equal.
    friend bool operator==(const TargetState&, const TargetState&) = default;
};

/// The state in which nearfield leaves its own images: sampled by any shader.
inline constexpr TargetState read_by_shaders{
    VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
    VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
/// The batch waits for these shaders, and the contents are discarded.
inline constexpr TargetState former_readers{read_by_shaders.stages, read_by_shaders.access,
                                            VK_IMAGE_LAYOUT_UNDEFINED};

/// An image of the host to write to, and how it was created: two-dimensional, with one sample per
/// texel, optimal tiling, on the context's device. The library cannot query this from Vulkan, and
/// checks what is stated here.
///
/// Borrowed: image and view must exist until the batch is collected. Nothing is kept of them.
struct ImageTarget {
    VkImage image = VK_NULL_HANDLE;  ///< null: an image of nearfield's own
    /// The view that is written: one level and one layer of the image, as VK_IMAGE_VIEW_TYPE_2D, in
    /// `format` and without a swizzle.
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< as FieldOnDevice states for each image
    VkExtent2D extent{};                  ///< of the level, texels: as large as the field or larger
    VkImageUsageFlags usage = 0;          ///< contains VK_IMAGE_USAGE_STORAGE_BIT
    std::uint32_t level = 0;              ///< of `view`
    std::uint32_t layer = 0;              ///< of `view`
    TargetState before = former_readers;  ///< default: the contents are discarded
    TargetState after = read_by_shaders;  ///< needs VK_IMAGE_USAGE_SAMPLED_BIT as it is
};

/// Where a field on the device goes (DistanceFieldQuery::target): one image or both, in the formats
/// of FieldOnDevice. Cell (0, 0) is texel (0, 0). The header stays nearfield's own. The image of
/// the features must be null if DistanceFieldQuery::features_on_device is false (invalid_query).
struct FieldTarget {
    ImageTarget signed_distance = {};  ///< VK_FORMAT_R32_SFLOAT
    ImageTarget feature = {};          ///< VK_FORMAT_R32_UINT
};

/// Where points on the device or samples go (PenetrationQuery::target and others), and the arrays
/// of a PairTable (PairTarget): a range of a buffer of the host's, on the context's device. Only as
/// much is written as on_device() states. The header and the query's result (StatusCode::overflow)
/// tell of more than there is space for. Context::target_size() is a size that is never too small.
/// Borrowed until the batch is collected; nothing is kept of it.
///
///     const auto size = context.target_size(query);
///     const nearfield::BufferTarget target{.buffer = buffer, .offset = 256, .size = *size,
///                                          .usage = usage_of_buffer, .header_offset = 0};
///     query.target = &target;
struct BufferTarget {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< not null
    VkDeviceSize offset = 0;           ///< a multiple of minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< bytes from `offset` on that may be written
    VkBufferUsageFlags usage = 0;      ///< as created; contains VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
    TargetState before = former_readers;  ///< its layout is ignored
    TargetState after = read_by_shaders;  ///< its layout is ignored
    /// Where the header goes in the same buffer, outside the range: sizeof(HeaderData) bytes from
    /// this multiple of 4 on. `usage` then contains VK_BUFFER_USAGE_TRANSFER_DST_BIT, and `before`
    /// and `after` hold for the header, too. Without a value the header is nearfield's own.
    std::optional<VkDeviceSize> header_offset = std::nullopt;

    /// True if all members are equal.
    friend bool operator==(const BufferTarget&, const BufferTarget&) = default;
};

/// Where the header of an output on the device lies (HeaderData): what there is, for shaders, and
/// the arguments of vkCmdDrawIndirect and vkCmdDispatchIndirect, written by the device. The buffer
/// may be bound as a storage, indirect or vertex buffer, and copied from. Its state is the one that
/// OutputState describes for buffers, also where the output itself goes to the host's buffer; or
/// the target's `after` where the header goes there, too (BufferTarget::header_offset).
struct HeaderOnDevice {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< also holds other data; borrowed. Or the host's
    VkDeviceSize offset = 0;  ///< a multiple of minStorageBufferOffsetAlignment, or the host's
};

/// Identifies a set of a context's handles of results on the device. A host that writes descriptor
/// sets once keeps one set for each slot, and writes it again only if the revision has changed.
struct OutputSlot {
    /// The batch in flight that owns them, below Settings::batches_in_flight: two batches in flight
    /// at the same time have different ones.
    std::uint32_t index = 0;
    /// Changes whenever a handle or an offset of any output on the device of the slot does: when
    /// one grows beyond what was reserved, when there are more of them, and by Context::trim().
    /// Images and buffers of the host do not count. Sizes and capacities are those of a batch and
    /// change without it, so a permanent descriptor uses VK_WHOLE_SIZE.
    std::uint64_t revision = 0;
};

/// One image of a field, with a view of all of it.
struct ImageOnDevice {
    VkImage image = VK_NULL_HANDLE;         ///< one layer, one level; borrowed. Or the host's
    VkImageView view = VK_NULL_HANDLE;      ///< of the whole image, or the host's; borrowed
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< of image and view
};

/// A distance field (DistanceFieldQuery::on_device). Texel (column, row) is the cell with the
/// centre origin + (column + 1/2, row + 1/2) * cell; row 0 is the lowest. The images can be sampled
/// and copied from. Linear filtering of the signed distance is optional in Vulkan
/// (VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT of R32_SFLOAT); nearfield_signed_distance()
/// of the GLSL header does not need it.
struct FieldOnDevice {
    /// VK_FORMAT_R32_SFLOAT: signed distance in world units, negative inside B; the same numbers as
    /// DistanceFieldResult::values.
    ImageOnDevice signed_distance;
    /// VK_FORMAT_R32_UINT: id of the nearest feature of B's boundary (feature_bits). Null
    /// handles if DistanceFieldQuery::features_on_device is false.
    ImageOnDevice feature;
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
    /// Size of the images that are nearfield's own, at least width x height; texels beyond the
    /// cells are undefined. Images only grow, so a field whose size varies from frame to frame does
    /// not recreate them. 0 x 0 if both images are the host's.
    VkExtent2D image_extent{};
    Vector2 origin;     ///< low corner of cell (0, 0), world coordinates
    double cell = 0.0;  ///< side of a cell, world units
    /// Error bound of the signed distance at every cell, world units; at most the tolerance. It is
    /// known before the field is computed and so assumes the largest possible distance: slightly
    /// more than DistanceFieldResult::error_bound.
    double error_bound = 0.0;
    /// The state once the device has executed the batch, for nearfield's own images.
    OutputState state;
    HeaderOnDevice header;  ///< of all cells
    OutputSlot slot;        ///< for hosts that keep their descriptor sets
};

/// The points of a penetration or contact query (PenetrationQuery::on_device,
/// ContactQuery::on_device): a buffer range with a SummaryData, then space for `capacity` points
/// (PointData); the summary has their number. The buffer may be bound as a storage buffer at this
/// offset, or as a vertex or indirect buffer, and copied from.
///
/// Records are in the order of their points: along A's rings, then, for contacts, along B's. The
/// CPU does not know their number before the batch is collected. If there are more than the space
/// holds, the header says so (HeaderData::overflow), the result has StatusCode::overflow beside all
/// its other values, and the next batch has space for as many.
///
/// Each is the single-precision version of the PenetratingPoint or ContactPoint that the CPU
/// computes, except the normal of a contact of B's boundary, which points out of A. It names the
/// edge that the nearest point lies on, never a vertex; if another edge is as near up to
/// `error_bound`, it names either (point_flags::undecided).
///
/// A point may be listed on one side only if its distance differs from the contact distance by
/// at most `error_bound`, if the point is so close to the boundary that it counts as touching
/// (point_flags::touching), or if a search took too long (point_flags::undecided).
struct PointsOnDevice {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< also holds other data; borrowed. Or the host's
    VkDeviceSize offset = 0;           ///< a multiple of minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< of the range, in bytes; at most Context::target_size()
    std::uint32_t capacity = 0;        ///< maximum number of points
    Vector2 origin;                    ///< of all positions, world coordinates
    /// Error bound of every coordinate, distance and depth of the points and the summary, world
    /// units. The error of a normal is at most twice this divided by the distance, or 2^-14 if that
    /// is larger, where the point is neither touching nor undecided.
    double error_bound = 0.0;
    OutputState
        state;  ///< once the device has executed the batch; or as the target's `after` states
    HeaderOnDevice header;  ///< of the points
    OutputSlot slot;        ///< for hosts that keep their descriptor sets
};

/// The samples of an intersection query (IntersectionQuery::on_device): a buffer range with an
/// IntersectionSummaryData, then space for `capacity` samples (IntersectionSampleData); the summary
/// has their number. The buffer may be bound as a storage buffer at this offset, or as a vertex or
/// indirect buffer, and copied from.
///
/// The samples are those of IntersectionResult::samples, in the same order: by region, then row by
/// row from the low corner. The CPU does not know their number before the batch is collected. There
/// is space for every cell of every region, so no sample is ever dropped and no second submission
/// is needed. If IntersectionQuery::samples_on_device is false there is space for none, and the
/// summary still counts them all.
///
/// With D the greatest distance between two vertices of a shape, the smaller of both:
/// IntersectionKind::volume_volume examines at most D / cell + 1 rows of as many cells, at any
/// poses.
struct SamplesOnDevice {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< also holds other data; borrowed. Or the host's
    VkDeviceSize offset = 0;           ///< a multiple of minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< of the range, in bytes
    std::uint32_t capacity = 0;        ///< maximum number of samples: all cells, or 0
    /// Origin of all positions, world coordinates: the middle of all regions.
    Vector2 origin;
    double cell = 0.0;  ///< side of a cell, world units
    /// Error bound of every coordinate of the samples and the summary, world units. A sample's edge
    /// is the nearest in its chain of A's edges, up to twice this bound; the CPU may name another
    /// one as near.
    double error_bound = 0.0;
    OutputState
        state;  ///< once the device has executed the batch; or as the target's `after` states
    HeaderOnDevice header;  ///< of the samples
    OutputSlot slot;        ///< for hosts that keep their descriptor sets
};

/// NearfieldHeader of the GLSL header (std430): the size and position of an output on the device,
/// and the arguments that draw or dispatch as much as there is. `count` is the number of cells of a
/// field, or of stored points or samples.
struct HeaderData {
    VkDrawIndirectCommand points{};      ///< one vertex for each, in one instance
    VkDrawIndirectCommand quads{};       ///< six vertices and one instance for each; a field: one
    VkDispatchIndirectCommand groups{};  ///< of 64 threads, one thread for each; a field: 8 x 8
    std::uint32_t count = 0;             ///< stored; at most the capacity
    /// Origin of the positions, or the low corner of a field's cell (0, 0), rounded to single
    /// precision.
    float origin[2]{};
    float cell = 0.0F;           ///< side of a cell, world units
    std::uint32_t overflow = 0;  ///< 1: more were found than there is space for; otherwise 0
    std::uint32_t width = 0;     ///< cells along x of a field; otherwise 0
    std::uint32_t height = 0;    ///< cells along y of a field; otherwise 0
};
static_assert(sizeof(HeaderData) == 72 && offsetof(HeaderData, quads) == 16 &&
              offsetof(HeaderData, groups) == 32 && offsetof(HeaderData, count) == 44 &&
              offsetof(HeaderData, origin) == 48 && offsetof(HeaderData, overflow) == 60);

/// A feature id: a word that names the nearest part of a boundary, with two flags.
namespace feature_bits {
inline constexpr std::uint32_t index_mask = 0x0fffffff;  ///< index of the edge or vertex
inline constexpr std::uint32_t vertex = 1U << 28U;       ///< set: a vertex; clear: an edge
inline constexpr std::uint32_t unique = 1U << 30U;       ///< as PenetratingPoint::unique
/// The point lies inside the shape; of PointData: deeper than d/1024.
inline constexpr std::uint32_t inside = 1U << 31U;
}  // namespace feature_bits

/// The bits of PointData::flags.
namespace point_flags {
/// Of a batch: a contact of B's boundary, whose nearest point and feature are on A.
inline constexpr std::uint32_t on_b = 1;
/// Too close to the other boundary, by about the error, for single precision to tell inside from
/// outside: the normal is that of the edge, or (0, 0) if the edge has no length (repeated
/// vertices).
inline constexpr std::uint32_t touching = 2;
/// Another point of the boundary may be as near as `nearest`, which is as near up to the error;
/// after a search that took too long, it may also be nearer.
inline constexpr std::uint32_t undecided = 4;
}  // namespace point_flags

/// SummaryData::deepest if there is no point.
inline constexpr std::uint32_t no_point = UINT32_MAX;

/// NearfieldSummary of the GLSL header (std430).
struct SummaryData {
    std::uint32_t count = 0;  ///< number of points found; a lower bound if the capacity is 0
    /// As PointsOnDevice::capacity; 0 if the memory of the search was too small, so that nothing is
    /// stored.
    std::uint32_t capacity = 0;
    std::uint32_t deepest = no_point;  ///< the first of the greatest depth, stored or not
    float depth = 0.0F;  ///< its depth: distance inside the other shape, negative outside
};
static_assert(sizeof(SummaryData) == 16 && offsetof(SummaryData, deepest) == 8);

/// NearfieldPoint of the GLSL header (std430): a point of one shape's boundary and what is nearest
/// to it of the other's. Positions are relative to PointsOnDevice::origin or
/// PairsOnDevice::origin.
struct PointData {
    float position[2]{};  ///< on the boundary of the one shape
    float nearest[2]{};   ///< the nearest point of the other's boundary
    /// Unit vector that points out of the other shape; see point_flags::touching.
    float normal[2]{};
    float distance = 0.0F;  ///< from `position` to `nearest`, world units, >= 0
    /// The edge that `nearest` lies on, with feature_bits::unique and inside; never a vertex.
    std::uint32_t feature = 0;
    std::uint32_t edge = 0;   ///< that `position` lies on
    std::uint32_t flags = 0;  ///< point_flags
};
static_assert(sizeof(PointData) == 40 && offsetof(PointData, nearest) == 8 &&
              offsetof(PointData, normal) == 16 && offsetof(PointData, distance) == 24 &&
              offsetof(PointData, feature) == 28 && offsetof(PointData, edge) == 32);

/// IntersectionSampleData::edge if the query uses A's volume.
inline constexpr std::uint32_t no_edge = UINT32_MAX;

/// NearfieldIntersectionSummary of the GLSL header (std430). The box is relative to
/// SamplesOnDevice::origin.
struct IntersectionSummaryData {
    std::uint32_t count = 0;     ///< number of samples found
    std::uint32_t capacity = 0;  ///< as SamplesOnDevice::capacity
    float area = 0.0F;           ///< count times the area of a cell, relative error at most 2^-21
    float cell = 0.0F;           ///< side of a cell, world units
    float low[2]{};              ///< bounding box of all samples, low corner; valid if count > 0
    float high[2]{};             ///< its high corner
};
static_assert(sizeof(IntersectionSummaryData) == 32 &&
              offsetof(IntersectionSummaryData, area) == 8 &&
              offsetof(IntersectionSummaryData, low) == 16 &&
              offsetof(IntersectionSummaryData, high) == 24);

/// NearfieldIntersectionSample of the GLSL header (std430). Positions are relative to
/// SamplesOnDevice::origin.
struct IntersectionSampleData {
    float position[2]{};           ///< the centre of a cell
    std::uint32_t edge = no_edge;  ///< an edge of A nearby, if the query uses A's boundary
    std::uint32_t region = 0;      ///< index of the cell's region in ResultSummary::regions
};
static_assert(sizeof(IntersectionSampleData) == 16 && offsetof(IntersectionSampleData, edge) == 8 &&
              offsetof(IntersectionSampleData, region) == 12);

}  // namespace nearfield
