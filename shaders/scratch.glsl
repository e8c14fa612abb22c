// The scratch memory of the searches. Include after shapes.glsl.

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};
layout(set = 0, binding = 9) uniform usamplerBuffer scratch_texels;  // and again
// And again: what workgroups of one dispatch tell each other.
layout(std430, set = 0, binding = 1) coherent buffer SharedScratch {
    uint shared_scratch[];
};

// The parts of the scratch memory that earlier dispatches have written.
uvec4 scratch_unit(uint unit) {
    return reads_texels ? texelFetch(scratch_texels, int(unit)) : scratch_units[unit];
}

uint scratch_word(uint word) {
    return reads_texels ? texelFetch(scratch_texels, int(word >> 2))[word & 3u] : scratch[word];
}
