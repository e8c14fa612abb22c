#pragma once

#include <nearfield/shape.hpp>

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>

/// \file
/// Results that stay on the device: what Context::resident() hands over to a host's own shaders.
/// The GLSL header nearfield/nearfield.glsl declares the same structures.
///
/// Images and buffers belong to the batch they are asked of. They hold what they are to hold once
/// the device has done the batch's submission, and commands that the host submits to the same queue
/// after Context::submit() see it without any barrier of its own, in the stages and by the accesses
/// that HandedOver names. Other stages, accesses, queues or layouts are for a barrier, semaphore or
/// transfer of ownership of the host's, which has to leave the images as it found them.
///
/// They stay until the batch is collected: collect it when the device is done with the commands
/// that read them. Then they serve another batch, so no handle may be used any more.

namespace nearfield {

/// In what state something is handed over.
struct HandedOver {
    VkPipelineStageFlags stages = 0;                   ///< vertex, fragment and compute shaders
    VkAccessFlags access = 0;                          ///< VK_ACCESS_SHADER_READ_BIT
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< of images
    std::uint32_t queue_family = 0;                    ///< which owns it; sharing is exclusive
};

/// One image of a field, with a view of all of it.
struct ResidentImage {
    VkImage image = VK_NULL_HANDLE;         ///< one layer, one level; borrowed
    VkImageView view = VK_NULL_HANDLE;      ///< of all of it; borrowed
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< of both
};

/// A distance field (DistanceFieldQuery::resident). Texel (column, row) stands for the cell with
/// the centre origin + (column + 1/2, row + 1/2) * cell; row 0 is the lowest. Images can be sampled
/// and copied from. Whether the signed distance may be filtered linearly is up to the device
/// (VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT of R32_SFLOAT); nearfield_signed_distance()
/// of the GLSL header needs none of it.
struct ResidentField {
    /// VK_FORMAT_R32_SFLOAT: signed distance in world units, negative inside B; the same numbers as
    /// DistanceFieldResult::values.
    ResidentImage signed_distance;
    /// VK_FORMAT_R32_UINT: id of the nearest feature of B's boundary (ResidentFeature).
    ResidentImage feature;
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
    /// Of both images, at least width x height; what lies beyond is undefined. Images only grow, so
    /// that a field whose size changes a little every frame need not have them made anew.
    VkExtent2D image_extent{};
    Vector2 origin;     ///< low corner of cell (0, 0), world coordinates
    double cell = 0.0;  ///< side of a cell, world units
    /// Of every cell's signed distance, world units; at most the tolerance. It is told before the
    /// field is there, so it counts on the farthest that a cell can be: a little more than
    /// DistanceFieldResult::error_bound.
    double error_bound = 0.0;
    HandedOver state;  ///< when the device has done the batch
};

/// A range of a buffer with a SummaryData, then `capacity` records (RecordData) of which the
/// summary says how many there are: PenetrationQuery::resident and ContactQuery::resident. The
/// buffer may be bound as a storage buffer, at this offset, and copied from.
///
/// Records are in the order of the points they stand for, along A's rings and then, of contacts,
/// B's; where the batch takes several rounds (its points in more tiles than an atlas holds) so
/// within each. Their number is not known on the CPU before the batch is collected; there is room
/// for every point that is looked at, so none is ever left out.
///
/// A record is the device's version, in single precision, of the one that the CPU makes of the same
/// point (PenetrationRecord, ContactRecord). Where both exist they name the same edge, but for a
/// nearest point closer to a vertex than `error_bound`, where one may name that vertex and the
/// other an edge next to it. A point whose distance differs from the contact distance by no more
/// than `error_bound`, or which lies no farther from the boundary than touching decides, may have a
/// record on one side alone. Points farther than 1024 cells from the other boundary may name
/// another edge, one nearer by no more than `error_bound`.
struct ResidentRecords {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< holds more than this range; borrowed
    VkDeviceSize offset = 0;           ///< a multiple of minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< of the range, in bytes
    std::uint32_t capacity = 0;        ///< records there is room for
    /// What positions are relative to, world coordinates: the middle of the points looked at.
    Vector2 origin;
    /// Of every coordinate of a record or the summary, and of distances and depths, world units.
    /// A normal is off by at most twice this over the distance, or 2^-14 where that is more.
    double error_bound = 0.0;
    HandedOver state;  ///< when the device has done the batch
};

/// A range of a buffer with an IntersectionSummaryData, then `capacity` samples
/// (IntersectionSampleData) of which the summary says how many there are:
/// IntersectionQuery::resident. The buffer may be bound as a storage buffer, at this offset, and
/// copied from.
///
/// Samples are those of IntersectionResult::samples, the same cells in the same order: by region,
/// then row by row from the low corner, however many rounds the batch takes. Their number is not
/// known on the CPU before the batch is collected; there is room for every cell of every region, so
/// none is ever left out, nor has the device to be asked again for them. Where
/// IntersectionQuery::resident_samples is false there is room for none, and the summary counts them
/// all the same.
struct ResidentSamples {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< holds more than this range; borrowed
    VkDeviceSize offset = 0;           ///< a multiple of minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< of the range, in bytes
    std::uint32_t capacity = 0;        ///< samples there is room for: all cells, or 0
    /// What positions are relative to, world coordinates: the middle of all regions.
    Vector2 origin;
    double cell = 0.0;  ///< side of a cell, world units
    /// Of every coordinate of a sample or the summary, world units. The edge that a sample names is
    /// the nearest one of its chain of A's edges, but for edges that are as near to within twice
    /// this, of which the CPU may name another.
    double error_bound = 0.0;
    HandedOver state;  ///< when the device has done the batch
};

/// A feature id: a word that says which part of a boundary is nearest, and two flags.
namespace resident_feature {
inline constexpr std::uint32_t index_mask = 0x0fffffff;  ///< index of the edge or vertex
inline constexpr std::uint32_t vertex = 1U << 28U;       ///< a vertex, else an edge
inline constexpr std::uint32_t unique = 1U << 30U;       ///< as PenetrationRecord::unique
inline constexpr std::uint32_t inside = 1U << 31U;       ///< the place lies inside the shape
}  // namespace resident_feature

/// RecordData::flags.
namespace resident_flags {
/// A contact of B's boundary, whose nearest point and feature are A's.
inline constexpr std::uint32_t on_b = 1;
/// Too near the boundary for single precision to say inside or outside: the normal is the edge's.
inline constexpr std::uint32_t touching = 2;
}  // namespace resident_flags

/// In place of the position of a record.
inline constexpr std::uint32_t no_record = UINT32_MAX;

/// NearfieldSummary of the GLSL header (std430).
struct SummaryData {
    std::uint32_t count = 0;            ///< records
    std::uint32_t capacity = 0;         ///< as ResidentRecords::capacity
    std::uint32_t deepest = no_record;  ///< the record of the greatest depth; of several the first
    float depth = 0.0F;  ///< its depth: the distance inside the other shape, less than 0 outside
    float low[2]{};      ///< the smallest box that holds all records' points, where there are some
    float high[2]{};     ///< its other corner
};
static_assert(sizeof(SummaryData) == 32 && offsetof(SummaryData, deepest) == 8 &&
              offsetof(SummaryData, low) == 16 && offsetof(SummaryData, high) == 24);

/// NearfieldRecord of the GLSL header (std430). Positions are relative to ResidentRecords::origin.
struct RecordData {
    float point[2]{};    ///< on the boundary of A, or of B (resident_flags::on_b)
    float nearest[2]{};  ///< of the other shape's boundary, nearest to it
    /// Unit, pointing out of B: where B's signed distance grows. Of a penetrating point the way
    /// out.
    float normal[2]{};
    float distance = 0.0F;      ///< from `point` to `nearest`, world units
    std::uint32_t feature = 0;  ///< id of the feature that `nearest` lies on
    std::uint32_t flags = 0;    ///< resident_flags
    std::uint32_t place = 0;    ///< among the points looked at: along A's rings, then along B's
};
static_assert(sizeof(RecordData) == 40 && offsetof(RecordData, nearest) == 8 &&
              offsetof(RecordData, normal) == 16 && offsetof(RecordData, distance) == 24 &&
              offsetof(RecordData, feature) == 28 && offsetof(RecordData, flags) == 32 &&
              offsetof(RecordData, place) == 36);

/// In place of an edge of a sample, where A takes part by its volume.
inline constexpr std::uint32_t no_edge = UINT32_MAX;

/// NearfieldIntersectionSummary of the GLSL header (std430).
struct IntersectionSummaryData {
    std::uint32_t count = 0;     ///< samples found
    std::uint32_t capacity = 0;  ///< as ResidentSamples::capacity
    float area = 0.0F;           ///< count times the area of a cell, to 2^-21 of itself
    float cell = 0.0F;           ///< side of a cell, world units
    float low[2]{};              ///< the smallest box that holds all samples, where there are some
    float high[2]{};             ///< its other corner
};
static_assert(sizeof(IntersectionSummaryData) == 32 &&
              offsetof(IntersectionSummaryData, area) == 8 &&
              offsetof(IntersectionSummaryData, low) == 16 &&
              offsetof(IntersectionSummaryData, high) == 24);

/// NearfieldIntersectionSample of the GLSL header (std430). Positions are relative to
/// ResidentSamples::origin.
struct IntersectionSampleData {
    float point[2]{};              ///< the centre of a cell
    std::uint32_t edge = no_edge;  ///< where A takes part by its boundary: an edge of A nearby
    std::uint32_t region = 0;      ///< which of ResultSummary::regions the cell belongs to
};
static_assert(sizeof(IntersectionSampleData) == 16 && offsetof(IntersectionSampleData, edge) == 8 &&
              offsetof(IntersectionSampleData, region) == 12);

}  // namespace nearfield
