// Shared by the kernels that sort out items of FloatArrays, per instruction set: each kernel source
// includes this file as often as Highway includes that source.

#include <engine/geometry/float_arrays.hpp>

#include <cstddef>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_FLOAT_ARRAYS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_FLOAT_ARRAYS_INL_HPP
#undef NEARFIELD_FLOAT_ARRAYS_INL_HPP
#else
#define NEARFIELD_FLOAT_ARRAYS_INL_HPP
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::HWY_NAMESPACE {

/// Copies those of a vector of items, from item i of `from` on, that `kept` names to `to`, from
/// `place` on and in the same order; returns how many. `to` has room for a whole vector there.
template <class Tag, class Mask, std::size_t kinds>
HWY_INLINE std::size_t copy_kept(Tag tag, const FloatArrays<kinds>& from, std::size_t i, Mask kept,
                                 FloatArrays<kinds>& to, std::size_t place) {
    namespace hn = hwy::HWY_NAMESPACE;
    if (hn::AllFalse(tag, kept)) {
        return 0;
    }
    // Compress in registers: compressing into memory takes many times as long on some processors.
    for (std::size_t number = 0; number < kinds; ++number) {
        hn::StoreU(hn::Compress(hn::LoadU(tag, from.number(number) + i), kept), tag,
                   to.number(number) + place);
    }
    const hn::RebindToUnsigned<Tag> words;
    hn::StoreU(hn::Compress(hn::LoadU(words, from.indices() + i), hn::RebindMask(words, kept)),
               words, to.indices() + place);
    return hn::CountTrue(tag, kept);
}

}  // namespace nearfield::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
