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

    /// Appends the instances that a point lies in, in the order in which they were added.
    void find(const Vector2& point, std::vector<std::uint32_t>& found) const;
    /// Appends the instances with which a rectangle shares a point, in the same order.
    void find(const Rectangle& rectangle, std::vector<std::uint32_t>& found) const;

private:
    void sort(std::vector<std::uint32_t>& found, std::ptrdiff_t first) const;
    [[nodiscard]] bool meets(std::uint32_t index, const geometry::Box& box) const;

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
};

}  // namespace nearfield::world
