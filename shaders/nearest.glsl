// The nearest edge to a point, and the side of the boundary on which the point lies, computed on
// B's own edges. Include after layout.glsl.

const float infinity = 1.0 / 0.0;

bool run_crosses(vec2 p, EdgeData edge) {
    bool odd = false;
    vec2 a = geometry[edge.run];
    for (uint i = 1u; i <= edge.run_count; ++i) {
        vec2 b = geometry[edge.run + i];
        odd = odd != crosses(p, a, b);
        a = b;
    }
    return odd;
}

// Odd-even rule on the original boundary. A run of edges and the straight edge that replaces it
// enclose no point outside the box around both, so only points in that box need the run itself.
bool inside_by_crossings(vec2 p, EdgeListData list) {
    bool odd = false;
    for (uint first = 0u; first < list.count; first += cluster_size) {
        vec4 box = cluster_box(list, first);
        if (p.y < box.y || p.y > box.w || p.x > box.z) {
            continue;
        }
        uint end = min(first + cluster_size, list.count);
        for (uint i = first; i < end; ++i) {
            EdgeData edge = list_edge(list, i);
            vec2 edge_low = min(edge.a, edge.b) - edge.deviation;
            vec2 edge_high = max(edge.a, edge.b) + edge.deviation;
            bool near = all(greaterThanEqual(p, edge_low)) && all(lessThanEqual(p, edge_high));
            odd = odd != (edge.run_count > 1u && near ? run_crosses(p, edge)
                                                      : crosses(p, edge.a, edge.b));
        }
    }
    return odd;
}

struct Nearest {
    float distance;
    vec2 point;
    uint edge;
};

const Nearest nothing_near = Nearest(infinity, vec2(0.0), 0u);

void consider(vec2 p, vec2 a, vec2 b, uint edge, inout Nearest nearest) {
    vec2 q = nearest_on_segment(p, a, b);
    float d = distance(p, q);
    if (d < nearest.distance) {
        nearest = Nearest(d, q, edge);
    }
}

void consider_run(vec2 p, EdgeData edge, inout Nearest nearest) {
    if (edge.run_count == 1u) {
        consider(p, edge.a, edge.b, edge.first_edge, nearest);
        return;
    }
    vec2 a = geometry[edge.run];
    for (uint i = 1u; i <= edge.run_count; ++i) {
        vec2 b = geometry[edge.run + i];
        consider(p, a, b, edge.first_edge + i - 1u, nearest);
        a = b;
    }
}

Nearest find_nearest(vec2 p, EdgeListData list, Nearest nearest) {
    for (uint first = 0u; first < list.count; first += cluster_size) {
        if (distance_to_box(p, cluster_box(list, first)) > nearest.distance) {
            continue;
        }
        uint end = min(first + cluster_size, list.count);
        for (uint i = first; i < end; ++i) {
            EdgeData edge = list_edge(list, i);
            if (distance_to_segment(p, edge.a, edge.b) - edge.deviation < nearest.distance) {
                consider_run(p, edge, nearest);
            }
        }
    }
    return nearest;
}

bool is_rival(vec2 p, vec2 a, vec2 b, Nearest nearest, float margin) {
    vec2 q = nearest_on_segment(p, a, b);
    return is_rival(nearest.distance, distance(p, q), q - nearest.point, margin);
}

bool run_has_rival(vec2 p, EdgeData edge, Nearest nearest, float margin) {
    if (edge.run_count == 1u) {
        return is_rival(p, edge.a, edge.b, nearest, margin);
    }
    vec2 a = geometry[edge.run];
    for (uint i = 1u; i <= edge.run_count; ++i) {
        vec2 b = geometry[edge.run + i];
        if (is_rival(p, a, b, nearest, margin)) {
            return true;
        }
        a = b;
    }
    return false;
}

bool has_rival(vec2 p, EdgeListData list, Nearest nearest, float margin) {
    float limit = nearest.distance + margin;
    for (uint first = 0u; first < list.count; first += cluster_size) {
        if (distance_to_box(p, cluster_box(list, first)) > limit) {
            continue;
        }
        uint end = min(first + cluster_size, list.count);
        for (uint i = first; i < end; ++i) {
            EdgeData edge = list_edge(list, i);
            if (distance_to_segment(p, edge.a, edge.b) - edge.deviation <= limit &&
                run_has_rival(p, edge, nearest, margin)) {
                return true;
            }
        }
    }
    return false;
}
