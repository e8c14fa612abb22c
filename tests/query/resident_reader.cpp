#include <tests/query/resident_reader.hpp>

#include <bit>
#include <cstring>

namespace nearfield::test {
namespace {

FeatureContents taken_apart(std::uint32_t id) {
    FeatureContents contents;
    contents.feature.kind =
        (id & feature_bits::vertex) != 0 ? Feature::Kind::vertex : Feature::Kind::edge;
    contents.feature.index = id & feature_bits::index_mask;
    contents.unique = (id & feature_bits::unique) != 0;
    contents.inside = (id & feature_bits::inside) != 0;
    return contents;
}

Vector2 in_world(const float (&place)[2], const Vector2& origin) {
    return {origin.x + static_cast<double>(place[0]), origin.y + static_cast<double>(place[1])};
}

/// The structure at a byte offset in the data.
template <class Structure>
Structure structure_at(const std::vector<std::uint32_t>& words, std::size_t byte) {
    Structure structure;
    std::memcpy(static_cast<void*>(&structure), words.data() + byte / sizeof(words[0]),
                sizeof(structure));
    return structure;
}

RecordContents taken_apart(const PointData& record, const Vector2& origin) {
    RecordContents contents;
    static_cast<FeatureContents&>(contents) = taken_apart(record.feature);
    contents.own_point = {record.position[0], record.position[1]};
    contents.point = in_world(record.position, origin);
    contents.nearest = in_world(record.nearest, origin);
    contents.normal = {record.normal[0], record.normal[1]};
    contents.distance = record.distance;
    contents.on = (record.flags & point_flags::on_b) != 0 ? Side::b : Side::a;
    contents.touching = (record.flags & point_flags::touching) != 0;
    contents.undecided = (record.flags & point_flags::undecided) != 0;
    return contents;
}

}  // namespace

FieldContents ResidentReader::read(const FieldOnDevice& field) {
    FieldContents contents;
    const VkExtent2D extent{field.width, field.height};
    for (const std::uint32_t word : gpu_.read(field.signed_distance, extent, field.state)) {
        contents.values.push_back(std::bit_cast<float>(word));
    }
    if (field.feature.image != VK_NULL_HANDLE) {
        for (const std::uint32_t word : gpu_.read(field.feature, extent, field.state)) {
            contents.features.push_back(taken_apart(word));
        }
    }
    return contents;
}

RecordsContents ResidentReader::read(const PointsOnDevice& records) {
    const std::vector<std::uint32_t> words =
        gpu_.read(records.buffer, records.offset, records.size, records.state);
    RecordsContents contents;
    contents.summary = structure_at<SummaryData>(words, 0);
    for (std::uint32_t i = 0; i < contents.summary.count && i < records.capacity; ++i) {
        contents.records.push_back(
            taken_apart(structure_at<PointData>(words, sizeof(SummaryData) + i * sizeof(PointData)),
                        records.origin));
    }
    return contents;
}

HeaderData ResidentReader::read(const HeaderOnDevice& header, const OutputState& state) {
    return structure_at<HeaderData>(
        gpu_.read(header.buffer, header.offset, sizeof(HeaderData), state), 0);
}

SamplesContents ResidentReader::read(const SamplesOnDevice& samples) {
    const std::vector<std::uint32_t> words =
        gpu_.read(samples.buffer, samples.offset, samples.size, samples.state);
    SamplesContents contents;
    contents.summary = structure_at<IntersectionSummaryData>(words, 0);
    for (std::uint32_t i = 0; i < contents.summary.count && i < samples.capacity; ++i) {
        const auto sample = structure_at<IntersectionSampleData>(
            words, sizeof(IntersectionSummaryData) + i * sizeof(IntersectionSampleData));
        contents.samples.push_back({{sample.position[0], sample.position[1]},
                                    in_world(sample.position, samples.origin),
                                    sample.edge,
                                    sample.region});
    }
    return contents;
}

}  // namespace nearfield::test
