#include <engine/geometry/recently_placed.hpp>

#include <bit>

namespace nearfield::geometry {
namespace {

/// In place of a function of the library for any number of bytes, which takes longer.
template <class Bits>
bool is_same(const Bits& a, const Bits& b) {
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

}  // namespace

BoxedPolygon RecentlyPlaced::place(const Polygon& polygon, const Pose& pose) {
    const PoseBits bits{std::bit_cast<std::uint64_t>(pose.translation.x),
                        std::bit_cast<std::uint64_t>(pose.translation.y),
                        std::bit_cast<std::uint64_t>(pose.angle)};
    // Products spread the bits of addresses and of round numbers; the high ones are the best.
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
    std::uint64_t hash = reinterpret_cast<std::uintptr_t>(&polygon);
    for (const std::uint64_t part : bits) {
        hash = (hash ^ part) * odd;
        hash ^= hash >> 32U;
    }
    Entry& entry = entries_[hash % entries_.size()];
    if (!entry.instance || &entry.instance->placed.polygon() != &polygon ||
        entry.revision != polygon.revision() || !is_same(entry.pose, bits)) {
        entry.revision = polygon.revision();
        entry.pose = bits;
        entry.instance.emplace(polygon, pose);
    }
    return *entry.instance;
}

}  // namespace nearfield::geometry
