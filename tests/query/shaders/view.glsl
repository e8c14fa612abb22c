// Picture parameters shared by all of a host's shaders: y up in the world, down in the picture.

layout(push_constant) uniform View {
    vec2 field_low;      // low corner of the picture relative to the field's origin, world units
    vec2 records_low;    // the same relative to the records' origin
    vec2 samples_low;    // and relative to the samples'
    vec2 pixels;         // of the picture
    float step;          // world units per pixel
    float cell;          // side of the field's cells
    ivec2 cells;
    float arrow_length;  // world units
    float line_spacing;  // world units from one line of equal distance to the next
} view;

// The vertex position of a point given relative to the low corner of the picture.
vec4 in_picture(vec2 place) {
    vec2 pixel = place / view.step;
    return vec4(2.0 * pixel.x / view.pixels.x - 1.0, 1.0 - 2.0 * pixel.y / view.pixels.y, 0.0, 1.0);
}
