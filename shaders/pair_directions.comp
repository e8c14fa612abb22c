#version 450
#extension GL_GOOGLE_include_directive : require

// The directions of the search, one thread per pair: puts the pairs of each instance in ascending
// order, and transforms A's frame to B's.

#include "search.glsl"
#include "pairs.glsl"
#include "write_direction.glsl"

layout(local_size_x = group_size) in;

// queries::search_precision
const float search_precision = 1.0 / 16384.0;

struct List {
    uint first;       // direction
    uint first_item;
    uint end;
};

List list_of(uint a) {
    uvec4 list = scratch_unit(push.lists + units_of_list * a);
    return List(list.x, list.y, min(list.x + list.z, scratch[pair_total]));
}

// How many of the pairs of a list come before that with `b`.
uint rank_of(uint b, List list) {
    uint rank = 0u;
    for (uint i = list.first; i < list.end; ++i) {
        rank += scratch_word(push.pairs + 2u * i + 1u) < b ? 1u : 0u;
    }
    return rank;
}

SearchDirectionData direction_between(SearchInstanceData a, SearchInstanceData b) {
    PairQueryData query = pair_query();
    SearchDirectionData direction = frames_of(a, b);
    float margin = direction.margin;
    direction.parts = a.parts;
    // In a test, three margins more than the reach is certainly too far.
    direction.reach = (1.0 + margin_of_frames) * query.reach / b.unit +
                      (query.is_test != 0u ? margin : 0.0);
    direction.rival = query.rival / b.unit;
    direction.outside = asks_outside(query) ? 1.0 : 0.0;
    direction.doubt = margin > search_precision * query.cell / b.unit
                          ? direction.rival + 4.0 * margin
                          : -1.0;
    direction.touching = query.touching / b.unit;
    return direction;
}

void main() {
    uint found = dispatched_index();
    if (found >= scratch[pair_total]) {
        return;
    }
    uint a = scratch_word(push.pairs + 2u * found);
    uint b = scratch_word(push.pairs + 2u * found + 1u);
    List list = list_of(a);
    uint rank = rank_of(b, list);
    SearchInstanceData first = instance_at(a);
    SearchInstanceData second = instance_at(b);
    uint chunks = unit_at(first.shape).x;
    SearchDirectionData data = direction_between(first, second);
    data.first_item = list.first_item + rank * chunks;
    bool left_to_cpu = (first.left_to_cpu | second.left_to_cpu) != 0u;
    data.touching = left_to_cpu ? -1.0 : data.touching;
    data.reach = left_to_cpu ? -1e30 : data.reach;  // no edge comes near
    data.a = a;
    data.b = b;
    write_direction(list.first + rank, data, chunks, scratch[item_total]);
    scratch_units[push.frames + list.first + rank] =
        floatBitsToUint(vec4(second.unit * second.axis, second.high + second.low));
    scratch[push.verdicts + list.first + rank] = left_to_cpu ? pair_left_to_cpu : 0u;
}
