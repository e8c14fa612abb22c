// What an intersection hands back: a summary by tile and a list of samples.

struct Summary {
    uint count;
    uint low_column;
    uint low_row;
    uint high_column;
    uint high_row;
    uint passed;  // 0: an occlusion query saw that there is nothing here
};

layout(std430, set = 0, binding = 2) buffer Summaries {
    Summary summaries[];  // by tile
};

layout(std430, set = 0, binding = 3) buffer Samples {
    uint count;
    uint words[];  // plan::SampleData: three words a sample
} samples;
