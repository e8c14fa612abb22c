// Overlap tiles of the compute technique. Include after masks.glsl.

// The overlap tile with a number; `overlaps`: first word of all.
OverlapData overlap_at(uint overlaps, uint number) {
    uint word = overlaps + words_of_overlap * number;
    return OverlapData(work[word], work[word + 1u], work[word + 2u], work[word + 3u],
                       work[word + 4u]);
}
