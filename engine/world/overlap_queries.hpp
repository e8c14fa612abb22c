#pragma once

#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::world {

/// Finds the instances that points and rectangles meet. For one thread; several objects may work on
/// one world at the same time.
class OverlapQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const WorldFilter& filter);

    /// Appends the instances that a point lies in, or on the boundary of, in any order.
    void find(const Vector2& point, std::vector<std::uint32_t>& found) const;
    /// Appends the instances with which a rectangle shares a point, in any order.
    void find(const Rectangle& rectangle, std::vector<std::uint32_t>& found) const;

private:
    [[nodiscard]] bool holds(std::uint32_t index, const geometry::Vector& point) const;
    [[nodiscard]] bool meets(std::uint32_t index, const geometry::Box& box) const;

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
};

}  // namespace nearfield::world
