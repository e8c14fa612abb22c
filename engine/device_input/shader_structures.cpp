#include <nearfield/on_device.hpp>
#include <nearfield/pairs_on_device.hpp>

#include <cstddef>
#include <cstdint>

// The structures and constants of on_device.hpp are those of nearfield.glsl and nearfield.hlsl,
// which stand alone for hosts that copy one of the three. Their declarations are C++ as well.
namespace nearfield::device_input {
namespace {

using uint = std::uint32_t;
template <class Number, std::size_t count>
struct alignas(count * sizeof(Number)) Several {  // as in std430
    Number numbers[count];
};

namespace glsl {
using vec2 = Several<float, 2>;  // NOLINT(readability-identifier-naming)
using uvec4 = Several<uint, 4>;  // NOLINT(readability-identifier-naming)
#include <nearfield/nearfield.glsl>
}  // namespace glsl

namespace hlsl {
using float2 = Several<float, 2>;  // NOLINT(readability-identifier-naming)
using uint4 = Several<uint, 4>;    // NOLINT(readability-identifier-naming)
#include <nearfield/nearfield.hlsl>
}  // namespace hlsl

#define NEARFIELD_SAME_MEMBER(ours, theirs, member)                           \
    static_assert(offsetof(ours, member) == offsetof(glsl::theirs, member) && \
                  offsetof(ours, member) == offsetof(hlsl::theirs, member) && \
                  sizeof(ours::member) == sizeof(glsl::theirs::member) &&     \
                  sizeof(ours::member) == sizeof(hlsl::theirs::member))

NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, points);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, quads);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, groups);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, count);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, origin);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, cell);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, overflow);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, width);
NEARFIELD_SAME_MEMBER(HeaderData, NearfieldHeader, height);

NEARFIELD_SAME_MEMBER(SummaryData, NearfieldSummary, count);
NEARFIELD_SAME_MEMBER(SummaryData, NearfieldSummary, capacity);
NEARFIELD_SAME_MEMBER(SummaryData, NearfieldSummary, deepest);
NEARFIELD_SAME_MEMBER(SummaryData, NearfieldSummary, depth);

NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, position);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, nearest);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, normal);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, distance);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, feature);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, edge);
NEARFIELD_SAME_MEMBER(PointData, NearfieldPoint, flags);

NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, count);
NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, capacity);
NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, area);
NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, cell);
NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, low);
NEARFIELD_SAME_MEMBER(IntersectionSummaryData, NearfieldIntersectionSummary, high);

NEARFIELD_SAME_MEMBER(IntersectionSampleData, NearfieldIntersectionSample, position);
NEARFIELD_SAME_MEMBER(IntersectionSampleData, NearfieldIntersectionSample, edge);
NEARFIELD_SAME_MEMBER(IntersectionSampleData, NearfieldIntersectionSample, region);

NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, a);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, b);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, count);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, flags);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, first_point);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, point_count);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, first_of_b);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, count_of_b);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, deepest);
NEARFIELD_SAME_MEMBER(PairData, NearfieldPair, depth);

#undef NEARFIELD_SAME_MEMBER

#define NEARFIELD_SAME_CONSTANT(ours, theirs) \
    static_assert((ours) == glsl::theirs && (ours) == hlsl::theirs)

NEARFIELD_SAME_CONSTANT(feature_bits::index_mask, nearfield_index_mask);
NEARFIELD_SAME_CONSTANT(feature_bits::vertex, nearfield_vertex_flag);
NEARFIELD_SAME_CONSTANT(feature_bits::unique, nearfield_unique_flag);
NEARFIELD_SAME_CONSTANT(feature_bits::inside, nearfield_inside_flag);
NEARFIELD_SAME_CONSTANT(point_flags::on_b, nearfield_on_b_flag);
NEARFIELD_SAME_CONSTANT(point_flags::touching, nearfield_touching_flag);
NEARFIELD_SAME_CONSTANT(point_flags::undecided, nearfield_undecided_flag);
NEARFIELD_SAME_CONSTANT(pair_flags::undecided, nearfield_undecided_flag);
NEARFIELD_SAME_CONSTANT(pair_flags::uncertain, nearfield_uncertain_flag);
NEARFIELD_SAME_CONSTANT(pair_flags::intersects, nearfield_intersects_flag);
NEARFIELD_SAME_CONSTANT(no_point, nearfield_no_point);
NEARFIELD_SAME_CONSTANT(no_edge, nearfield_no_edge);
#undef NEARFIELD_SAME_CONSTANT

}  // namespace
}  // namespace nearfield::device_input
