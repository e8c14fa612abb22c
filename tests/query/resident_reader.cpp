#include <tests/query/resident_reader.hpp>

#include <bit>
#include <cstring>

namespace nearfield::test {
namespace {

FeatureContents taken_apart(std::uint32_t id) {
    FeatureContents contents;
    contents.feature.kind =
        (id & resident_feature::vertex) != 0 ? Feature::Kind::vertex : Feature::Kind::edge;
    contents.feature.index = id & resident_feature::index_mask;
    contents.unique = (id & resident_feature::unique) != 0;
    contents.inside = (id & resident_feature::inside) != 0;
    return contents;
}

RecordContents taken_apart(const RecordData& record, const Vector2& origin) {
    RecordContents contents;
    static_cast<FeatureContents&>(contents) = taken_apart(record.feature);
    const auto in_world = [&](const float(&place)[2]) {
        return Vector2{origin.x + static_cast<double>(place[0]),
                       origin.y + static_cast<double>(place[1])};
    };
    contents.own_point = {record.point[0], record.point[1]};
    contents.point = in_world(record.point);
    contents.nearest = in_world(record.nearest);
    contents.normal = {record.normal[0], record.normal[1]};
    contents.distance = record.distance;
    contents.on = (record.flags & resident_flags::on_b) != 0 ? Side::b : Side::a;
    contents.touching = (record.flags & resident_flags::touching) != 0;
    contents.place = record.place;
    return contents;
}

}  // namespace

FieldContents ResidentReader::read(const ResidentField& field) {
    FieldContents contents;
    const VkExtent2D extent{field.width, field.height};
    for (const std::uint32_t word : gpu_.read(field.signed_distance, extent, field.state)) {
        contents.values.push_back(std::bit_cast<float>(word));
    }
    for (const std::uint32_t word : gpu_.read(field.feature, extent, field.state)) {
        contents.features.push_back(taken_apart(word));
    }
    return contents;
}

RecordsContents ResidentReader::read(const ResidentRecords& records) {
    const std::vector<std::uint32_t> words =
        gpu_.read(records.buffer, records.offset, records.size, records.state);
    RecordsContents contents;
    std::memcpy(static_cast<void*>(&contents.summary), words.data(), sizeof(SummaryData));
    for (std::uint32_t i = 0; i < contents.summary.count && i < records.capacity; ++i) {
        RecordData record;
        std::memcpy(
            static_cast<void*>(&record),
            words.data() + (sizeof(SummaryData) + i * sizeof(RecordData)) / sizeof(words[0]),
            sizeof(RecordData));
        contents.records.push_back(taken_apart(record, records.origin));
    }
    return contents;
}

}  // namespace nearfield::test
