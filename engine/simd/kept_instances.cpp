#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <bit>
#include <limits>

// Which instances are there already, in the batch or from the one before.

namespace nearfield::simd {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;

constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();

/// Each number has its own factor, so the products are independent.
std::uint64_t scattered(double number, std::uint64_t factor) {
    return std::bit_cast<std::uint64_t>(number) * factor;
}

}  // namespace

void TransformedInstances::clear() {
    for (Entry& entry : entries_) {
        entry.is_placed = false;
    }
    begin_batch();
}

bool TransformedInstances::can_be_found(const Entry& entry) {
    return entry.revision == entry.edges.placed.polygon().revision();
}

/// They share one memory, which is given up as a whole. Where everything moves, what is kept only
/// costs time.
bool TransformedInstances::keeps_small_ones() {
    std::size_t used = 0;
    std::size_t kept = 0;
    std::size_t found = 0;  // of these
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (entry.own || entry.first == nowhere) {
            continue;
        }
        kept += i < kept_ ? 1 : 0;
        if (entry.is_placed && can_be_found(entry)) {
            found += i < kept_ ? 1 : 0;
            used += room_of(entry) + (entry.first_boxes != nowhere ? room_of_boxes(entry) : 0);
        }
    }
    if (kept > 0) {
        keeping_.record(2 * found < kept);
    }
    return 2 * used > shared_.used && !keeping_.skip();
}

void TransformedInstances::begin_batch() {
    calls_ = 0;
    const bool keeps_small = keeps_small_ones();
    for (Entry& entry : entries_) {
        const bool may_stay = entry.own ? entry.is_placed : keeps_small && entry.first != nowhere;
        entry.is_kept = may_stay && can_be_found(entry);
        if (entry.own && !entry.is_kept) {
            spare_.push_back(std::move(entry.own));  // first: memory may run out
            spare_.back()->clear();
            entry.first = nowhere;
        }
    }
    const auto is_forgotten = [](const Entry& entry) { return !entry.is_kept; };
    const bool are_all_kept = std::erase_if(entries_, is_forgotten) == 0;
    kept_ = entries_.size();
    for (Entry& entry : entries_) {
        entry.is_placed = false;
    }
    if (!keeps_small) {
        shared_.clear();
    }
    if (!are_all_kept) {
        fill_slots();
    }
}

void TransformedInstances::fill_slots() {
    std::fill(slots_.begin(), slots_.end(), empty_slot);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        slots_[slot_of(entries_[i].edges.placed.polygon(), entries_[i].pose)] = i;
    }
}

bool TransformedInstances::is(const Entry& entry, const Polygon& polygon, const Pose& pose) {
    return &entry.edges.placed.polygon() == &polygon && entry.revision == polygon.revision() &&
           entry.pose == pose;
}

bool TransformedInstances::is_at(std::uint32_t index, const Polygon& polygon,
                                 const Pose& pose) const {
    return index < entries_.size() && is(entries_[index], polygon, pose);
}

std::size_t TransformedInstances::slot_of(const Polygon& polygon, const Pose& pose) const {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
    const std::uint64_t sum = factor * std::bit_cast<std::uintptr_t>(&polygon) +
                              scattered(pose.translation.x, 0xc2b2ae3d27d4eb4fU) +
                              scattered(pose.translation.y, 0x165667b19e3779f9U) +
                              scattered(pose.angle, 0xd6e8feb86659fd93U);
    // Products carry upwards only, and round numbers differ in their upper bits.
    const std::uint64_t hash = factor * (sum ^ (sum >> 32U));
    std::size_t slot = (hash >> 32U) & (slots_.size() - 1);
    while (slots_[slot] != empty_slot && !is(entries_[slots_[slot]], polygon, pose)) {
        slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
}

std::uint32_t TransformedInstances::place(const Polygon& polygon, const Pose& pose) {
    if (calls_ == found_.size()) {
        found_.push_back(empty_slot);
    }
    std::uint32_t& found = found_[calls_++];
    if (!is_at(found, polygon, pose)) {
        const auto recent = std::find_if(recent_.begin(), recent_.end(), [&](std::uint32_t index) {
            return is_at(index, polygon, pose);
        });
        found = recent != recent_.end() ? *recent : find_or_add(polygon, pose);
        // An instance that recurs in successive pairs is kept.
        recent_ = {found == recent_[1] ? recent_[0] : recent_[1], found};
    }
    entries_[found].is_placed = true;
    return found;
}

std::uint32_t TransformedInstances::find_or_add(const Polygon& polygon, const Pose& pose) {
    if (slots_.size() < 2 * (entries_.size() + 1)) {
        rehash();
    }
    std::uint32_t& slot = slots_[slot_of(polygon, pose)];
    if (slot == empty_slot) {
        const auto index = static_cast<std::uint32_t>(entries_.size());
        add(TransformedPolygon(polygon, pose), pose);
        slot = index;  // last: memory may have run out
    }
    return slot;
}

void TransformedInstances::rehash() {
    slots_.resize(std::max<std::size_t>(64, 2 * slots_.size()));
    fill_slots();
}

std::size_t TransformedInstances::bytes() const {
    std::size_t bytes = sizeof(Entry) * entries_.capacity() +
                        sizeof(std::uint32_t) * (slots_.capacity() + found_.capacity()) +
                        ring_order_.bytes();
    const auto add = [&bytes](const Memory* memory) {
        bytes += memory == nullptr
                     ? 0
                     : sizeof(Memory) + sizeof(Coordinates) * memory->coordinates.capacity() +
                           sizeof(EdgeRange) * memory->pieces.capacity() +
                           memory->on_demand.bytes();
    };
    add(&shared_);
    for (const Entry& entry : entries_) {
        add(entry.own.get());
    }
    for (const std::unique_ptr<Memory>& spare : spare_) {
        add(spare.get());
    }
    return bytes;
}

}  // namespace nearfield::simd
