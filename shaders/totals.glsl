// How much there is to do in the next stage. Include after search.glsl.

layout(std430, set = 0, binding = 3) buffer Arguments {
    uvec4 arguments[];  // by stage: workgroups in three dimensions, number that was counted
};

// Of the steps that look at points.
uint threads_for(uint points) {
    return (points + points_per_thread - 1u) / points_per_thread;
}

// Before anything is counted: some searches do without these stages.
void begin_totals() {
    for (uint stage = 0u; stage < stages; ++stage) {
        scratch[stage] = scratch[first_counted + stage] = 0u;
    }
    scratch[finished_groups] = 0u;
}

// Says how many elements a stage has counted, and how many of them there is room for.
void write_total(uint stage, uint total, uint capacity) {
    uint room = min(total, capacity);
    uint threads = stage == point_total ? threads_for(room) : room;
    uint groups = max((threads + search_block - 1u) / search_block, 1u);
    uint rows = (groups + max_workgroups - 1u) / max_workgroups;
    scratch[stage] = room;
    scratch[first_counted + stage] = total;
    // As few too many as there can be: each of those writes a sum, too (ScratchLayout::sums).
    arguments[stage] = uvec4((groups + rows - 1u) / rows, rows, 1u, total);
}
