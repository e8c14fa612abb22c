#include <engine/batch/shape_store.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::batch {

ShapeStore::Shape* ShapeStore::find_shape(ShapeHandle handle) {
    if (handle.context != errors_.context() || handle.index >= shapes_.size()) {
        return nullptr;
    }
    Shape& shape = shapes_[handle.index];
    return shape.current != nullptr && shape.generation == handle.generation ? &shape : nullptr;
}

const geometry::Polygon* ShapeStore::find(ShapeHandle handle) {
    Shape* const shape = find_shape(handle);
    return shape == nullptr ? nullptr : &shape->current->polygon;
}

void ShapeStore::retire(Version& version) {
    version.current = false;
    if (version.holders == 0) {
        make_spare(version);
    }
}

void ShapeStore::make_spare(Version& version) {
    version.next_spare = std::exchange(shapes_[version.shape].spare, &version);
}

Status ShapeStore::replace(std::uint32_t index, std::span<const Ring> rings, double deviation) {
    Shape& shape = shapes_[index];
    if (shape.spare == nullptr) {
        shape.spare = versions_.emplace_back(std::make_unique<Version>()).get();
        shape.spare->shape = index;
    }
    Version& next = *shape.spare;
    if (Status status = next.polygon.assign(rings, deviation); !status.ok()) {
        return status;
    }
    shape.spare = next.next_spare;
    next.current = true;
    if (Version* const former = std::exchange(shape.current, &next)) {
        retire(*former);
    }
    return {};
}

Expected<ShapeHandle> ShapeStore::add(std::span<const Ring> rings, double deviation) {
    if (free_shapes_.empty()) {
        // Allocate first: if this fails, the store is unchanged.
        free_shapes_.reserve(1);
        shapes_.emplace_back();
        free_shapes_.push_back(static_cast<std::uint32_t>(shapes_.size() - 1));
    }
    const std::uint32_t index = free_shapes_.back();
    if (Status status = replace(index, rings, deviation); !status.ok()) {
        return status;
    }
    free_shapes_.pop_back();
    return ShapeHandle{index, shapes_[index].generation, errors_.context()};
}

Status ShapeStore::update(ShapeHandle handle, std::span<const Ring> rings, double deviation) {
    Shape* const shape = find_shape(handle);
    if (shape == nullptr) {
        return errors_.unknown("update_shape", handle);
    }
    ++revision_;
    return shape->current->holders == 0 ? shape->current->polygon.assign(rings, deviation)
                                        : replace(handle.index, rings, deviation);
}

Status ShapeStore::remove(ShapeHandle handle) {
    Shape* const shape = find_shape(handle);
    if (shape == nullptr) {
        return errors_.unknown("remove_shape", handle);
    }
    ++revision_;
    free_shapes_.push_back(handle.index);
    retire(*std::exchange(shape->current, nullptr));
    ++shape->generation;
    return {};
}

const geometry::Polygon* ShapeStore::hold(ShapeHandle handle, Held& held) {
    Shape* const shape = find_shape(handle);
    if (shape == nullptr) {
        return nullptr;
    }
    Version& version = *shape->current;
    if (version.last_holder != &held) {
        held.versions_.push_back(&version);
        version.last_holder = &held;
        ++version.holders;
    }
    return &version.polygon;
}

void ShapeStore::release(const Held& held, Version& version) {
    if (version.last_holder == &held) {
        version.last_holder = nullptr;
    }
    if (--version.holders == 0 && !version.current) {
        make_spare(version);
    }
}

void ShapeStore::release(Held& held) {
    for (Version* const version : held.versions_) {
        release(held, *version);
    }
    held.versions_.clear();
}

void ShapeStore::release(Held& held, const geometry::Polygon& polygon) {
    const auto found =
        std::find_if(held.versions_.begin(), held.versions_.end(),
                     [&](const Version* version) { return &version->polygon == &polygon; });
    if (found != held.versions_.end()) {
        release(held, **found);
        *found = held.versions_.back();
        held.versions_.pop_back();
    }
}

}  // namespace nearfield::batch
