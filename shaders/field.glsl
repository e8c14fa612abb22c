// Distance and feature at a cell of a field tile, from the images of the raster passes. Include
// after nearest.glsl; the shader declares feature_image, sign_image and push.sign_mask.

// push.sign_mask holds the bits of the sign image that are set inside. feature_bit_mask means that
// sign and feature share an image: the sign in the top bit, the feature in the low 24.

uint feature_at(ivec2 texel) {
    uint feature = texelFetch(feature_image, texel, 0).x;
    if (push.sign_mask == feature_bit_mask) {
        feature &= max_signed_features;
        return feature == max_signed_features ? no_feature : feature;
    }
    return feature;
}

bool filled_at(ivec2 texel) {
    return (texelFetch(sign_image, texel, 0).x & push.sign_mask) != 0u;
}

// Signed distance at the centre of a cell (section 2.2.2 of the paper), in cells: analytic, to the
// feature that won the depth test here or at a neighbour. The sign comes from the fill.
float field_value(TileData tile, ivec2 cell) {
    ivec2 last = ivec2(tile.width, tile.height) - 1;
    ivec2 corner = ivec2(tile.atlas_x, tile.atlas_y);
    vec2 centre = vec2(cell) + 0.5;

    // The neighbours' features correct a wrong winner, caused by the flat triangles of a cone, and
    // usually supply one if rasterisation left a gap between two triangles.
    const ivec2 offsets[5] =
        ivec2[5](ivec2(0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
    float nearest = infinity;
    uint former = no_feature;
    for (int i = 0; i < 5; ++i) {
        ivec2 neighbour = clamp(cell + offsets[i], ivec2(0), last);
        uint feature = feature_at(corner + neighbour);
        if (feature != no_feature && feature != former) {
            EdgeData edge = list_edge(tile.nearest, feature);
            nearest = min(nearest, distance_to_segment(centre, edge.a, edge.b));
            former = feature;
        }
    }
    if (isinf(nearest)) {
        for (uint i = 0u; i < tile.nearest.count; ++i) {
            EdgeData edge = list_edge(tile.nearest, i);
            nearest = min(nearest, distance_to_segment(centre, edge.a, edge.b));
        }
    }
    return filled_at(corner + cell) ? -nearest : nearest;
}

// The nearest of B's own edges to a point in a cell, whether it is unique, and the side of the
// boundary, as one word (point_inside and the other flags). The images only save work.
uint field_feature(TileData tile, vec2 p, ivec2 cell, out Nearest nearest) {
    ivec2 texel = ivec2(tile.atlas_x, tile.atlas_y) + cell;
    uint feature = feature_at(texel);
    nearest = nothing_near;
    bool settled = false;
    bool inside = filled_at(texel);
    if (feature != no_feature) {
        EdgeData edge = list_edge(tile.nearest, feature);
        settled = distance_to_segment(vec2(cell) + 0.5, edge.a, edge.b) > tile.settled;
        consider_run(p, edge, nearest);
    }
    if (!settled) {
        inside = inside_by_crossings(p, tile.crossing);
    }
    nearest = find_nearest(p, tile.nearest, nearest);
    float margin = max(tile.margin, relative_margin * nearest.distance);
    uint unique = has_rival(p, tile.nearest, nearest, margin) ? 0u : point_unique;
    return (inside ? point_inside : 0u) | unique | nearest.edge;
}
