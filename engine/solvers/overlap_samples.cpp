#include <engine/base/interruption.hpp>
#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/queries/overlap_boundary.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/intersection_samples.hpp>
#include <engine/solvers/overlap_samples.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>

namespace nearfield::solvers {
namespace {

using queries::CheckedQuery;
using queries::Tile;
using queries::TileBoundary;

/// The tiles from `first` on that lie side by side in one region.
std::span<const Tile> band_of(std::span<const Tile> tiles, std::size_t first) {
    std::size_t end = first + 1;
    while (end < tiles.size() && tiles[end].region == tiles[first].region &&
           tiles[end].row == tiles[first].row) {
        ++end;
    }
    return tiles.subspan(first, end - first);
}

}  // namespace

void OverlapSolver::answer(const CheckedQuery& query, Workspace& workspace,
                           IntersectionResult& result) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    const queries::QueryLimits& limits = workspace.limits;
    if (!overlaps_.cover(query, limits, result)) {
        return;
    }
    const queries::Regions& regions = overlaps_.regions();
    workspace.memory_of(query, asked.tolerance)
        .require(overlaps_.bytes_of_samples(asked, limits.largest_tile), 2.0);
    regions.require_sides(query.index, asked.tolerance);
    tiles_.clear();
    regions.for_tiles(limits.largest_tile, 0, [&](const Tile& tile) { tiles_.push_back(tile); });
    find_samples(query, workspace.simplified, result);
    result.area = static_cast<double>(result.count) * result.cell * result.cell;
    result.intersects = intersect(query, workspace.instances, overlap_test_);
}

void OverlapSolver::find_samples(const CheckedQuery& query, queries::SimplifiedShapes& shapes,
                                 IntersectionResult& result) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    const bool with_runs = !asked.summary_only && asked.kind != IntersectionKind::volume_volume;
    const std::span<const Tile> tiles = tiles_;
    for (std::size_t first = 0; first < tiles.size();) {
        const std::span<const Tile> band = band_of(tiles, first);
        first += band.size();
        samples_.clear();
        row_counts_.clear();
        for (const Tile& tile : band) {
            checkpoint();
            find_common(query, tile, with_runs, shapes);
            add_summary(tile, summarize(), result);
            if (!asked.summary_only) {
                append_samples(query, tile, band.size() == 1 ? result.samples : samples_);
            }
        }
        if (!asked.summary_only && band.size() > 1) {
            append_band(band, result);
        }
    }
}

void OverlapSolver::find_common(const CheckedQuery& query, const Tile& tile, bool with_runs,
                                queries::SimplifiedShapes& shapes) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    const double cell = tile.grid.cell;
    const double slack = query.budget.simplification / cell;
    const double offset = query.budget.offset / cell;
    const auto boundary_of = [&](const geometry::Polygon& polygon, const Pose& pose) {
        return queries::overlap_boundary(polygon, pose, query.budget, tile, shapes);
    };
    b_.reset(tile.width, tile.height, geometry::cpu_grid);
    if (asked.kind == IntersectionKind::boundary_boundary) {
        for_offset_polygons(boundary_of(*query.b, query.pose_b), tile, offset, b_,
                            [this](const queries::EdgeRun&, std::size_t i, std::uint64_t bits) {
                                b_.words()[i] |= bits;
                            });
    } else {
        fill(boundary_of(*query.b, query.pose_b), tile, slack, b_);
    }

    a_.reset(tile.width, tile.height, geometry::cpu_grid);
    const TileBoundary a = boundary_of(*query.a, query.pose_a);
    if (asked.kind == IntersectionKind::volume_volume) {
        fill(a, tile, slack, a_);
        a_.keep_common(b_);
        return;
    }
    if (with_runs) {
        runs_.resize(std::max(runs_.size(), 64 * a_.words().size()));
    }
    // If the polygons of several edges of A cover a sample, the first counts, as it is drawn first.
    for_offset_polygons(
        a, tile, offset, a_, [&](const queries::EdgeRun& run, std::size_t i, std::uint64_t bits) {
            const std::uint64_t found = bits & b_.words()[i] & ~a_.words()[i];
            a_.words()[i] |= found;
            if (with_runs) {
                for_bits(found, [&](std::uint32_t bit) { runs_[64 * i + bit] = run; });
            }
        });
}

void OverlapSolver::fill(const TileBoundary& boundary, const Tile& tile, double slack,
                         Coverage& coverage) {
    crossing_.clear();
    queries::crossing_edges(boundary, tile.width, tile.height, slack, crossing_);
    const geometry::FillMesh mesh(tile.width, tile.height, geometry::cpu_grid);
    SparseCheckpoint<256> checkpoint;
    for (const queries::TileEdge& edge : crossing_) {
        checkpoint.step();
        for (const auto& [x0, y0, x1, y1] : mesh.pieces(edge.a, edge.b)) {
            coverage.invert_left_of({x0, y0}, {x1, y1});
        }
    }
    coverage.fill();
}

template <class Use>
void OverlapSolver::for_offset_polygons(const TileBoundary& boundary, const Tile& tile,
                                        double offset, const Coverage& coverage, const Use& use) {
    const std::size_t words_per_row = coverage.words_per_row();
    SparseCheckpoint<64> checkpoint;
    boundary.for_offset_edges(tile.width, tile.height, offset, [&](std::uint32_t i) {
        checkpoint.step();
        const std::optional<geometry::OffsetPolygon> polygon =
            geometry::offset_polygon(boundary.start(i), boundary.end(i), offset, tile.width,
                                     tile.height, geometry::cpu_grid);
        if (!polygon) {
            return;
        }
        spans_.clear();
        coverage.append_fan(*polygon, spans_);
        const queries::EdgeRun run{boundary.edge(i).first, boundary.edge(i).count};
        for (const RowSpan& span : spans_) {
            for (std::uint32_t word = span.first / 64; 64 * word < span.end; ++word) {
                use(run, span.row * words_per_row + word, bits_between(span.first, span.end, word));
            }
        }
    });
}

shaders::TileSummary OverlapSolver::summarize() const {
    shaders::TileSummary summary;
    const std::span<const std::uint64_t> words = a_.words();
    for (std::uint32_t row = 0; row < a_.height(); ++row) {
        for (std::size_t i = 0; i < a_.words_per_row(); ++i) {
            const std::uint64_t word = words[row * a_.words_per_row() + i];
            if (word == 0) {
                continue;
            }
            const auto base = static_cast<std::uint32_t>(64 * i);
            const auto low = static_cast<std::uint32_t>(std::countr_zero(word));
            const auto high = 63 - static_cast<std::uint32_t>(std::countl_zero(word));
            summary.count += static_cast<std::uint32_t>(std::popcount(word));
            summary.low_column = std::min(summary.low_column, base + low);
            summary.high_column = std::max(summary.high_column, base + high);
            summary.low_row = std::min(summary.low_row, row);
            summary.high_row = row;
        }
    }
    return summary;
}

void OverlapSolver::append_samples(const CheckedQuery& query, const Tile& tile,
                                   std::vector<IntersectionSample>& samples) {
    const std::span<const std::uint64_t> words = a_.words();
    const bool with_runs =
        std::get<IntersectionQuery>(*query.query).kind != IntersectionKind::volume_volume;
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        const std::size_t before = samples.size();
        for (std::size_t i = 0; i < a_.words_per_row(); ++i) {
            const std::size_t place = row * a_.words_per_row() + i;
            for_bits(words[place], [&](std::uint32_t bit) {
                samples.push_back(
                    make_sample(query, tile, static_cast<std::uint32_t>(64 * i) + bit, row,
                                with_runs ? runs_[64 * place + bit] : queries::EdgeRun{}));
            });
        }
        row_counts_.push_back(static_cast<std::uint32_t>(samples.size() - before));
    }
}

void OverlapSolver::append_band(std::span<const Tile> band, IntersectionResult& result) {
    const std::size_t rows = band.front().height;
    // The start of each tile's samples.
    tile_starts_.assign(1, 0);
    for (std::size_t tile = 0; tile < band.size(); ++tile) {
        const auto counts = std::span(row_counts_).subspan(tile * rows, rows);
        tile_starts_.push_back(std::accumulate(counts.begin(), counts.end(), tile_starts_.back()));
    }
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t tile = 0; tile < band.size(); ++tile) {
            const std::size_t count = row_counts_[tile * rows + row];
            const auto from = samples_.begin() + static_cast<std::ptrdiff_t>(tile_starts_[tile]);
            result.samples.insert(result.samples.end(), from,
                                  from + static_cast<std::ptrdiff_t>(count));
            tile_starts_[tile] += count;
        }
    }
}

}  // namespace nearfield::solvers
