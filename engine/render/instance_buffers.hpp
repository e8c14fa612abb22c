#pragma once

#include <engine/device_input/search_shapes.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/render/search_memory.hpp>

#include <shaders/pairs.h>

#include <cstdint>
#include <cstring>
#include <span>

namespace nearfield::render {

/// The number of boxes over so many instances on all levels, and of the places that the shaders
/// keep behind them: units of the scratch memory.
[[nodiscard]] std::uint64_t units_of_boxes(std::uint32_t instances);

/// A world's instances and their shapes on the device. The memory only grows.
class InstanceBuffers {
public:
    explicit InstanceBuffers(const gpu::Device& device);

    /// Makes room for so many instances, all of which have to be written, with query and order.
    void reserve(std::uint32_t count);
    /// What holds for all of them; the member `order` is set by this class.
    void set_query(shaders::PairQueryData query);
    void set(std::uint32_t number, const shaders::SearchInstanceData& data) {
        std::memcpy(instances_.data() + sizeof(shaders::PairQueryData) + number * sizeof(data),
                    &data, sizeof(data));
    }
    /// The instances in the order of the hierarchy: a permutation of their numbers.
    void set_order(std::span<const std::uint32_t> order);
    /// Takes shapes that have changed to the device, and what was set.
    void upload(const device_input::SearchShapes& shapes);

    /// Differs if buffers or sizes are others than before.
    [[nodiscard]] std::uint32_t revision() const { return revision_; }
    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// What passes bind.
    [[nodiscard]] gpu::BufferPart shape_part() const { return shapes_.part(); }
    [[nodiscard]] gpu::BufferPart instance_part() const {
        return instances_.part(0, instance_bytes());
    }

private:
    [[nodiscard]] std::uint64_t instance_bytes() const;

    ShapeBuffer shapes_;
    gpu::MappedBuffer instances_;
    std::uint32_t revision_ = 0;
    std::uint32_t room_ = 0;
    std::uint32_t count_ = 0;
};

}  // namespace nearfield::render
