#pragma once

#include <engine/base/function_ref.hpp>
#include <engine/base/unique_numbers.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/box_hierarchy.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <nearfield/world.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::world {

using simd::BoxHierarchy;

/// Looks up a shape; null if there is none of that handle.
using FindShape = FunctionRef<const geometry::Polygon*(ShapeHandle)>;

/// The instances of a world, each named by an index, with what is kept of them: their boxes in a
/// hierarchy, and the edges at their poses with the boxes over them, made when first needed.
///
/// Between prepare() and the next change, any number of threads may read at the same time.
class Instances {
public:
    /// Fails (unknown_instance) if the handle is of another world. `call`: for the message.
    void require_own(InstanceHandle handle, const char* call) const;
    /// Fails (unknown_instance) if there is no such instance. `call`: for the message.
    [[nodiscard]] std::uint32_t find(InstanceHandle handle, const char* call) const {
        if (handle.world != world_ || handle.index >= entries_.size() ||
            !entries_[handle.index].present ||
            entries_[handle.index].generation != handle.generation) {
            refuse(handle, call);
        }
        return handle.index;
    }
    [[nodiscard]] InstanceHandle add(const WorldInstance& instance);
    /// Precondition: find() finds all of them; as many poses.
    void move(std::span<const InstanceHandle> instances, std::span<const Pose> poses);
    void set_filter(std::uint32_t index, std::uint32_t category, std::uint32_t mask);
    void remove(std::uint32_t index);

    [[nodiscard]] const WorldInstance& operator[](std::uint32_t index) const {
        return entries_[index].instance;
    }
    [[nodiscard]] InstanceHandle handle(std::uint32_t index) const {
        return {index, entries_[index].generation, world_};
    }
    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Indices are below this; some of them may be unused.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
    [[nodiscard]] bool is_present(std::uint32_t index) const { return entries_[index].present; }
    /// Changes whenever instances are added or removed.
    [[nodiscard]] std::uint64_t membership() const { return membership_; }
    /// Changes whenever the filter of an instance does.
    [[nodiscard]] std::uint64_t filters() const { return filters_; }
    /// Changes with the pose and the filter of an instance, before prepare() too.
    [[nodiscard]] std::uint64_t moves(std::uint32_t index) const { return entries_[index].moves; }
    /// Changes with that of any instance.
    [[nodiscard]] std::uint64_t all_moves() const { return all_moves_; }

    /// Takes in what has changed since the last call. `shapes_revision`: changes whenever any shape
    /// does.
    void prepare(const FindShape& find_shape, std::uint64_t shapes_revision) {
        if (shapes_revision_ != shapes_revision || !is_prepared_) {
            take_in_changes(find_shape, shapes_revision);
        }
    }

    // The following hold between prepare() and the next change.

    [[nodiscard]] const BoxHierarchy& boxes() const { return boxes_; }
    /// True if a query considers the instance.
    [[nodiscard]] bool passes(std::uint32_t index, const WorldFilter& filter) const {
        const Entry& entry = entries_[index];
        return (entry.instance.mask & filter.category) != 0 &&
               (entry.instance.category & filter.mask) != 0 &&
               (filter.ignored.index != index || filter.ignored.generation != entry.generation);
    }
    /// True if two instances form a pair, by their categories and masks.
    [[nodiscard]] bool is_pair(std::uint32_t a, std::uint32_t b) const {
        const WorldInstance& one = entries_[a].instance;
        const WorldInstance& other = entries_[b].instance;
        return (one.category & other.mask) != 0 && (other.category & one.mask) != 0;
    }
    /// True if there is an instance and its shape exists.
    [[nodiscard]] bool is_placed(std::uint32_t index) const {
        return entries_[index].present && kept_[index]->polygon != nullptr;
    }
    /// The order in which instances were added.
    [[nodiscard]] std::uint64_t number(std::uint32_t index) const { return numbers_[index]; }
    /// Changes with the pose, the shape's rings and the filter, and where an instance comes or
    /// goes: larger than at any earlier time.
    [[nodiscard]] std::uint64_t changed(std::uint32_t index) const { return changed_[index]; }
    [[nodiscard]] std::uint64_t last_change() const { return last_change_; }
    [[nodiscard]] const geometry::Bounds& bounds(std::uint32_t index) const {
        return bounds_[index];
    }
    [[nodiscard]] const geometry::Box& box(std::uint32_t index) const { return bounds_[index].box; }
    /// Of its transformed vertices: geometry::placement_rounding.
    [[nodiscard]] double rounding(std::uint32_t index) const { return bounds_[index].rounding; }
    /// geometry::largest_magnitude
    [[nodiscard]] double magnitude(std::uint32_t index) const { return bounds_[index].magnitude; }
    [[nodiscard]] double deviation(std::uint32_t index) const {
        return kept_[index]->polygon->deviation();
    }
    /// The largest of all instances.
    [[nodiscard]] double max_rounding() const { return max_rounding_; }
    [[nodiscard]] const geometry::Polygon& polygon(std::uint32_t index) const {
        return *kept_[index]->polygon;
    }
    /// Null if its shape was removed.
    [[nodiscard]] const geometry::Polygon* find_polygon(std::uint32_t index) const {
        return kept_[index]->polygon;
    }
    /// Its edges in world coordinates, prepared.
    [[nodiscard]] const simd::TransformedEdges& edges(std::uint32_t index) const {
        return with_edges(index).edges[0];
    }
    /// The boxes over them.
    [[nodiscard]] const simd::AabbTree& tree(std::uint32_t index) const {
        return *with_edges(index).tree;
    }

    // `a` and `b`: as find() returned them.

    /// Whether two instances can share a point, by their boxes.
    [[nodiscard]] bool boxes_meet(std::uint32_t a, std::uint32_t b) const {
        return geometry::may_meet(bounds_[a], bounds_[b]);
    }
    /// Whether they share a point.
    [[nodiscard]] bool intersect(std::uint32_t a, std::uint32_t b,
                                 narrowphase::OverlapTest& test) const {
        return boxes_meet(a, b) && test.intersect(edges(a), edges(b));
    }

    [[nodiscard]] std::size_t bytes() const;
    void trim();

private:
    // What the host changes from frame to frame, side by side for all instances.
    struct Entry {
        WorldInstance instance;
        std::uint64_t moves = 0;
        std::uint32_t generation = 0;
        bool present = false;
        bool is_changed = false;  // listed in changes_
    };
    // Where an instance is. The box is empty, and so meets none, if its shape was removed.
    struct Bounds : geometry::Bounds {
        double magnitude = 0.0;
    };
    // What is kept of it besides.
    struct Kept {
        const geometry::Polygon* polygon = nullptr;  // null: its shape was removed
        std::uint64_t revision = 0;                  // of the polygon
        // Made by the first thread that needs them.
        mutable simd::TransformedInstances edges;
        mutable std::optional<simd::AabbTree> tree;
        mutable std::atomic<bool> has_edges = false;
    };

    [[noreturn]] void refuse(InstanceHandle handle, const char* call) const;
    [[nodiscard]] const Kept& with_edges(std::uint32_t index) const {
        const Kept& kept = *kept_[index];
        if (!kept.has_edges.load(std::memory_order_acquire)) {
            make_edges(index);
        }
        return kept;
    }
    void make_edges(std::uint32_t index) const;

    void take_in_changes(const FindShape& find_shape, std::uint64_t shapes_revision);
    void note_change(std::uint32_t index);
    void place(std::uint32_t index);

    std::uint32_t world_ = next_owner_number();
    std::vector<Entry> entries_;
    std::vector<std::unique_ptr<Kept>> kept_;  // which stay where they are
    std::vector<Bounds> bounds_;               // in one piece, as pairs look at any of them
    // Likewise, since tables of pairs look at all of them: the order in which instances were added,
    // and their last change.
    std::vector<std::uint64_t> numbers_;
    std::vector<std::uint64_t> changed_;
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> changes_;
    BoxHierarchy boxes_;
    std::uint32_t count_ = 0;
    std::uint64_t next_number_ = 0;
    std::uint64_t membership_ = 1;
    std::uint64_t filters_ = 0;
    std::uint64_t all_moves_ = 0;
    std::uint64_t last_change_ = 0;
    std::uint64_t shapes_revision_ = 0;
    bool is_prepared_ = false;  // no instance, and no box, has changed since prepare()
    double max_rounding_ = 0.0;
    mutable std::mutex making_edges_;
};

}  // namespace nearfield::world
