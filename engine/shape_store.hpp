#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// The shapes of a context. A batch in flight holds the shapes it uses: whoever updates or removes
/// one meanwhile leaves the held polygon as it is, and another takes its place in the store. Where
/// nobody holds a shape, updating it is one copy into the memory it has. Each shape keeps the
/// memory of its former polygons, so that shapes that deform every frame allocate nothing once they
/// have as many as there are frames in flight.
class ShapeStore {
public:
    /// What one holder holds.
    class Held;

    [[nodiscard]] Expected<ShapeHandle> add(std::span<const Ring> rings, double deviation);
    Status update(ShapeHandle handle, std::span<const Ring> rings, double deviation);
    Status remove(ShapeHandle handle);

    /// The polygon as it is now, or null; until the shape is updated or removed.
    [[nodiscard]] const geometry::Polygon* find(ShapeHandle handle);
    /// The same, until `held` is released.
    const geometry::Polygon* hold(ShapeHandle handle, Held& held);
    /// Lets go of all that is held.
    void release(Held& held);

private:
    struct Version {
        geometry::Polygon polygon;
        Version* next_spare = nullptr;      // of the same shape
        const Held* last_holder = nullptr;  // if it still holds it
        std::uint32_t holders = 0;
        std::uint32_t shape = 0;
        bool current = false;  // is what its shape looks like now
    };
    struct Shape {
        Version* current = nullptr;  // null where the shape was removed
        Version* spare = nullptr;    // a list: neither current nor held
        std::uint32_t generation = 0;
    };

    [[nodiscard]] Shape* find_shape(ShapeHandle handle);
    /// Gives a shape another polygon, or refuses the rings and changes nothing.
    Status replace(std::uint32_t index, std::span<const Ring> rings, double deviation);
    void retire(Version& version);
    void make_spare(Version& version);

    std::vector<std::unique_ptr<Version>> versions_;
    std::vector<Shape> shapes_;
    std::vector<std::uint32_t> free_shapes_;
};

class ShapeStore::Held {
private:
    friend class ShapeStore;
    std::vector<Version*> versions_;  // each once
};

}  // namespace nearfield
