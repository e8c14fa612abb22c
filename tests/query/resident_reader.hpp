#pragma once

#include <nearfield/vulkan.hpp>

#include <tests/support/host_gpu.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test {

/// A texel of the feature image, or the feature of a record, decoded.
struct FeatureContents {
    Feature feature;
    bool unique = false;
    bool inside = false;
};

struct FieldContents {
    std::vector<float> values;              ///< by cell, row by row
    std::vector<FeatureContents> features;  ///< the same; empty if there is no image of them
};

struct RecordContents : FeatureContents {
    Vector2 own_point;  ///< relative to the records' origin
    Vector2 point;      ///< in the world, like the others
    Vector2 nearest;
    Vector2 normal;
    double distance = 0.0;
    Side on = Side::a;
    bool touching = false;
    bool undecided = false;

    [[nodiscard]] double depth() const { return inside ? distance : -distance; }
};

struct RecordsContents {
    SummaryData summary;
    std::vector<RecordContents> records;
};

struct SampleContents {
    Vector2 own_point;  ///< relative to the samples' origin
    Vector2 point;      ///< in the world
    std::uint32_t edge = 0;
    std::uint32_t region = 0;
};

struct SamplesContents {
    IntersectionSummaryData summary;
    std::vector<SampleContents> samples;
};

/// Reads back resident outputs, as a host would.
class ResidentReader {
public:
    explicit ResidentReader(const HostDevice& host) : gpu_(host) {}

    [[nodiscard]] FieldContents read(const FieldOnDevice& field);
    [[nodiscard]] RecordsContents read(const PointsOnDevice& records);
    [[nodiscard]] SamplesContents read(const SamplesOnDevice& samples);
    /// The header of an output in this state of a buffer.
    [[nodiscard]] HeaderData read(const HeaderOnDevice& header, const OutputState& state);

private:
    test_support::HostGpu gpu_;
};

}  // namespace nearfield::test
