#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/tile_batch.hpp>
#include <passes/compute_layout.hpp>
#include <passes/record_context.hpp>

#include <cstdint>

namespace nearfield::render {

/// A part of a buffer.
struct BufferPart {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
};

/// The memory of the compute technique beyond the read-back: its input, and scratch memory that
/// never leaves the device. Both only grow.
class ComputeBuffers {
public:
    explicit ComputeBuffers(const gpu::Device& device);

    /// Uploads a tile batch. Throws StatusException (too_large) if a part exceeds what a storage
    /// buffer of the device may hold.
    void upload(const plan::TileBatch& batch);

    [[nodiscard]] VkBuffer input() const { return input_.handle(); }
    [[nodiscard]] VkBuffer scratch() const { return scratch_.handle(); }
    /// Shapes in tiles of fields and masks.
    [[nodiscard]] VkBuffer shapes() const { return shapes_.handle(); }
    /// Units of the shapes themselves, as uploaded: a later batch may have changed what is kept.
    [[nodiscard]] std::uint32_t shape_units() const { return shape_units_; }
    /// The arguments of the dispatch for crowded blocks of fields, and the number of searches there
    /// that were too long.
    [[nodiscard]] VkBuffer crowd() const { return crowd_.handle(); }
    [[nodiscard]] VkBuffer long_searches() const { return long_searches_.handle(); }
    /// Empties both; call before each submission.
    void empty_crowd() const;
    /// Call once the device is done with the last uploaded tile batch.
    [[nodiscard]] bool had_long_searches() const;
    /// The part of the scratch memory that the last uploaded tile batch uses.
    [[nodiscard]] BufferPart scratch_part() const { return {scratch_.handle(), 0, scratch_bytes_}; }

    /// Parts of the read-back: by point, of all fields, by tile, the samples.
    struct Output {
        BufferPart points, field, summaries, samples;
    };
    /// Points the descriptor sets of the compute technique to the last uploaded tile batch.
    void bind(const passes::ComputeLayout& layout, const passes::TileBatchSets& sets,
              const Output& output) const;

private:
    /// Copies the contents of vectors, one after the other, into the next part of the input.
    template <class... Vectors>
    BufferPart append(const char* what, const Vectors&... vectors);
    void upload_shapes(const plan::ComputeWork& work);

    const gpu::Device* device_;
    gpu::MappedBuffer input_;
    gpu::MappedBuffer scratch_;
    std::uint64_t end_ = 0;  // of the data in the input
    std::uint64_t scratch_bytes_ = 0;
    BufferPart tiles_, points_, geometry_, work_;
    gpu::MappedBuffer shapes_;
    gpu::MappedBuffer crowd_;
    gpu::MappedBuffer long_searches_;
    gpu::Owned<VkBufferView> texels_;  // of shapes_
    std::uint64_t shape_bytes_ = 0;    // none: the last uploaded tile batch has no shapes in tiles
    std::uint32_t shape_units_ = 0;
    std::uint64_t revision_ = 0;  // of the shapes in shapes_
};

}  // namespace nearfield::render
