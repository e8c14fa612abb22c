// Points beside segments.

vec2 nearest_on_segment(vec2 p, vec2 a, vec2 b) {
    vec2 d = b - a;
    float squared = dot(d, d);
    return a + (squared > 0.0 ? clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0) * d;
}

// Whether a ray from a point to growing x crosses a segment.
bool crosses(vec2 p, vec2 a, vec2 b) {
    // Half-open in y, so a vertex on the ray counts once.
    return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}
