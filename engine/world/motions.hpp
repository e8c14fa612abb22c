#pragma once

#include <engine/world/instances.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// The motions of a world's instances during one step of time, with a box around each. Kept from
/// step to step: only boxes of motions that differ from those before are made anew.
class Motions {
public:
    /// Takes in a step of prepared instances: moving[i] goes from its pose to ends[i], the later
    /// one if it is named twice; the others stand still. The handles have to name instances.
    void update(const Instances& instances, std::span<const InstanceHandle> moving,
                std::span<const Pose> ends);
    /// Forgets all.
    void clear();

    /// True if the motion, or the instance itself, is not that of the step before.
    [[nodiscard]] bool has_changed(std::uint32_t index) const {
        return entries_[index].has_changed;
    }
    [[nodiscard]] const Pose& end(std::uint32_t index) const { return entries_[index].end; }
    /// Contain the instance throughout its motion, with the rounding of its vertices: no more of it
    /// is left to whoever compares boxes.
    [[nodiscard]] const geometry::Bounds& bounds(std::uint32_t index) const {
        return entries_[index].bounds;
    }
    [[nodiscard]] const BoxHierarchy& boxes() const { return boxes_; }
    /// More than the rounding of any coordinate of a box.
    [[nodiscard]] double max_rounding() const { return max_rounding_; }

private:
    struct Entry {
        Pose end;
        geometry::Bounds bounds;
        bool has_changed = false;
    };

    /// Makes the box around a motion.
    void place(std::uint32_t index, const Instances& instances);

    std::vector<Entry> entries_;          // by index
    std::vector<std::uint32_t> numbers_;  // by index: among those that move
    BoxHierarchy boxes_;
    std::uint64_t last_change_ = 0;  // of the instances, at the last update
    double max_rounding_ = 0.0;
};

}  // namespace nearfield::world
