#version 450
#extension GL_GOOGLE_include_directive : require

// Offset polygons in a mask, one thread per polygon: its fan of triangles, each with the samples
// that a rasteriser finds in it (top-left rule), computed in integers. A's polygons count only
// where B's mask is set; the one with the lowest number is kept for each sample.

#include "masks.glsl"
#include "overlaps.glsl"
#include "push.h"

layout(local_size_x = group_size) in;

layout(push_constant) uniform Push { MaskPolygonsPush push; };

ivec2 corner(uint word, uint i) {
    return ivec2(work[word + 2u * i], work[word + 2u * i + 1u]);
}

// Narrows a range of samples of a row to those on the inner side of a triangle's edge. The triangle
// is counter-clockwise, so it lies left of edges that go up; samples on an edge that goes down are
// inside.
void narrow(ivec2 a, ivec2 b, int y, uint width, uint bits, inout uint begin, inout uint end) {
    if (b.y > a.y) {
        end = min(end, samples_left(a, b, y, width, bits));
    } else if (b.y < a.y) {
        begin = max(begin, samples_left(b, a, y, width, bits));
    } else if (b.x > a.x ? y < a.y : y >= a.y) {
        end = 0u;
    }
}

void cover(MaskData mask, OverlapData overlap, MaskData mask_b, uint run, uint row, uint begin,
           uint end) {
    for (uint word = begin / 32u; word <= (end - 1u) / 32u; ++word) {
        uint low = max(begin, 32u * word) - 32u * word;
        uint count = min(end, 32u * word + 32u) - 32u * word - low;
        uint bits = (count == 32u ? ~0u : (1u << count) - 1u) << low;
        if ((push.bits_of & polygons_of_a) != 0u) {
            bits &= scratch[mask_b.first_word + row * mask_b.words_per_row + word];
        }
        if (bits == 0u) {
            continue;
        }
        atomicOr(scratch[mask.first_word + row * mask.words_per_row + word], bits);
        if ((push.bits_of & polygons_of_a) != 0u && overlap.first_run != no_runs) {
            uint cells = push.runs + overlap.first_run + row * mask.width + 32u * word;
            while (bits != 0u) {
                uint bit = uint(findLSB(bits));
                bits &= bits - 1u;
                atomicMin(scratch[cells + bit], run);
            }
        }
    }
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint polygon = push.polygons + words_of_polygon * index;
    uint bits = push.bits_of & (polygons_of_a - 1u);
    OverlapData overlap = overlap_at(push.overlaps, work[polygon + overlap_of_polygon]);
    uint run = work[polygon + run_of_polygon];
    MaskData mask_b = mask_at(push.masks, overlap.mask_b);
    MaskData mask = mask_b;
    if ((push.bits_of & polygons_of_a) != 0u) {
        mask = mask_at(push.masks, overlap.mask_a);
    }
    ivec2 a = corner(polygon, 0u);
    for (uint i = 2u; i < corners_of_polygon; ++i) {
        ivec2 b = corner(polygon, i - 1u);
        ivec2 c = corner(polygon, i);
        if (product_exceeds(c.x - a.x, b.y - a.y, b.x - a.x, c.y - a.y)) {
            ivec2 former = b;
            b = c;
            c = former;
        } else if (!product_exceeds(b.x - a.x, c.y - a.y, c.x - a.x, b.y - a.y)) {
            continue;  // no area
        }
        int first_row = max(row_from(min(a.y, min(b.y, c.y)), bits), 0);
        int end_row = min(row_from(max(a.y, max(b.y, c.y)) + 1, bits), int(mask.height));
        for (int row = first_row; row < end_row; ++row) {
            int y = row_centre(row, bits);
            uint begin = 0u;
            uint end = mask.width;
            narrow(a, b, y, mask.width, bits, begin, end);
            narrow(b, c, y, mask.width, bits, begin, end);
            narrow(c, a, y, mask.width, bits, begin, end);
            if (begin < end) {
                cover(mask, overlap, mask_b, run, uint(row), begin, end);
            }
        }
    }
}
