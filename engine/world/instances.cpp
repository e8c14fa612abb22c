#include <engine/base/status_exception.hpp>
#include <engine/localize/hierarchy.hpp>
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

std::uint32_t Instances::find(InstanceHandle handle, const char* call) const {
    require_own(handle, call);
    if (handle.index < entries_.size()) {
        const Entry& entry = entries_[handle.index];
        if (entry.present && entry.generation == handle.generation) {
            return handle.index;
        }
    }
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
        numbers_.resize(entries_.size() + 1);
        changed_.resize(entries_.size() + 1);
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
    entry.polygon = nullptr;
    ++count_;
    ++membership_;
    return {index, entry.generation, world_};
}

void Instances::note_change(std::uint32_t index) {
    Entry& entry = entries_[index];
    if (!entry.is_changed) {
        changes_.push_back(index);
        entry.is_changed = true;
    }
}

void Instances::move(std::uint32_t index, const Pose& pose) {
    note_change(index);
    ++entries_[index].moves;
    entries_[index].instance.pose = pose;
}

void Instances::set_filter(std::uint32_t index, std::uint32_t category, std::uint32_t mask) {
    note_change(index);
    ++entries_[index].moves;
    entries_[index].instance.category = category;
    entries_[index].instance.mask = mask;
}

void Instances::remove(std::uint32_t index) {
    free_.push_back(index);
    Entry& entry = entries_[index];
    entry.present = false;
    ++entry.generation;
    entry.has_edges = false;
    boxes_.remove(index);
    --count_;
    ++membership_;
}

void Instances::prepare(const FindShape& find_shape, std::uint64_t shapes_revision) {
    if (shapes_revision_ != shapes_revision) {
        for (std::uint32_t i = 0; i < entries_.size(); ++i) {
            const Entry& entry = entries_[i];
            const geometry::Polygon* const polygon =
                entry.present ? find_shape(entry.instance.shape) : nullptr;
            if (entry.present && (polygon != entry.polygon ||
                                  (polygon != nullptr && polygon->revision() != entry.revision))) {
                note_change(i);
            }
        }
        shapes_revision_ = shapes_revision;
    }
    if (!changes_.empty()) {
        ++last_change_;
    }
    for (const std::uint32_t i : changes_) {
        Entry& entry = entries_[i];
        if (entry.present) {
            entry.polygon = find_shape(entry.instance.shape);
            changed_[i] = last_change_;
            place(i);
        }
    }
    for (const std::uint32_t i : changes_) {
        entries_[i].is_changed = false;
    }
    changes_.clear();
    boxes_.prepare();
}

void Instances::place(std::uint32_t index) {
    Entry& entry = entries_[index];
    entry.has_edges = false;
    if (entry.polygon == nullptr) {
        boxes_.remove(index);
        return;
    }
    const TransformedPolygon placed(*entry.polygon, entry.instance.pose);
    entry.revision = entry.polygon->revision();
    entry.box = placed.box();
    entry.rounding = localize::placement_rounding(placed, entry.box);
    max_rounding_ = std::max(max_rounding_, entry.rounding);
    boxes_.set(index, entry.box);
}

void Instances::keep(const Entry& entry) const {
    const std::lock_guard lock(making_edges_);
    if (entry.has_edges.load(std::memory_order_relaxed)) {
        return;
    }
    entry.edges.clear();
    const std::uint32_t only =
        entry.edges.place(TransformedPolygon(*entry.polygon, entry.instance.pose));
    entry.edges.complete(only);
    entry.tree.emplace(entry.edges[only].tree());
    entry.has_edges.store(true, std::memory_order_release);
}

std::size_t Instances::bytes() const {
    std::size_t bytes = sizeof(Entry) * entries_.size() + boxes_.bytes() +
                        sizeof(std::uint32_t) * (free_.capacity() + changes_.capacity()) +
                        sizeof(std::uint64_t) * (numbers_.capacity() + changed_.capacity());
    for (const Entry& entry : entries_) {
        bytes += entry.edges.bytes();
    }
    return bytes;
}

void Instances::trim() {
    boxes_.trim();
    for (Entry& entry : entries_) {
        entry.edges = {};
        entry.has_edges = false;
    }
}

}  // namespace nearfield::world
