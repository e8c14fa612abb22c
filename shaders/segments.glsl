// Points beside segments and boxes.

// Relative difference of two distances far from B that single precision cannot resolve.
const float relative_margin = 1.0 / 262144.0;

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

// A second boundary point that is as near as the nearest one, up to the margin, is a rival if it is
// more than twice as far from it as one straight edge explains. The distances of both, and the way from
// one to the other.
bool is_rival(float nearest, float second, vec2 apart, float margin) {
    float limit = nearest + margin;
    float along_wall = margin * (limit + nearest);  // limit^2 - distance^2
    return second <= limit && dot(apart, apart) > 4.0 * along_wall;
}

vec2 way_to_box(vec2 p, vec4 box) {
    return max(max(box.xy - p, p - box.zw), vec2(0.0));
}
