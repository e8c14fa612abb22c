#version 450
#extension GL_GOOGLE_include_directive : require

// Writes the summary and the samples of an intersection from the masks of its tiles, ordered by
// region, row and column, in three steps: one thread per row of a tile counts, one thread computes
// prefix sums and writes summary and header, one thread per row writes its samples. Boxes and counts
// of whole tiles come from the summaries that the host reads too.

#include "export.glsl"
#include "header.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) writeonly buffer Samples {
    NearfieldIntersectionSummary summary;
    NearfieldIntersectionSample samples[];
};
layout(std430, set = 0, binding = 3) buffer Blocks {
    NearfieldHeader header;
    uint blocks[];  // per tile the count and both corners, then per row the count of samples
};

layout(push_constant) uniform Push { ExportSamplesPush push; };

const float infinity = 1.0 / 0.0;

SampleTileData tile_at(uint word) {
    return SampleTileData(tables[word], tables[word + 1u], tables[word + 2u], tables[word + 3u],
                          tables[word + 4u], tables[word + 5u], tables[word + 6u],
                          tables[word + 7u], tables[word + 8u],
                          uintBitsToFloat(tables[word + 9u]), uintBitsToFloat(tables[word + 10u]));
}

// `precise`, so that boxes and samples agree bit for bit.
precise vec2 centre_of(SampleTileData tile, uint column, uint row) {
    precise vec2 offset = push.cell * (vec2(float(column), float(row)) + 0.5);
    return vec2(tile.corner_x, tile.corner_y) + offset;
}

void write_box(uint index) {
    SampleTileData tile = tile_at(push.table + words_of_tile * index);
    uint found = words_of_summary * tile.summary;
    uint count = words[found];
    uint box = words_of_box * (push.first_tile + index);
    vec2 low = vec2(infinity);
    vec2 high = vec2(-infinity);
    if (count > 0u) {
        low = centre_of(tile, words[found + 1u], words[found + 2u]);
        high = centre_of(tile, words[found + 3u], words[found + 4u]);
    }
    blocks[box] = count;
    blocks[box + 1u] = floatBitsToUint(low.x);
    blocks[box + 2u] = floatBitsToUint(low.y);
    blocks[box + 3u] = floatBitsToUint(high.x);
    blocks[box + 4u] = floatBitsToUint(high.y);
}

uint words_of_row(SampleTileData tile) {
    return (tile.width + 31u) / 32u;
}

// The samples among the 32 cells of a word of a row, one bit each.
uint found_in(SampleTileData tile, uint row, uint word) {
    uint offset = row * words_of_row(tile) + word;
    return words[tile.mask_a + offset] & words[tile.mask_b + offset];
}

uint block_of(SampleTileData tile, uint row) {
    return words_of_box * push.tile_count + tile.first_block + tile.block_step * row;
}

void count_row(SampleTileData tile, uint row) {
    uint count = 0u;
    for (uint word = 0u; word < words_of_row(tile); ++word) {
        count += uint(bitCount(found_in(tile, row, word)));
    }
    blocks[block_of(tile, row)] = count;
}

void place_rows() {
    NearfieldIntersectionSummary all = NearfieldIntersectionSummary(
        0u, push.capacity, 0.0, push.cell, vec2(infinity), vec2(-infinity));
    for (uint tile = 0u; tile < push.tile_count; ++tile) {
        uint box = words_of_box * tile;
        all.count += blocks[box];
        all.low = min(all.low, uintBitsToFloat(uvec2(blocks[box + 1u], blocks[box + 2u])));
        all.high = max(all.high, uintBitsToFloat(uvec2(blocks[box + 3u], blocks[box + 4u])));
    }
    if (all.count == 0u) {
        all.low = vec2(0.0);
        all.high = vec2(0.0);
    }
    all.area = float(all.count) * push.cell * push.cell;
    summary = all;
    header = header_of(min(all.count, all.capacity), push.origin, push.cell,
                       all.count > all.capacity);
    uint before = 0u;
    uint first_row = words_of_box * push.tile_count;
    for (uint i = 0u; i < push.block_count; ++i) {
        uint count = blocks[first_row + i];
        blocks[first_row + i] = before;
        before += count;
    }
}

uint edge_of(SampleTileData tile, uint cell) {
    return tile.edges != no_word ? words[tile.edges + cell] : nearfield_no_edge;
}

void write_row(SampleTileData tile, uint row) {
    uint place = blocks[block_of(tile, row)];
    for (uint word = 0u; word < words_of_row(tile); ++word) {
        uint found = found_in(tile, row, word);
        while (found != 0u) {
            uint column = 32u * word + uint(findLSB(found));
            found &= found - 1u;
            vec2 point = centre_of(tile, column, row);
            uint edge = edge_of(tile, row * tile.width + column);
            samples[place++] = NearfieldIntersectionSample(point, edge, tile.region);
        }
    }
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (push.step == place_step) {
        if (index == 0u) {
            place_rows();
        }
        return;
    }
    if (push.step == box_step) {
        if (index < push.tile_count) {
            write_box(index);
        }
        return;
    }
    SampleTileData tile = tile_at(push.table);
    if (index >= tile.height) {
        return;
    }
    if (push.step == count_step) {
        count_row(tile, index);
    } else {
        write_row(tile, index);
    }
}
