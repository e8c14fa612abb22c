#pragma once

#include <engine/device_input/compute_batch_builder.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/bound_resources.hpp>

#include <cstdint>

namespace nearfield::render {

/// The imported handles of a tile batch's input and memory; null where its passes need none.
struct ComputeHandles {
    graph::Handle shapes;  ///< in tiles
    graph::Handle scratch;
    graph::Handle crowd;          ///< arguments of the dispatch for crowded blocks
    graph::Handle long_searches;  ///< in crowded blocks
};

/// The memory of the compute technique beyond the read-back: its input, and scratch memory that
/// never leaves the device. Both only grow.
class ComputeBuffers {
public:
    explicit ComputeBuffers(const gpu::Device& device);

    /// Uploads a tile batch. Throws StatusException (too_large) if a part exceeds what a storage
    /// buffer of the device may hold.
    void upload(const device_input::ComputeBatch& batch);

    /// Units of the shapes themselves, as uploaded: a later batch may have changed what is kept.
    [[nodiscard]] std::uint32_t shape_units() const { return shape_units_; }
    /// Empties the arguments of the dispatch for crowded blocks of fields, and the number of
    /// searches there that were too long; call before each submission.
    void empty_crowd() const;
    /// Call once the device is done with the last uploaded tile batch.
    [[nodiscard]] bool had_long_searches() const;
    /// The part of the scratch memory that the last uploaded tile batch uses.
    [[nodiscard]] gpu::BufferPart scratch() const { return scratch_.part(0, scratch_bytes_); }
    /// Sets what passes bind of the last uploaded tile batch.
    void bind(const ComputeHandles& handles, graph::BoundResources& resources) const;

private:
    void upload_shapes(const device_input::ComputeWork& work);

    const gpu::Device* device_;
    gpu::MappedBuffer scratch_;
    std::uint64_t scratch_bytes_ = 0;
    gpu::MappedBuffer shapes_;
    gpu::MappedBuffer crowd_;
    gpu::MappedBuffer long_searches_;
    std::uint64_t shape_bytes_ = 0;  // none: the last uploaded tile batch has no shapes in tiles
    std::uint32_t shape_units_ = 0;
    std::uint64_t revision_ = 0;  // of the shapes in shapes_
};

}  // namespace nearfield::render
