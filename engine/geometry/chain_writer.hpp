#pragma once

#include <engine/geometry/overlap.hpp>
#include <engine/geometry/polygon.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// Collects chains in order, joining neighbours.
class ChainWriter {
public:
    ChainWriter(const Polygon& polygon, std::vector<Chain>& chains)
        : polygon_(polygon), chains_(chains), ring_begin_(chains.size()) {}

    void append(std::uint32_t ring, std::uint32_t first, std::uint32_t count, const Box& box) {
        if (chains_.size() > ring_begin_ && chains_.back().ring != ring) {
            finish_ring();
        }
        if (chains_.size() > ring_begin_ && chains_.back().first + chains_.back().count == first) {
            chains_.back().count += count;
            chains_.back().box.extend(box);
        } else {
            chains_.push_back({ring, first, count, box});
        }
    }

    /// Joins the ring's last chain with its first if both touch the ring's first vertex.
    void finish_ring() {
        if (chains_.size() > ring_begin_ + 1) {
            Chain& front = chains_[ring_begin_];
            const Chain& back = chains_.back();
            if (front.first == polygon_.ring_begin(front.ring) &&
                back.first + back.count == polygon_.ring_end(back.ring)) {
                front = {back.ring, back.first, back.count + front.count,
                         front.box.merged(back.box)};
                chains_.pop_back();
            }
        }
        ring_begin_ = chains_.size();
    }

private:
    const Polygon& polygon_;
    std::vector<Chain>& chains_;
    std::size_t ring_begin_;  // index of the current ring's first chain
};

}  // namespace nearfield::geometry
