// Overlap tiles of the compute technique (plan::OverlapData). Include after masks.glsl.

struct Overlap {
    uint mask_a;
    uint mask_b;
    uint first_run;
    uint tile;
    uint list;
};

const uint no_runs = 0xffffffffu;

Overlap overlap_at(uint word) {
    return Overlap(work[word], work[word + 1u], work[word + 2u], work[word + 3u], work[word + 4u]);
}
