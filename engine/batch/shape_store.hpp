#pragma once

#include <engine/base/shape_errors.hpp>
#include <engine/base/unique_numbers.hpp>
#include <engine/geometry/polygon.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::batch {

/// The shapes of a context. A batch in flight holds the shapes it uses: an update or removal
/// meanwhile leaves the held polygon unchanged, and another one takes its place in the store. If no
/// batch holds a shape, an update is one copy into its existing memory. Each shape keeps the memory
/// of its former polygons, so that shapes that deform every frame allocate nothing once they have
/// as many polygons as there are batches in flight.
class ShapeStore {
public:
    /// The shapes that one holder holds.
    class Held;

    /// Of handles that name none of the shapes.
    [[nodiscard]] const ShapeErrors& errors() const { return errors_; }
    /// A handle that stands for a shape that was not added, and why.
    [[nodiscard]] ShapeHandle refuse(const Status& why) { return errors_.refuse(why); }

    [[nodiscard]] Expected<ShapeHandle> add(std::span<const Ring> rings, double deviation);
    Status update(ShapeHandle handle, std::span<const Ring> rings, double deviation);
    Status remove(ShapeHandle handle);

    /// How often shapes have been updated or removed.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

    /// The current polygon, or null; valid until the shape is updated or removed.
    [[nodiscard]] const geometry::Polygon* find(ShapeHandle handle);
    /// The same, but valid until `held` is released.
    const geometry::Polygon* hold(ShapeHandle handle, Held& held);
    /// Releases all held shapes.
    void release(Held& held);
    /// Releases one of them.
    void release(Held& held, const geometry::Polygon& polygon);

private:
    struct Version {
        geometry::Polygon polygon;
        Version* next_spare = nullptr;      // of the same shape
        const Held* last_holder = nullptr;  // if it still holds it
        std::uint32_t holders = 0;
        std::uint32_t shape = 0;
        bool current = false;  // the present polygon of its shape
    };
    struct Shape {
        Version* current = nullptr;  // null if the shape was removed
        Version* spare = nullptr;    // a list: neither current nor held
        std::uint32_t generation = 0;
    };

    [[nodiscard]] Shape* find_shape(ShapeHandle handle);
    /// Gives a shape another polygon, or rejects the rings and changes nothing.
    Status replace(std::uint32_t index, std::span<const Ring> rings, double deviation);
    void retire(Version& version);
    void release(const Held& held, Version& version);
    void make_spare(Version& version);

    ShapeErrors errors_{next_owner_number()};
    std::vector<std::unique_ptr<Version>> versions_;
    std::vector<Shape> shapes_;
    std::vector<std::uint32_t> free_shapes_;
    std::uint64_t revision_ = 0;
};

class ShapeStore::Held {
private:
    friend class ShapeStore;
    std::vector<Version*> versions_;  // each once
};

}  // namespace nearfield::batch
