// Shared by the kernels about lists of edges, per instruction set: each kernel source includes this
// file as often as Highway includes that source.

#include <engine/geometry/edge_list_kernels.hpp>

#include <cstddef>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_EDGE_LIST_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_EDGE_LIST_INL_HPP
#undef NEARFIELD_EDGE_LIST_INL_HPP
#else
#define NEARFIELD_EDGE_LIST_INL_HPP
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::HWY_NAMESPACE {

/// The vectors to points from the nearest points of edges: of one edge from several points, or the
/// other way round. Without MulAdd, which rounds once on some instruction sets and twice on others.
template <class Tag>
struct Away {
    using Vector = hwy::HWY_NAMESPACE::Vec<Tag>;

    Vector x;
    Vector y;

    [[nodiscard]] HWY_INLINE Vector squared() const {
        namespace hn = hwy::HWY_NAMESPACE;
        return hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    }
};

/// `number(which)`: a number of the edges, see EdgeList::Number.
template <class Tag, class Number, class Vector = hwy::HWY_NAMESPACE::Vec<Tag>>
HWY_INLINE Away<Tag> away_from(Tag d, const Number& number, Vector x, Vector y) {
    namespace hn = hwy::HWY_NAMESPACE;
    const Vector to_x = hn::Sub(x, number(EdgeList::start_x));
    const Vector to_y = hn::Sub(y, number(EdgeList::start_y));
    Vector parameter = hn::Add(hn::Mul(to_x, number(EdgeList::inverse_x)),
                               hn::Mul(to_y, number(EdgeList::inverse_y)));
    parameter = hn::Min(hn::Max(parameter, hn::Zero(d)), hn::Set(d, 1.0F));
    return {hn::Sub(to_x, hn::Mul(parameter, number(EdgeList::along_x))),
            hn::Sub(to_y, hn::Mul(parameter, number(EdgeList::along_y)))};
}

}  // namespace nearfield::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
