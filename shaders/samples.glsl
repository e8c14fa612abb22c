// The output of an intersection: a summary per tile (plan::TileSummary) and a list of samples.

struct Summary {
    uint count;
    uint low_column;
    uint low_row;
    uint high_column;
    uint high_row;
    uint passed;  // 0: the occlusion query found no sample
};

layout(std430, set = 0, binding = 2) buffer Summaries {
    Summary summaries[];  // one per tile
};

layout(std430, set = 0, binding = 3) buffer Samples {
    uint count;
    uint words[];  // plan::SampleData: three words per sample
} samples;
