// The device's scratch memory, in which bit masks of tiles lie (compute_work.h), and the fill of masks
// in which edges are marked.

#include "compute_work.h"
#include "layout.h"

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

// Fills a word of a row, from the last to the first: a cell is inside if the number of marks at or after
// it is odd (odd-even rule). `beyond`: all ones if the words after have an odd number of marks.
uint fill_word(uint place, inout uint beyond) {
    uint word = scratch[place];
    word ^= word >> 1;
    word ^= word >> 2;
    word ^= word >> 4;
    word ^= word >> 8;
    word ^= word >> 16;
    word ^= beyond;
    scratch[place] = word;
    beyond = (word & 1u) != 0u ? ~0u : 0u;
    return word;
}
