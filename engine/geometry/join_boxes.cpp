#include <engine/base/interruption.hpp>
#include <engine/geometry/overlap.hpp>

#include <cstddef>

namespace nearfield::geometry {
namespace {

bool worth_joining(const Box& a, const Box& b) {
    // A region has a fixed cost (a tile, its border, its commands), so a fifth more area is a fair
    // price for one region fewer.
    constexpr double max_growth = 1.2;
    return a.intersects(b) || a.merged(b).volume() < max_growth * (a.volume() + b.volume());
}

}  // namespace

void join_boxes(std::vector<Box>& boxes) {
    // The first `joined` boxes are final: no two of them are worth joining. Each further box
    // absorbs those it joins with and, having grown, is compared with all others again. Every such
    // pass leaves one box fewer, so the whole is quadratic.
    std::size_t joined = 0;
    SparseCheckpoint<16> checkpoint;
    for (std::size_t next = 0; next < boxes.size(); ++next) {
        checkpoint.step();
        Box box = boxes[next];
        for (std::size_t i = 0; i < joined;) {
            if (worth_joining(box, boxes[i])) {
                box.extend(boxes[i]);
                boxes[i] = boxes[--joined];
                i = 0;
                checkpoint.step();
            } else {
                ++i;
            }
        }
        boxes[joined++] = box;
    }
    boxes.resize(joined);
}

}  // namespace nearfield::geometry
