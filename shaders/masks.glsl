// Bit masks of tiles (compute_work.h), and the exact number of samples left of an edge. Coordinates
// are integers, in sub-pixel steps.

#include "compute_work.h"
#include "layout.h"

layout(std430, set = 0, binding = 0) readonly buffer Work {
    uint work[];
};

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

// The mask with a number; `masks`: first word of all.
MaskData mask_at(uint masks, uint number) {
    uint word = masks + words_of_mask * number;
    return MaskData(work[word], work[word + 1u], work[word + 2u], work[word + 3u]);
}

// True if a * b > c * d, computed in 64 bits.
bool product_exceeds(int a, int b, int c, int d) {
    int high_ab, low_ab, high_cd, low_cd;
    imulExtended(a, b, high_ab, low_ab);
    imulExtended(c, d, high_cd, low_cd);
    return high_ab > high_cd || (high_ab == high_cd && uint(low_ab) > uint(low_cd));
}

// The number of samples of a row that lie strictly left of the edge from `low` up to `high`, low.y
// < high.y. The row has `width` samples at x = (column + 1/2) * 2^bits and lies at y. A
// floating-point estimate is corrected in integers.
uint samples_left(ivec2 low, ivec2 high, int y, uint width, uint bits) {
    int half_cell = 1 << (bits - 1u);
    ivec2 d = high - low;
    int up = y - low.y;
    float cell = float(1 << bits);
    float crossing = (float(low.x) + float(d.x) * (float(up) / float(d.y))) / cell - 0.5;
    int count = int(clamp(ceil(crossing), 0.0, float(width)));
    while (count < int(width) &&
           product_exceeds(d.x, up, d.y, (count << bits) + half_cell - low.x)) {
        ++count;
    }
    while (count > 0 &&
           !product_exceeds(d.x, up, d.y, ((count - 1) << bits) + half_cell - low.x)) {
        --count;
    }
    return uint(count);
}

// The first row whose samples lie at or above y.
int row_from(int y, uint bits) {
    return (y + (1 << (bits - 1u)) - 1) >> bits;
}

// y of a row's samples.
int row_centre(int row, uint bits) {
    return (row << bits) + (1 << (bits - 1u));
}
