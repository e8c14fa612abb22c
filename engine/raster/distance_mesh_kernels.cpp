#include <engine/raster/distance_mesh_kernels.hpp>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/raster/distance_mesh_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::raster::kernels::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, pieces_at_once>;
using Floats = hn::Rebind<float, Doubles>;
using Wide = hn::Vec<Doubles>;
using Narrow = hn::Vec<Floats>;

/// SubpixelGrid::snap(). The steps are a power of two, so their inverse is exact.
HWY_INLINE Wide snap(Wide coordinate, double steps) {
    const Doubles d;
    const Wide nearest =
        hn::Floor(hn::Add(hn::Mul(coordinate, hn::Set(d, steps)), hn::Set(d, 0.5)));
    return hn::Mul(nearest, hn::Set(d, 1.0 / steps));
}

/// The side of a line from a to b on which the part of a box lies that is farthest to the left.
struct SideOfBox {
    Wide centre;
    Wide reach;  // from the value at the centre to those at the corners

    HWY_INLINE SideOfBox(Wide a_x, Wide a_y, Wide b_x, Wide b_y, const Box& box) {
        const Doubles d;
        const Vector middle = box.center();
        const Vector half = 0.5 * box.sizes();
        const Wide way_x = hn::Sub(b_x, a_x);
        const Wide way_y = hn::Sub(b_y, a_y);
        centre = hn::Sub(hn::Mul(way_x, hn::Sub(hn::Set(d, middle.y()), a_y)),
                         hn::Mul(way_y, hn::Sub(hn::Set(d, middle.x()), a_x)));
        reach = hn::Add(hn::Mul(hn::Abs(way_x), hn::Set(d, half.y())),
                        hn::Mul(hn::Abs(way_y), hn::Set(d, half.x())));
    }
    [[nodiscard]] HWY_INLINE hn::Mask<Doubles> all_right() const {
        return hn::Lt(hn::Add(centre, reach), hn::Zero(Doubles()));
    }
    [[nodiscard]] HWY_INLINE hn::Mask<Doubles> all_left() const {
        return hn::Gt(hn::Sub(centre, reach), hn::Zero(Doubles()));
    }
};

/// The triangles, one of each piece, that have an area and are not on one side of a box. Corners
/// lie on the sub-pixel grid: what is computed from them is exact.
HWY_INLINE hn::Mask<Doubles> needed(const Wide* x, const Wide* y, std::size_t third,
                                    const Box& box) {
    const Doubles d;
    const std::size_t corners[] = {0, third - 1, third};
    Wide low_x = x[0], high_x = x[0], low_y = y[0], high_y = y[0];
    for (const std::size_t c : corners) {
        low_x = hn::Min(low_x, x[c]);
        high_x = hn::Max(high_x, x[c]);
        low_y = hn::Min(low_y, y[c]);
        high_y = hn::Max(high_y, y[c]);
    }
    auto meets = hn::And(hn::And(hn::Gt(high_x, hn::Set(d, box.min().x())),
                                 hn::Lt(low_x, hn::Set(d, box.max().x()))),
                         hn::And(hn::Gt(high_y, hn::Set(d, box.min().y())),
                                 hn::Lt(low_y, hn::Set(d, box.max().y()))));
    const Wide area = hn::Sub(hn::Mul(hn::Sub(x[third - 1], x[0]), hn::Sub(y[third], y[0])),
                              hn::Mul(hn::Sub(y[third - 1], y[0]), hn::Sub(x[third], x[0])));
    const auto is_left = hn::Gt(area, hn::Zero(d));  // the inside, of the sides
    meets = hn::And(meets, hn::Ne(area, hn::Zero(d)));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = corners[i];
        const std::size_t to = corners[(i + 1) % 3];
        const SideOfBox box_side(x[from], y[from], x[to], y[to], box);
        const auto beyond = hn::Or(hn::And(is_left, box_side.all_right()),
                                   hn::AndNot(is_left, box_side.all_left()));
        meets = hn::AndNot(beyond, meets);
    }
    return meets;
}

/// Places one vector of pieces, from `lane` on; returns their largest distances.
HWY_INLINE Narrow place_vector(const Pieces& pieces, std::size_t lane, double steps,
                               const Box& within, PlacedPieces& placed) {
    const Doubles d;
    const Floats f;
    const Wide origin_x = hn::LoadU(d, pieces.origin_x + lane);
    const Wide origin_y = hn::LoadU(d, pieces.origin_y + lane);
    const Wide gradient_x = hn::LoadU(d, pieces.gradient_x + lane);
    const Wide gradient_y = hn::LoadU(d, pieces.gradient_y + lane);
    Wide x[piece_corners];
    Wide y[piece_corners];
    Narrow farthest = hn::Zero(f);
    for (std::size_t c = 0; c < piece_corners; ++c) {
        x[c] = snap(hn::LoadU(d, pieces.x[c] + lane), steps);
        y[c] = snap(hn::LoadU(d, pieces.y[c] + lane), steps);
        // Not fused: the same bits on every machine.
        const Wide height = hn::Add(hn::Mul(gradient_x, hn::Sub(x[c], origin_x)),
                                    hn::Mul(gradient_y, hn::Sub(y[c], origin_y)));
        const Narrow distance =
            hn::DemoteTo(f, hn::IfThenElseZero(hn::Gt(height, hn::Zero(d)), height));
        hn::StoreU(hn::DemoteTo(f, x[c]), f, placed.x[c] + lane);
        hn::StoreU(hn::DemoteTo(f, y[c]), f, placed.y[c] + lane);
        hn::StoreU(distance, f, placed.distance[c] + lane);
        farthest = hn::Max(farthest, distance);
    }
    for (std::size_t t = 0; t < piece_triangles; ++t) {
        const auto one = hn::IfThenElseZero(needed(x, y, t + 2, within), hn::Set(d, 1.0));
        hn::StoreU(hn::DemoteTo(f, one), f, placed.needed[t] + lane);
    }
    return farthest;
}

float place_pieces(const Pieces* pieces, std::size_t count, double steps, const Box& within,
                   PlacedPieces* placed) {
    const Floats f;
    Narrow farthest = hn::Zero(f);
    for (std::size_t i = 0; i < count; i += hn::Lanes(f)) {
        const std::size_t block = i / pieces_at_once;
        const Narrow own =
            place_vector(pieces[block], i % pieces_at_once, steps, within, placed[block]);
        // Lanes behind the last piece hold some of an earlier tile.
        farthest = hn::IfThenElse(hn::FirstN(f, count - i), hn::Max(farthest, own), farthest);
    }
    return hn::GetLane(hn::MaxOfLanes(f, farthest));
}

}  // namespace
}  // namespace nearfield::raster::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::raster::kernels {

HWY_EXPORT(place_pieces);

float place_pieces(const Pieces* pieces, std::size_t count, SubpixelGrid grid, const Box& within,
                   PlacedPieces* placed) {
    return HWY_DYNAMIC_DISPATCH(place_pieces)(pieces, count, grid.steps, within, placed);
}

}  // namespace nearfield::raster::kernels
#endif
