// Shared by the kernels that count crossings of rays, per instruction set: each kernel source
// includes this file as often as Highway includes that source.

#include <engine/simd/crossing_kernels.hpp>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_LEFT_OUT_EDGES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_LEFT_OUT_EDGES_INL_HPP
#undef NEARFIELD_LEFT_OUT_EDGES_INL_HPP
#else
#define NEARFIELD_LEFT_OUT_EDGES_INL_HPP
#endif

#include <engine/simd/box_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

// Exchanging x and y turns an upward ray into one to the right.
template <bool upwards>
HWY_INLINE EdgeArrays turned(const EdgeArrays& edges) {
    return upwards ? EdgeArrays{edges.count, edges.start_y, edges.start_x, edges.end_y, edges.end_x}
                   : edges;
}
template <bool upwards>
HWY_INLINE LanesOfExtent turned(const LanesOfExtent& boxes) {
    return upwards ? LanesOfExtent{boxes.low_y, boxes.low_x, boxes.high_y, boxes.high_x} : boxes;
}

struct NoneLeftOut {
    [[nodiscard]] HWY_INLINE double Reach() const { return 0.0; }
    [[nodiscard]] HWY_INLINE LaneMask Are(const EdgeLanes& /*edges*/, Lanes x, Lanes /*y*/) const {
        return hn::Lt(x, x);
    }
};

/// Leaves out edges that run along a line through the point, as far as the rounding of the edges
/// and of the point allows this to be decided.
class LineLeftOut {
public:
    HWY_INLINE LineLeftOut(Lanes along_x, Lanes along_y, double rounding)
        : along_x_(along_x), along_y_(along_y), reach_(4.0 * rounding) {}
    HWY_INLINE LineLeftOut(const LineOfEdge& line, bool upwards)
        : LineLeftOut(hn::Set(Tag(), upwards ? line.along_y : line.along_x),
                      hn::Set(Tag(), upwards ? line.along_x : line.along_y), line.rounding) {}

    [[nodiscard]] HWY_INLINE double Reach() const { return reach_; }
    [[nodiscard]] HWY_INLINE LaneMask Are(const EdgeLanes& edges, Lanes x, Lanes y) const {
        const Lanes reach = hn::Set(Tag(), reach_);
        const Lanes edge_x = hn::Sub(edges.end_x, edges.start_x);
        const Lanes edge_y = hn::Sub(edges.end_y, edges.start_y);
        // The sum of the coordinates bounds the length from above and needs no square root.
        const Lanes length = hn::Add(hn::Abs(edge_x), hn::Abs(edge_y));
        const Lanes lengths = hn::Add(length, hn::Add(hn::Abs(along_x_), hn::Abs(along_y_)));
        const Lanes beside = hn::Abs(
            cross_lanes(edge_x, edge_y, hn::Sub(x, edges.start_x), hn::Sub(y, edges.start_y)));
        const Lanes aslant = hn::Abs(cross_lanes(along_x_, along_y_, edge_x, edge_y));
        return hn::And(hn::Le(beside, hn::Mul(reach, length)),
                       hn::Le(aslant, hn::Mul(reach, lengths)));
    }

private:
    Lanes along_x_;
    Lanes along_y_;
    double reach_;
};

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
