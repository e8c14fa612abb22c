// The output of an intersection: a summary per tile and a list of samples (layout.h).

#include "layout.h"

layout(std430, set = 0, binding = 2) buffer Summaries {
    TileSummary summaries[];  // one per tile
};

layout(std430, set = 0, binding = 3) buffer Samples {
    uint count;
    uint words[];  // words_of_sample per sample
} samples;
