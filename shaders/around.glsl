// The four cells around a point, row by row, then the eight further cells that central differences
// at them read.
const ivec2 around[12] = ivec2[12](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(-1, 0),
                                   ivec2(2, 0), ivec2(-1, 1), ivec2(2, 1), ivec2(0, -1),
                                   ivec2(1, -1), ivec2(0, 2), ivec2(1, 2));
