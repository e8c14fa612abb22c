#include <engine/render/instance_buffers.hpp>

#include <algorithm>

namespace nearfield::render {
namespace {

std::uint64_t bytes_of_instances(std::uint32_t instances) {
    return sizeof(shaders::PairQueryData) +
           instances * (sizeof(shaders::SearchInstanceData) + 2 * sizeof(std::uint32_t));
}

}  // namespace

std::uint64_t units_of_boxes(std::uint32_t instances) {
    std::uint64_t boxes = 0;
    std::uint64_t level = instances;
    for (std::uint32_t i = 0; i < shaders::instance_levels; ++i) {
        boxes += level;
        level = (level + 7) / 8;
    }
    return boxes + instances;
}

InstanceBuffers::InstanceBuffers(const gpu::Device& device)
    : shapes_(device),
      instances_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
                 "nearfield pair instances") {}

void InstanceBuffers::reserve(std::uint32_t count) {
    if (count > room_) {
        room_ = 0;
        ++revision_;
        const std::uint32_t room = std::max(count, 2 * count_);
        instances_.reserve(bytes_of_instances(room));
        room_ = room;
    }
    if (count != count_) {
        ++revision_;
        count_ = count;
    }
}

void InstanceBuffers::set_query(shaders::PairQueryData query) {
    query.order = 4 * (shaders::units_of_query + shaders::units_of_instance * room_);
    std::memcpy(instances_.data(), &query, sizeof(query));
}

void InstanceBuffers::set_order(std::span<const std::uint32_t> order) {
    auto* const words =
        reinterpret_cast<std::uint32_t*>(instances_.data() + sizeof(shaders::PairQueryData) +
                                         room_ * sizeof(shaders::SearchInstanceData));
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        words[place] = order[place];
        words[order.size() + order[place]] = place;
    }
}

void InstanceBuffers::upload(const device_input::SearchShapes& shapes) {
    if (shapes_.upload(shapes)) {
        ++revision_;
    }
    instances_.flush();
}

std::uint64_t InstanceBuffers::instance_bytes() const {
    return bytes_of_instances(room_);
}

}  // namespace nearfield::render
