#include <engine/base/status_exception.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/magnitude.hpp>
#include <engine/world/instances.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace nearfield::world {

using geometry::TransformedPolygon;

void Instances::require_own(InstanceHandle handle, const char* call) const {
    if (handle.world != world_ && !(handle == InstanceHandle{})) {
        throw StatusException({StatusCode::unknown_instance,
                               std::string(call) + ": the instance of index " +
                                   std::to_string(handle.index) + " is of another world (number " +
                                   std::to_string(handle.world) + "; this one is number " +
                                   std::to_string(world_) + ")"});
    }
}

void Instances::refuse(InstanceHandle handle, const char* call) const {
    require_own(handle, call);
    throw StatusException(
        {StatusCode::unknown_instance, std::string(call) + ": the instance of index " +
                                           std::to_string(handle.index) +
                                           " was removed from this world, or never added to it"});
}

InstanceHandle Instances::add(const WorldInstance& instance) {
    if (free_.empty()) {
        // Allocate first: if this fails, nothing has changed.
        free_.reserve(1);
        if (changes_.capacity() <= entries_.size()) {
            changes_.reserve(2 * entries_.size() + 8);  // for all, so that changes never fail
        }
        if (kept_.size() == entries_.size()) {
            kept_.push_back(std::make_unique<Kept>());
        }
        bounds_.resize(kept_.size());
        numbers_.resize(kept_.size());
        changed_.resize(kept_.size());
        entries_.emplace_back();
        free_.push_back(static_cast<std::uint32_t>(entries_.size() - 1));
    }
    const std::uint32_t index = free_.back();
    note_change(index);
    free_.pop_back();
    Entry& entry = entries_[index];
    entry.instance = instance;
    entry.present = true;
    numbers_[index] = next_number_++;
    kept_[index]->polygon = nullptr;
    ++count_;
    ++membership_;
    return {index, entry.generation, world_};
}

void Instances::note_change(std::uint32_t index) {
    is_prepared_ = false;
    Entry& entry = entries_[index];
    if (!entry.is_changed) {
        changes_.push_back(index);
        entry.is_changed = true;
    }
}

void Instances::move(std::span<const InstanceHandle> instances, std::span<const Pose> poses) {
    ++all_moves_;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint32_t index = instances[i].index;
        note_change(index);
        ++entries_[index].moves;
        entries_[index].instance.pose = poses[i];
    }
}

void Instances::set_filter(std::uint32_t index, std::uint32_t category, std::uint32_t mask) {
    const WorldInstance& instance = entries_[index].instance;
    if (instance.category == category && instance.mask == mask) {
        return;
    }
    note_change(index);
    ++entries_[index].moves;
    ++all_moves_;
    ++filters_;
    entries_[index].instance.category = category;
    entries_[index].instance.mask = mask;
}

void Instances::remove(std::uint32_t index) {
    free_.push_back(index);
    note_change(index);
    Entry& entry = entries_[index];
    entry.present = false;
    ++entry.generation;
    kept_[index]->has_edges = false;
    boxes_.remove(index);
    --count_;
    ++membership_;
}

void Instances::take_in_changes(const FindShape& find_shape, std::uint64_t shapes_revision) {
    if (shapes_revision_ != shapes_revision) {
        for (std::uint32_t i = 0; i < entries_.size(); ++i) {
            const Entry& entry = entries_[i];
            const Kept& kept = *kept_[i];
            const geometry::Polygon* const polygon =
                entry.present ? find_shape(entry.instance.shape) : nullptr;
            if (entry.present && (polygon != kept.polygon ||
                                  (polygon != nullptr && polygon->revision() != kept.revision))) {
                note_change(i);
            }
        }
        shapes_revision_ = shapes_revision;
    }
    if (!changes_.empty()) {
        ++last_change_;
    }
    for (const std::uint32_t i : changes_) {
        const Entry& entry = entries_[i];
        changed_[i] = last_change_;
        if (entry.present) {
            kept_[i]->polygon = find_shape(entry.instance.shape);
            place(i);
        }
    }
    for (const std::uint32_t i : changes_) {
        entries_[i].is_changed = false;
    }
    changes_.clear();
    boxes_.prepare();
    is_prepared_ = true;
}

void Instances::place(std::uint32_t index) {
    Kept& kept = *kept_[index];
    Bounds& bounds = bounds_[index];
    kept.has_edges = false;
    if (kept.polygon == nullptr) {
        bounds.box.setEmpty();
        boxes_.remove(index);
        return;
    }
    const Pose& pose = entries_[index].instance.pose;
    const TransformedPolygon placed(*kept.polygon, pose);
    kept.revision = kept.polygon->revision();
    static_cast<geometry::Bounds&>(bounds) = geometry::bounds_of(placed);
    bounds.magnitude = geometry::largest_magnitude(placed, pose, bounds.box);
    max_rounding_ = std::max(max_rounding_, bounds.rounding);
    boxes_.set(index, bounds.box);
}

void Instances::make_edges(std::uint32_t index) const {
    const std::lock_guard lock(making_edges_);
    const Kept& kept = *kept_[index];
    if (kept.has_edges.load(std::memory_order_relaxed)) {
        return;
    }
    kept.edges.place_alone(TransformedPolygon(*kept.polygon, entries_[index].instance.pose),
                           &bounds_[index].box);
    kept.edges.prepare(0);
    kept.tree.emplace(kept.edges[0].tree());
    kept.has_edges.store(true, std::memory_order_release);
}

std::size_t Instances::bytes() const {
    std::size_t bytes = sizeof(Entry) * entries_.capacity() + sizeof(Kept) * kept_.size() +
                        sizeof(kept_.front()) * kept_.capacity() + boxes_.bytes() +
                        sizeof(Bounds) * bounds_.capacity() +
                        sizeof(std::uint32_t) * (free_.capacity() + changes_.capacity()) +
                        sizeof(std::uint64_t) * (numbers_.capacity() + changed_.capacity());
    for (const std::unique_ptr<Kept>& kept : kept_) {
        bytes += kept->edges.bytes();
    }
    return bytes;
}

void Instances::trim() {
    boxes_.trim();
    is_prepared_ = false;
    for (const std::unique_ptr<Kept>& kept : kept_) {
        kept->edges = {};
        kept->has_edges = false;
    }
}

}  // namespace nearfield::world
