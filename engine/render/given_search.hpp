#pragma once

#include <engine/device_input/point_search.hpp>
#include <engine/device_input/search_shapes.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/search_memory.hpp>
#include <passes/pair_search.hpp>

#include <cstdint>

namespace nearfield::render {

/// The search for what the device finds out about the pairs of a batch: its input and its memory,
/// for commands of others. It only grows.
class GivenSearch {
public:
    /// The passes must stay.
    GivenSearch(const gpu::Device& device, const graph::ComputeLayout& layout,
                const passes::PairSearch& search);

    /// Uploads pairs, of which there are some, and makes room for `expected` elements, or for as
    /// many as there can be. The device must not be using the memory. Throws StatusException
    /// (too_large) if the device cannot hold them.
    void upload(const device_input::SearchShapes& shapes, const device_input::GivenPairs& pairs,
                const PairCounts& expected);
    /// Call once the device is done. Throws StatusException (device_error) if it counted more than
    /// there can be.
    void read_back();
    /// What the device counted, whether or not there was room for it; where there was none, the
    /// counts after it are too small.
    [[nodiscard]] const PairCounts& counts() const { return counts_; }
    [[nodiscard]] bool had_room() const { return memory_.had_room(); }
    /// Makes room for what the device counted.
    void grow();
    /// Its memory, by part; what was found there is valid after read_back(), with room.
    [[nodiscard]] const SearchMemory& found() const { return memory_; }
    /// What passes bind.
    [[nodiscard]] gpu::BufferPart shapes() const { return shapes_.part(); }

private:
    void lay_out();

    const gpu::Device* device_;
    ShapeBuffer shapes_;
    gpu::MappedBuffer pairs_;
    SearchMemory memory_;
    std::uint64_t pair_bytes_ = 0;
    PairCounts most_{};    // that there can be
    PairCounts counts_{};  // of all parts
};

}  // namespace nearfield::render
