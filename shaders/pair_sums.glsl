// Where the pairs of each instance are, while they are counted and listed. Include after pairs.glsl.

// The first word of the places of an instance's pairs, as far as they are kept.
uint kept_words(uint a) {
    return 4u * (push.lists + units_of_list * a + 1u);
}

// The first word of the sums of the items of pairs, by block of instances, behind those of pairs.
uint item_sums() {
    uint blocks = (push.instances + search_block - 1u) / search_block;
    return push.block_sums + 4u * ((blocks + 3u) / 4u);
}
