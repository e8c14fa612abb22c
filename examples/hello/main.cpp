// How deep is an arrow inside a U-shaped channel, and which way is out? Answered on the CPU,
// without a Vulkan driver.
#include <nearfield/nearfield.hpp>

#include <cstdio>

int main() {
    auto context = nearfield::Context::create_cpu();
    if (!context) {
        std::printf("%s\n", context.error().text().c_str());
        return 1;
    }
    // A shape is a list of rings: outer boundaries and holes, in any order and orientation.
    const nearfield::Ring arrow{{0, -1}, {4, -1}, {4, -2}, {7, 0}, {4, 2}, {4, 1}, {0, 1}};
    const nearfield::Ring channel{{0, -5}, {10, -5}, {10, 5}, {0, 5},
                                  {0, 3},  {8, 3},   {8, -3}, {0, -3}};
    const auto a = context->add_shape({&arrow, 1});
    const auto b = context->add_shape({&channel, 1});
    if (!a || !b) {
        std::printf("%s\n", (a.has_value() ? b : a).error().text().c_str());
        return 1;
    }
    // The vertices of the arrow that lie in the channel's wall when the arrow stands at (1.5, 0.5).
    const auto answer = context->answer(nearfield::PenetrationQuery{
        .a = {.shape = *a, .pose = {.translation = {1.5, 0.5}, .angle = 0}},
        .b = {.shape = *b},
        .tolerance = 0.1,
        .points = nearfield::PenetrationPoints::vertices});
    if (!answer) {
        std::printf("%s\n", answer.error().text().c_str());
        return 1;
    }
    for (const nearfield::PenetrationRecord& record : answer->records) {
        std::printf("(%g, %g) is %g deep; out along (%g, %g)\n", record.point.x, record.point.y,
                    record.depth, record.direction.x, record.direction.y);
    }
}
