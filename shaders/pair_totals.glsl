// What the host reads of a search for pairs before their rows. Include after pairs.h.

layout(std430, set = 0, binding = 3) buffer PairCounts {
    uint pair_counts[];  // by stage, how many were counted; then undecided_rows, reverse_pairs
};

// So far there is none. Before the dispatch that writes rows.
void clear_undecided() {
    if (dispatched_index() == 0u) {
        pair_counts[undecided_rows] = 0u;
    }
}
