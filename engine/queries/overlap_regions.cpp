#include <engine/geometry/magnitude.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/overlap_regions.hpp>
#include <nearfield/on_device.hpp>

#include <shaders/layout.h>

#include <algorithm>

namespace nearfield::queries {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;

constexpr double bytes_per_tile = bytes_of_tile + sizeof(shaders::TileSummary) + 64.0;

// Host memory per sample: in the result and in the buffers on the way there.
constexpr double bytes_per_sample = sizeof(IntersectionSample) + 48.0;

// Memory per cell with a resident sample: its hit, or its run of edges, and space for the sample.
constexpr double bytes_per_resident_cell = sizeof(std::uint32_t) + sizeof(IntersectionSampleData);

/// Checks that the deviations and the boxes of both shapes are compatible with the tolerance; the
/// result states the error.
bool check_boxes(const CheckedQuery& query, const Box& a, const Box& b, ResultSummary& result) {
    result.status = check_deviations(result.tolerance, query.deviations, query.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a), geometry::largest_magnitude(b)));
    }
    return result.status.ok();
}

}  // namespace

double OverlapRegions::bytes_of_samples(const IntersectionQuery& query, double largest_tile) const {
    const double cells = regions_.cells();
    const bool stay = query.on_device && query.samples_on_device;
    return (!query.summary_only ? bytes_per_sample * cells
                                : bytes_per_tile * regions_.tiles(largest_tile)) +
           (stay ? bytes_per_resident_cell * cells : 0.0);
}

bool OverlapRegions::cover(const CheckedQuery& query, const QueryLimits& limits,
                           IntersectionResult& result) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    const TransformedPolygon a(*query.a, query.pose_a);
    const TransformedPolygon b(*query.b, query.pose_b);
    const Box box_a = a.box();
    const Box box_b = b.box();
    if (!check_boxes(query, box_a, box_b, result)) {
        return false;
    }
    const geometry::OverlapOptions options{limits.hierarchy_height, 0.0, limits.bounding_volume};
    chains_.clear();
    if (asked.kind == IntersectionKind::volume_volume) {
        cover_common_volume(a, b, box_a.intersection(box_b), options, result);
    } else {
        cover_boundary(a, b, box_b, options, result);
    }
    return true;
}

void OverlapRegions::cover_common_volume(const TransformedPolygon& a, const TransformedPolygon& b,
                                         const Box& within, const geometry::OverlapOptions& options,
                                         IntersectionResult& result) {
    count_chains(geometry::chains_in_each_other(a, b, options, chains_, chains_), chains_, result);
    // The boundary of the overlap consists of the parts of either boundary in the other volume: one
    // box covers it all.
    if (!chains_.empty()) {
        for (const geometry::Chain& chain : chains_) {
            chains_.front().box.extend(chain.box);
        }
        chains_.resize(1);
    }
    regions_.cover(chains_, 0.0, within, result);
}

void OverlapRegions::cover_boundary(const TransformedPolygon& a, const TransformedPolygon& b,
                                    const Box& within, geometry::OverlapOptions options,
                                    IntersectionResult& result) {
    const double bound = result.error_bound;
    const bool is_in_volume = result.kind == IntersectionKind::boundary_volume;
    options.grow = is_in_volume ? bound : 2.0 * bound;
    count_chains(is_in_volume ? geometry::chains_in_volume(a, b, options, chains_)
                              : geometry::chains_near_boundary(a, b, options, chains_),
                 chains_, result);
    regions_.cover(chains_, bound, geometry::grown(within, bound), result);
}

}  // namespace nearfield::queries
