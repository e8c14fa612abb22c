// Places for the points of a workgroup's edges, one edge per thread. The first point of each direction
// starts a thread of the next step, which has no points of two directions: they would have no boxes in
// common. Include after search.glsl.

const uint places_group = 8u;  // threads whose edges are looked at first
const uint begins_direction = 1u << 31;
shared uint points_of_edges[search_block];  // with a flag
shared uvec4 places_of_groups[search_block / places_group];

// Points of consecutive edges.
struct Places {
    uint first;   // of the direction that has begun before them
    uint whole;   // of the directions that begin and end among them, padded to whole threads
    uint last;    // of the one that begins last
    bool begins;  // one does
};

uint padded(uint points) {
    return points_per_thread * ((points + points_per_thread - 1u) / points_per_thread);
}

void add_edge(inout Places places, uint points) {
    bool begins = (points & begins_direction) != 0u;
    if (begins) {
        places.whole += places.begins ? padded(places.last) : 0u;
        places.last = 0u;
        places.begins = true;
    }
    uint own = points & ~begins_direction;
    places.first += places.begins ? 0u : own;
    places.last += places.begins ? own : 0u;
}

// What follows those whose first edge begins a direction.
void add_places(inout Places places, Places more) {
    uint last = places.last + more.first;
    places.whole += more.begins ? padded(last) + more.whole : 0u;
    places.last = more.begins ? more.last : last;
}

// Returns the place of a thread's first point. The last thread also stores the number of places of all
// at a word of the scratch memory. `begins`: the edge before this one has another direction. Call from
// every thread of the workgroup.
uint place_before(bool begins, uint points, uint block_word) {
    uint own = gl_LocalInvocationID.x;
    uint group = own / places_group;
    points_of_edges[own] = points | (begins ? begins_direction : 0u);
    barrier();
    Places before = Places(0u, 0u, 0u, false);
    for (uint i = places_group * group; i < own; ++i) {
        add_edge(before, points_of_edges[i]);
    }
    if (own % places_group + 1u == places_group) {
        Places all = before;
        add_edge(all, points_of_edges[own]);
        places_of_groups[group] = uvec4(all.first, all.whole, all.last, all.begins ? 1u : 0u);
    }
    barrier();
    Places places = Places(0u, 0u, 0u, true);
    for (uint i = 0u; i < group; ++i) {
        uvec4 more = places_of_groups[i];
        add_places(places, Places(more.x, more.y, more.z, more.w != 0u));
    }
    add_places(places, before);
    add_edge(places, points_of_edges[own]);
    if (own + 1u == search_block) {
        shared_scratch[block_word] = places.whole + padded(places.last);
    }
    return places.whole + places.last - points;
}
