#pragma once

#include <engine/batch/context_implementation.hpp>
#include <engine/world/instances.hpp>

#include <memory>

namespace nearfield {

/// A world, as its tables of pairs and requests see it.
struct WorldView {
    Context::Implementation& context;
    const std::shared_ptr<const void>& identity;  // of the world
    world::Instances& instances;

    /// Takes in what has changed in the world.
    void prepare() const {
        batch::ShapeStore& shapes = context.shapes();
        instances.prepare([&](ShapeHandle shape) { return shapes.find(shape); }, shapes.revision());
    }
};

}  // namespace nearfield
