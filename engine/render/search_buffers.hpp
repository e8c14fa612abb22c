#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/point_search.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/point_search.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace nearfield::render {

/// The numbers of edges, points, and points found of a search.
using SearchCounts = std::array<std::uint32_t, plan::stages>;

/// The memory of one search for boundary points, with its descriptor set. It only grows.
class SearchBuffers {
public:
    SearchBuffers(const gpu::Device& device, const passes::ComputeLayout& layout);

    /// Uploads a search and makes room for `expected` elements, or for as many as there can be. The
    /// device must not be using the buffers. Throws StatusException (too_large) if the device
    /// cannot hold them.
    void upload(const plan::SearchShapes& shapes, const plan::PointSearch& search,
                const SearchCounts& expected);

    [[nodiscard]] const passes::PointSearch::Item& item() const { return item_; }

    /// Call once the device is done: reads the counts. Throws StatusException (device_error) if
    /// they exceed what there can be.
    void read_back();
    /// What the device found, whether or not there was room for it; where there was none, the
    /// counts after it are too small.
    [[nodiscard]] const SearchCounts& counts() const { return counts_; }
    [[nodiscard]] bool had_room() const;
    /// Makes room for what the device found.
    void grow();
    /// The points found, ordered by direction, edge and number. Valid after read_back(), with room.
    [[nodiscard]] std::span<const plan::FoundPointData> found() const;
    /// Of each, its distance from B's boundary, in units of B's frame; negative: unknown.
    [[nodiscard]] std::span<const float> depths() const;

private:
    void lay_out(const SearchCounts& expected);
    void bind() const;

    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    gpu::MappedBuffer input_;
    gpu::MappedBuffer scratch_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer arguments_;
    gpu::Owned<VkBufferView> texels_;          // of the input
    gpu::Owned<VkBufferView> scratch_texels_;  // of the scratch memory
    passes::DescriptorSets sets_;
    passes::PointSearch::Item item_;
    std::uint64_t input_bytes_ = 0;
    std::uint64_t scratch_bytes_ = 0;
    std::uint64_t revision_ = 0;  // of the shapes in the input
    SearchCounts max_counts_{};
    SearchCounts counts_{};
};

}  // namespace nearfield::render
