#pragma once

#include <engine/world/instances.hpp>
#include <engine/world/motions.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// The pairs of instances whose boxes are near each other, kept from frame to frame: only instances
/// that changed are looked for again. Keeps its memory.
class PairList {
public:
    static constexpr std::uint32_t none = UINT32_MAX;

    /// Two instances, and what is known of the pair.
    struct Pair {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::uint32_t before =
            none;  ///< its place in the list before, if neither has changed since
    };

    /// Brings the list up to date with prepared instances. `both_ways`: each pair appears in both
    /// orders; otherwise with the instance added first as `a`.
    void update(const Instances& instances, double reach, bool both_ways);
    /// The same in one order, with boxes around the motions that `motions` was last updated with.
    void update(const Instances& instances, const Motions& motions, double reach);
    /// In ascending order of the instances' numbers.
    [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }
    /// Those of them, in ascending order, that were not in the list before or have changed since.
    [[nodiscard]] std::span<const std::uint32_t> new_pairs() const { return new_pairs_; }
    /// Forgets all.
    void clear();

private:
    /// `Boxes`: the instances, or their motions.
    template <class Boxes>
    void find_pairs_of(std::uint32_t index, const Instances& instances, const Boxes& boxes,
                       double reach, bool both_ways);
    /// Brings the list up to date with the instances that have changed.
    template <class Boxes>
    void find_overlapping_boxes(const Instances& instances, const Boxes& boxes, double reach,
                                bool both_ways);

    std::uint64_t last_change_ = 0;  // of the instances, at the last update
    std::vector<Pair> pairs_;
    std::vector<Pair> pairs_before_;
    std::vector<Pair> found_;  // of instances that changed
    std::vector<std::uint32_t> new_pairs_;
    std::vector<std::uint8_t> has_changed_;  // by index
};

}  // namespace nearfield::world
