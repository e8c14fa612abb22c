// Searches a tile of a hit image for the samples that an intersection found, sums them up, and
// lists them where a list is asked for. A work group reserves room for all its samples at once.
// Counting goes on past the end of the room, so the host sees how much was needed.
//
// The including shader defines hit_at(texel): the number in the hit image.

const uint white = 255u;
const uint run_shift = 8u;

struct Summary {
    uint count;
    uint low_column;
    uint low_row;
    uint high_column;
    uint high_row;
};

layout(std430, set = 0, binding = 2) buffer Summaries {
    Summary summaries[];  // by tile
};

layout(std430, set = 0, binding = 3) buffer Samples {
    uint count;
    uint words[];  // plan::SampleData: three words a sample
} samples;

layout(push_constant) uniform Push {
    uint tile;
    uint capacity;  // samples there is room for; 0: none are to be listed
} push;

shared uint group_count;
shared uint group_first;
shared uvec2 group_low;
shared uvec2 group_high;

void main() {
    Tile tile = tiles[push.tile];
    uvec2 cell = gl_GlobalInvocationID.xy;
    uint hit = 0u;
    if (cell.x < tile.width && cell.y < tile.height) {
        hit = hit_at(ivec2(uvec2(tile.atlas_x, tile.atlas_y) + cell));
    }
    bool found = (hit & 255u) == white;

    if (gl_LocalInvocationIndex == 0u) {
        group_count = 0u;
        group_low = uvec2(0xffffffffu);
        group_high = uvec2(0u);
    }
    barrier();
    uint place = 0u;
    if (found) {
        place = atomicAdd(group_count, 1u);
        atomicMin(group_low.x, cell.x);
        atomicMin(group_low.y, cell.y);
        atomicMax(group_high.x, cell.x);
        atomicMax(group_high.y, cell.y);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_count > 0u) {
        atomicAdd(summaries[push.tile].count, group_count);
        atomicMin(summaries[push.tile].low_column, group_low.x);
        atomicMin(summaries[push.tile].low_row, group_low.y);
        atomicMax(summaries[push.tile].high_column, group_high.x);
        atomicMax(summaries[push.tile].high_row, group_high.y);
        if (push.capacity > 0u) {
            group_first = atomicAdd(samples.count, group_count);
        }
    }
    barrier();
    if (found && push.capacity > 0u && group_first + place < push.capacity) {
        uint word = (group_first + place) * 3u;
        samples.words[word] = cell.x | (cell.y << 16);
        samples.words[word + 1u] = push.tile;
        samples.words[word + 2u] = hit >> run_shift;
    }
}
