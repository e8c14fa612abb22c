#pragma once

#include <engine/context/implementation.hpp>
#include <engine/world/instances.hpp>

#include <memory>

namespace nearfield {

/// A world, as its tables of pairs see it.
struct WorldView {
    Context::Implementation& context;
    const std::shared_ptr<const void>& identity;  // of the world
    world::Instances& instances;

    /// Takes in what has changed in the world.
    void prepare() const {
        constexpr auto find_shape = [](void* store, ShapeHandle shape) -> const geometry::Polygon* {
            return static_cast<batch::ShapeStore*>(store)->find(shape);
        };
        instances.prepare({find_shape, &context.shapes()}, context.shapes().revision());
    }
};

}  // namespace nearfield
