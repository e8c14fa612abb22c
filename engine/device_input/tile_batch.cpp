#include <engine/device_input/tile_batch.hpp>

namespace nearfield::device_input {

void TileBatch::clear() {
    tiles.clear();
    tile_index.clear();
    points.clear();
    point_index.clear();
    listed_cells = 0;
    runs.clear();
    field_tiles.clear();
    field_point_index.clear();
    field_point_runs.clear();
    field_words = 0;
    field_read_back.clear();
}

void TileBatch::add_tile(const PlannedTile& tile, std::uint32_t index) {
    tile_index.push_back(index);
    shaders::TileData& data = tiles.emplace_back();
    data.width = tile.width;
    data.height = tile.height;
}

const FieldTile& TileBatch::add_field_tile(const PlannedQuery& query, const PlannedTile& tile) {
    const queries::FieldParts& parts = query.field().parts;
    const std::uint64_t cells = std::uint64_t{tile.width} * tile.height;
    FieldTile& field = field_tiles.emplace_back();
    field.tile = static_cast<std::uint32_t>(tiles.size() - 1);
    field.sign = std::get<DistanceFieldQuery>(*query.query).sign;
    if (parts.values) {
        field.first_value = add_field_words(cells, parts.host_values);
    }
    if (parts.features) {
        field.first_feature = add_field_words(cells, parts.host_features);
    }
    if (parts.gradients) {
        field.first_gradient = add_field_words(2 * cells, true);
    }
    return field;
}

OverlapTile TileBatch::add_overlap_tile(const IntersectionQuery& query, const PlannedTile& tile) {
    const bool volumes = query.kind == IntersectionKind::volume_volume;
    const bool boundaries = query.kind == IntersectionKind::boundary_boundary;
    OverlapTile overlap;
    overlap.tile = static_cast<std::uint32_t>(tiles.size() - 1);
    overlap.part_a = volumes ? Part::volume : Part::boundary;
    overlap.part_b = boundaries ? Part::boundary : Part::volume;
    overlap.lists = !query.summary_only;
    overlap.keeps_hits = query.on_device && query.samples_on_device;
    listed_cells += overlap.lists ? std::uint64_t{tile.width} * tile.height : 0;
    return overlap;
}

void TileBatch::add_field_point(const Plan& plan, std::uint32_t index) {
    const std::uint32_t of = plan.tiles[plan.field_points[index].tile].query;
    if (field_point_runs.empty() || field_point_runs.back().query != of) {
        const PlannedQuery& query = plan.queries[of];
        FieldPointRun& run = field_point_runs.emplace_back();
        run.first = static_cast<std::uint32_t>(field_point_index.size());
        run.query = of;
        run.first_word = static_cast<std::uint32_t>(field_words);
        run.sign = std::get<DistanceFieldQuery>(*query.query).sign;
        run.parts = query.field().parts;
    }
    FieldPointRun& run = field_point_runs.back();
    ++run.count;
    field_point_index.push_back(index);
    static_cast<void>(add_field_words(run.parts.words_per_point, true));
}

std::uint32_t TileBatch::add_field_words(std::uint64_t count, bool for_host) {
    const WordRange added{static_cast<std::uint32_t>(field_words),
                          static_cast<std::uint32_t>(count)};
    field_words += count;
    if (for_host) {
        std::vector<WordRange>& ranges = field_read_back;
        if (!ranges.empty() && ranges.back().first + ranges.back().count == added.first) {
            ranges.back().count += added.count;
        } else {
            ranges.push_back(added);
        }
    }
    return added.first;
}

}  // namespace nearfield::device_input
