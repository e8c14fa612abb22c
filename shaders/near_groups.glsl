// The threads of a workgroup that make a list of boxes or edges near a square together. Include after
// near_edges.glsl; the shader declares scratch[] and lists[]. Lists are in ascending order, whatever the
// number of threads.

const uint threads = 32u;
layout(local_size_x = threads) in;

const uint max_listed = words_of_region - 1u;
const uint max_rows = 4u;
const uint point_count = 5u;  // of a square: its centre and its corners
const uint largest = 0xffffffffu;

shared uint words_by_point[point_count * threads];
shared uint least_by_point[point_count * max_rows];
shared uint chosen[point_count];
shared uint counts[threads];

// A word for each point of a square. Non-negative floats have the same order as their bits.
struct Words {
    uint centre;
    uvec4 corners;
};

const Words no_words = Words(largest, uvec4(largest));

Words least(Words a, Words b) {
    return Words(min(a.centre, b.centre), min(a.corners, b.corners));
}

// In place of the lowest bits of a number, where its element is: the least of such words names the
// element of a number that is the least, or all but the least.
const uint place_mask = 4095u;

Words with_place(float centre, vec4 corners, uint place) {
    return Words((floatBitsToUint(centre) & ~place_mask) | place,
                 (floatBitsToUint(corners) & ~place_mask) | place);
}

Words places_of(Words words) {
    return Words(words.centre & place_mask, words.corners & place_mask);
}

void share(Words words) {
    uint thread = gl_LocalInvocationID.x;
    words_by_point[thread] = words.centre;
    for (uint i = 0u; i < 4u; ++i) {
        words_by_point[(i + 1u) * threads + thread] = words.corners[i];
    }
    barrier();
}

// The least word for a point that the threads of a row have shared, those whose numbers are equal modulo
// `rows`.
uint least_for(uint point, uint row, uint rows) {
    uint least = largest;
    for (uint k = row; k < threads; k += rows) {
        least = min(least, words_by_point[point * threads + k]);
    }
    return least;
}

// The least of the words of the threads of a row.
Words least_of(Words words, uint rows) {
    share(words);
    uint thread = gl_LocalInvocationID.x;
    for (uint i = thread; i < point_count * rows; i += threads) {
        least_by_point[i] = least_for(i / rows, i % rows, rows);
    }
    barrier();
    uvec4 i = thread % rows + rows * uvec4(1u, 2u, 3u, 4u);
    return Words(least_by_point[thread % rows],
                 uvec4(least_by_point[i.x], least_by_point[i.y], least_by_point[i.z],
                       least_by_point[i.w]));
}

// The sum of the counts of the threads of this row before this one, and of all threads of the row. Needs
// a barrier before the next call.
uint sum_before(uint count, uint rows, out uint total) {
    uint thread = gl_LocalInvocationID.x;
    counts[thread] = count;
    barrier();
    uint before = 0u;
    total = 0u;
    for (uint k = thread % rows; k < threads; k += rows) {
        before = k == thread ? total : before;
        total += counts[k];
    }
    return before;
}

// How many of `count` elements each thread of a row takes: consecutive ones, one bit each.
uint run_of(uint count, uint rows) {
    uint sharing = threads / rows;
    return min((count + sharing - 1u) / sharing, 32u);
}

const uint elements_at_once = 32u * threads;  // of all rows

// Boxes of a level, or edges: all of them, those in a list, or the children of those in a list. The list
// of a region is in the scratch memory.
struct Elements {
    bool are_edges;
    uint level;  // of boxes
    uint count;
    uint from;
    uint list;  // its first word
};

const uint from_all = 0u;
const uint from_list = 1u;
const uint from_parents = 2u;
const uint from_region = 3u;

uint boxes_of(Shape shape, uint level) {
    return (shape.chunks + (1u << (3u * level)) - 1u) >> (3u * level);
}

uint element_at(Elements elements, uint i) {
    if (elements.from == from_parents) {
        return chunk_size * lists[elements.list + i / chunk_size] + i % chunk_size;
    }
    return elements.from == from_all    ? i
           : elements.from == from_list ? lists[elements.list + i]
                                        : scratch[elements.list + i];
}

// Not all parents have all children.
bool exists(Shape shape, Elements elements, uint element) {
    return elements.from != from_parents ||
           element < (elements.are_edges ? edges_end(shape, element / chunk_size)
                                         : boxes_of(shape, elements.level));
}

// Lists those that can be nearest, or have the nearest edge; returns their number. Those for which there
// is no room are missing. Each row of threads has a list, and a square.
uint list_near(Square square, Shape shape, Limits limits, Elements elements, uint rows, uint list,
               uint room) {
    uint unit = elements.are_edges ? shape.edges : word_at(shape.first_boxes + elements.level);
    uint listed = 0u;
    for (uint base = 0u; base < elements.count; base += elements_at_once / rows) {
        uint run = run_of(elements.count - base, rows);
        uint first = base + gl_LocalInvocationID.x / rows * run;
        uint near = 0u;
        for (uint i = 0u; i < run && first + i < elements.count; ++i) {
            uint element = element_at(elements, first + i);
            if (exists(shape, elements, element)) {
                vec4 place = floats_at(unit + element);
                vec2 way = elements.are_edges ? way_from_edge(square.centre, place)
                                              : way_from_box(square.centre, place);
                near |= can_be_nearest(square, limits, way) ? 1u << i : 0u;
            }
        }
        uint total;
        uint place = listed + sum_before(bitCount(near), rows, total);
        for (; near != 0u && place < room; ++place) {
            lists[list + place] = element_at(elements, first + take_bit(near));
        }
        listed += total;
        barrier();
    }
    return listed;
}

// How near a box is to the points: the lower, the sooner it has the nearest edge.
Words nearness_of(Square square, vec4 box, uint place) {
    vec2 way = way_from_box(square.centre, box);
    vec4 x = square.corners_x - clamp(square.corners_x, vec4(box.x), vec4(box.z));
    vec4 y = square.corners_y - clamp(square.corners_y, vec4(box.y), vec4(box.w));
    vec2 from_middle = square.centre - 0.5 * (box.xy + box.zw);
    vec4 middle_x = square.corners_x - 0.5 * (box.x + box.z);
    vec4 middle_y = square.corners_y - 0.5 * (box.y + box.w);
    return with_place(16.0 * dot(way, way) + dot(from_middle, from_middle),
                      16.0 * (x * x + y * y) + middle_x * middle_x + middle_y * middle_y, place);
}

// The same for an edge.
Words nearness_of_edge(Square square, vec4 edge, uint place) {
    vec2 way = way_from_edge(square.centre, edge);
    return with_place(dot(way, way), corner_distances(square, edge), place);
}

vec2 point_of(Square square, uint point) {
    return point == 0u ? square.centre
                       : vec2(square.corners_x[point - 1u], square.corners_y[point - 1u]);
}

// From a box to the chunk that seems the nearest to a point: a box of each level.
uint descend(Shape shape, uint level, uint box, vec2 point) {
    for (; level > 0u; --level) {
        Group group = group_of(shape, level - 1u, box);
        uint best = 0u;
        float least = infinity;
        for (uint i = 0u; i < chunk_size; ++i) {
            vec4 bounds = floats_at(group.first + min(i, group.count - 1u));
            vec2 way = way_from_box(point, bounds);
            vec2 from_middle = point - 0.5 * (bounds.xy + bounds.zw);
            float nearness = 16.0 * dot(way, way) + dot(from_middle, from_middle);
            best = nearness < least ? i : best;
            least = min(nearness, least);
        }
        box = chunk_size * box + best;
    }
    return box;
}

// Chooses a chunk for each point.
void choose_chunks(Square square, Shape shape, Elements boxes) {
    uint first = word_at(shape.first_boxes + boxes.level);
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x; i < boxes.count; i += threads) {
        vec4 box = floats_at(first + element_at(boxes, i));
        nearest = least(nearest, nearness_of(square, box, i));
    }
    share(nearest);
    uint point = gl_LocalInvocationID.x;
    if (point < point_count) {
        uint place = least_for(point, 0u, 1u) & place_mask;
        chosen[point] = descend(shape, boxes.level, element_at(boxes, place), point_of(square, point));
    }
    barrier();
}

// Of the edges of the chosen chunks those nearest to the points are the rivals.
Limits limits_by_chosen(FieldTileData tile, Shape shape, Square square) {
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x; i < point_count * chunk_size; i += threads) {
        uint chunk = chosen[i / chunk_size];
        uint last = edges_end(shape, chunk) - 1u - chunk_size * chunk;
        uint place = i / chunk_size * chunk_size + min(i % chunk_size, last);
        vec4 edge = floats_at(shape.edges + chunk_size * chunk + place % chunk_size);
        nearest = least(nearest, nearness_of_edge(square, edge, place));
    }
    Words places = places_of(least_of(nearest, 1u));
    uvec4 of_corners = places.corners / chunk_size;
    uvec4 chunks = uvec4(chosen[of_corners.x], chosen[of_corners.y], chosen[of_corners.z],
                         chosen[of_corners.w]);
    return limits_of(tile, shape, square,
                     chunk_size * chosen[places.centre / chunk_size] + places.centre % chunk_size,
                     chunk_size * chunks + places.corners % chunk_size);
}
