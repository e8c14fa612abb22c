// How deep is an arrow inside a U-shaped channel, and which way is out?
#include <nearfield/nearfield.hpp>

#include <cstdio>
#include <vector>

int main() {
    nearfield::Context context;  // CPU only; Context::create() takes your Vulkan device
    // A shape is a list of rings: outer boundaries and holes, in any order and orientation.
    const std::vector<nearfield::Ring> arrow_rings{
        {{0, -1}, {4, -1}, {4, -2}, {7, 0}, {4, 2}, {4, 1}, {0, 1}}};
    const std::vector<nearfield::Ring> channel_rings{
        {{0, -5}, {10, -5}, {10, 5}, {0, 5}, {0, 3}, {8, 3}, {8, -3}, {0, -3}}};
    const auto arrow = context.add_shape(arrow_rings);
    const auto channel = context.add_shape(channel_rings);

    // The vertices of the arrow that lie in the channel's wall when the arrow stands at (1.5, 0.5).
    const auto deep = context.answer(
        nearfield::PenetrationQuery{.a = {arrow, {.translation = {1.5, 0.5}}},
                                    .b = {channel},
                                    .tolerance = 0.1,
                                    .points = nearfield::PenetrationPoints::vertices});
    if (!deep) {  // also reports a shape that add_shape() rejected
        std::puts(deep.error().text().c_str());
        return 1;
    }
    for (const auto& point : deep->points) {
        std::printf("(%g, %g) is %g deep; out along (%g, %g)\n", point.position.x, point.position.y,
                    point.depth, point.direction.x, point.direction.y);
    }
}
