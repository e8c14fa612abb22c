// Walks over B's boxes for one place in a field tile. Include after feature_words.glsl. In B's frame
// single precision selects boxes and edges, with the tile's slack for its errors.

// A place in cells and in B's frame, and how long a cell, and the slack, are there.
struct Place {
    vec2 cells;
    vec2 in_frame;
    float scale;
    float slack;
};

Place place_at(FieldTileData tile, vec2 cells) {
    float scale = scale_of(tile);
    return Place(cells, in_frame(tile, cells), scale, tile.b.slack / scale);
}

vec2 way_to(FieldTileData tile, Shape shape, Place place, uint slot, out uint vertex) {
    SeenEdge edge = edge_seen_from(tile.b, shape, slot, place.cells);
    vertex = edge.from >= 0.0 ? first_vertex_flag : (edge.to <= 0.0 ? last_vertex_flag : 0u);
    return edge.nearest;
}

// The boxes of a group, or the edges of a chunk, within reach, one bit each.
uint boxes_near(Place place, Group group, float reach) {
    uint near = 0u;
    [[unroll]] for (uint i = 0u; i < chunk_size; ++i) {
        if (i < group.count) {
            vec4 box = floats_at(group.first + i);
            float d = distance(place.in_frame, clamp(place.in_frame, box.xy, box.zw));
            near |= d <= reach ? 1u << i : 0u;
        }
    }
    return near;
}

uint edges_near(Place place, Shape shape, uint chunk, float reach) {
    uint near = 0u;
    uint count = edges_end(shape, chunk) - chunk_size * chunk;
    [[unroll]] for (uint i = 0u; i < chunk_size; ++i) {
        if (i < count) {
            vec4 edge = floats_at(shape.edges + chunk_size * chunk + i);
            float d = distance(place.in_frame, nearest_on_segment(place.in_frame, edge.xy, edge.zw));
            near |= d <= reach ? 1u << i : 0u;
        }
    }
    return near;
}

float reach_of(Place place, float limit) {
    return limit / place.scale + place.slack;
}

void consider(FieldTileData tile, Shape shape, Place place, uint chunk, inout Nearest nearest,
              inout uint turns) {
    uint near = edges_near(place, shape, chunk, reach_of(place, nearest.distance));
    for (; near != 0u; near &= near - 1u) {
        ++turns;
        uint slot = chunk_size * chunk + findLSB(near);
        uint vertex;
        vec2 way = way_to(tile, shape, place, slot, vertex);
        float size = length(way);
        // Of equally near edges the first along the boxes, as in lists.
        if (size < nearest.distance || (size == nearest.distance && slot < nearest.edge)) {
            nearest = Nearest(size, way, slot, vertex);
        }
    }
}

// Goes to the next chunk within reach; false at the end, or if the walk is too long.
bool next_chunk(Shape shape, Place place, float reach, inout Walk walk, inout bool enters,
                inout uint turns, out uint chunk) {
    while (turns < max_walk_turns) {
        ++turns;
        if (enters) {
            add_boxes(walk, boxes_near(place, group_of(shape, walk.level, walk.group), reach));
        }
        if (!next_box(walk, chunk)) {
            return false;
        }
        enters = walk.level > 0u;
        if (!enters) {
            return true;
        }
        descend(walk, chunk);
    }
    return false;
}

Nearest find_nearest(FieldTileData tile, Shape shape, Place place, inout uint turns) {
    Nearest nearest = nothing_near;
    consider(tile, shape, place, nearest_chunk(shape, place.in_frame), nearest, turns);
    Walk walk = start_walk(shape);
    bool enters = true;
    uint chunk;
    while (next_chunk(shape, place, reach_of(place, nearest.distance), walk, enters, turns, chunk)) {
        consider(tile, shape, place, chunk, nearest, turns);
    }
    return nearest;
}

bool find_rival(FieldTileData tile, Shape shape, Place place, Nearest nearest, inout uint turns) {
    float margin = margin_of(tile, nearest.distance);
    float reach = reach_of(place, nearest.distance + margin);
    Walk walk = start_walk(shape);
    bool enters = true;
    uint chunk;
    while (next_chunk(shape, place, reach, walk, enters, turns, chunk)) {
        uint near = edges_near(place, shape, chunk, reach);
        for (; near != 0u; near &= near - 1u) {
            ++turns;
            uint vertex;
            uint slot = chunk_size * chunk + findLSB(near);
            vec2 way = way_to(tile, shape, place, slot, vertex);
            if (is_rival(nearest.distance, length(way), way - nearest.point, margin)) {
                return true;
            }
        }
    }
    return false;
}

// Whether a ray from the place to growing x, in cells, meets a box.
bool ray_meets(FieldTileData tile, Place place, vec4 box) {
    vec2 along = vec2(tile.b.axis.x, -tile.b.axis.y) / place.scale;
    vec2 away = 0.5 * (box.xy + box.zw) - place.in_frame;
    vec2 half_size = 0.5 * (box.zw - box.xy);
    return abs(dot(along.yx * vec2(-1.0, 1.0), away)) <= dot(abs(along.yx), half_size) + place.slack &&
           dot(along, away) >= -dot(abs(along), half_size) - place.slack;
}

bool ray_crosses(FieldTileData tile, Shape shape, Place place, uint slot) {
    vec4 high = floats_at(shape.edges + slot);
    vec4 low = low_parts(tile.b, slot);
    Exact a = placed(tile.b, high.xy, low.xy, place.cells);
    Exact b = placed(tile.b, high.zw, low.zw, place.cells);
    // Half-open in y, so a vertex on the ray counts once.
    if ((a.y.x > 0.0) == (b.y.x > 0.0)) {
        return false;
    }
    SeenEdge edge = seen_edge(a, b);
    float side = edge.nearest.x * edge.way.y - edge.nearest.y * edge.way.x;
    return b.y.x > 0.0 ? side > 0.0 : side < 0.0;
}

// Odd-even rule.
bool find_inside(FieldTileData tile, Shape shape, Place place, inout uint turns) {
    bool odd = false;
    Walk walk = start_walk(shape);
    bool enters = true;
    while (turns < max_walk_turns) {
        ++turns;
        if (enters) {
            Group group = group_of(shape, walk.level, walk.group);
            uint boxes = 0u;
            [[unroll]] for (uint i = 0u; i < chunk_size; ++i) {
                if (i < group.count && ray_meets(tile, place, floats_at(group.first + i))) {
                    boxes |= 1u << i;
                }
            }
            add_boxes(walk, boxes);
        }
        uint box;
        if (!next_box(walk, box)) {
            return odd;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
            continue;
        }
        uint end = edges_end(shape, box);
        for (uint slot = chunk_size * box; slot < end; ++slot) {
            ++turns;
            odd = odd != ray_crosses(tile, shape, place, slot);
        }
    }
    return odd;
}
