#include <engine/base/catch_to_status.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/outline/snap_rounding.hpp>
#include <engine/outline/winding_sweep.hpp>
#include <nearfield/fill.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace nearfield {
namespace {

using outline::BoundaryEdge;
using outline::Cell;
using outline::PlanarEdge;
using outline::SnappedEdge;
using outline::SnapRounding;

/// Half the diagonal of a cell of side 1, rounded up: how far a point moves.
constexpr double half_diagonal = 0.7072;

/// The grid that rings are rounded to.
struct Grid {
    double side;      ///< of a cell, a power of two
    double thinnest;  ///< rings in a strip of this width are dropped
    double deviation() const { return half_diagonal * side + 0.5 * thinnest; }
};

/// The least power of two that is no less than a value; greater than 0, and no denormal number.
double power_of_two_from(double value) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    return std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
}

/// The longer side of the bounding box.
double extent_of(std::span<const Ring> rings) {
    geometry::Box box;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            box.extend(geometry::to_vector(vertex));
        }
    }
    return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

Grid choose_grid(std::span<const Ring> rings, double deviation) {
    const double extent = extent_of(rings);
    if (extent < smallest_extent) {
        geometry::refuse_shape("the rings span " + geometry::number(extent) +
                               " along their longer side; the least is " +
                               geometry::number(smallest_extent));
    }
    const double magnitude = geometry::largest_coordinate_of(rings);
    Grid grid{power_of_two_from(std::max(0x1p-42 * extent, 0x1p-48 * magnitude)),
              geometry::smallest_width(magnitude)};
    if (deviation == 0.0) {
        return grid;
    }
    if (!(deviation > 0.0 && deviation <= largest_coordinate)) {
        geometry::refuse_shape("the deviation is " + geometry::number(deviation) +
                               "; it must be 0 or a number above 0 and at most " +
                               geometry::number(largest_coordinate));
    }
    if (deviation < grid.deviation()) {
        geometry::refuse_shape("the deviation " + geometry::number(deviation) +
                               " is below that of the finest grid, " +
                               geometry::number(grid.deviation()));
    }
    while (half_diagonal * 2.0 * grid.side + 0.5 * grid.thinnest <= deviation) {
        grid.side *= 2.0;
    }
    return grid;
}

/// Rings in units of the grid. Numbers so small that exact products would underflow become 0.
std::vector<Ring> in_cells(std::span<const Ring> rings, double side) {
    const double per_unit = 1.0 / side;
    const auto scaled = [per_unit](double coordinate) {
        const double cells = coordinate * per_unit;
        return std::abs(cells) < 0x1p-200 ? 0.0 : cells;
    };
    std::vector<Ring> result(rings.begin(), rings.end());
    for (Ring& ring : result) {
        for (Vector2& vertex : ring) {
            vertex = {scaled(vertex.x), scaled(vertex.y)};
        }
    }
    return result;
}

/// An edge for the sweep. Precondition: the ends differ.
PlanarEdge planar(std::uint32_t from, std::uint32_t to) {
    return from < to ? PlanarEdge{from, to, 1} : PlanarEdge{to, from, -1};
}

/// Edges for the odd-even rule: an even number of coinciding ones is none.
std::vector<PlanarEdge> odd_edges(std::span<const SnappedEdge> edges) {
    std::vector<PlanarEdge> planar_edges;
    planar_edges.reserve(edges.size());
    for (const SnappedEdge& edge : edges) {
        planar_edges.push_back({std::min(edge.from, edge.to), std::max(edge.from, edge.to), 1});
    }
    outline::merge_edges(planar_edges);
    std::erase_if(planar_edges, [](const PlanarEdge& edge) { return edge.weight % 2 == 0; });
    for (PlanarEdge& edge : planar_edges) {
        edge.weight = 1;
    }
    return planar_edges;
}

bool is_odd(std::int32_t winding) {
    return winding % 2 != 0;
}

/// Edges of a subdivision in which the winding number of a point is the number of parts that hold
/// it. `parts`: the part of each ring.
std::vector<PlanarEdge> edges_of_parts(SnapRounding& rounding,
                                       std::span<const std::uint32_t> parts) {
    const auto part_of = [parts](const SnappedEdge& edge) { return parts[edge.ring]; };
    std::vector<SnappedEdge>& edges = rounding.edges;
    std::stable_sort(edges.begin(), edges.end(), [&](const auto& first, const auto& second) {
        return part_of(first) < part_of(second);
    });
    std::vector<PlanarEdge> result;
    for (std::size_t first = 0; first < edges.size();) {
        std::size_t end = first;
        while (end < edges.size() && part_of(edges[end]) == part_of(edges[first])) {
            ++end;
        }
        const std::vector<PlanarEdge> of_part =
            odd_edges(std::span(edges).subspan(first, end - first));
        for (const BoundaryEdge& edge : outline::boundary_edges(rounding.cells, of_part, is_odd)) {
            result.push_back(planar(edge.from, edge.to));
        }
        first = end;
    }
    outline::merge_edges(result);
    return result;
}

/// The part of each ring.
std::vector<std::uint32_t> parts_of(std::size_t rings, std::span<const std::uint32_t> sizes) {
    std::vector<std::uint32_t> parts(rings);
    if (sizes.empty()) {
        std::iota(parts.begin(), parts.end(), 0U);
        return parts;
    }
    std::size_t first = 0;
    for (std::size_t part = 0; part < sizes.size(); ++part) {
        const std::size_t size = sizes[part];
        if (size > rings - first) {
            break;
        }
        std::fill_n(parts.begin() + static_cast<std::ptrdiff_t>(first), size,
                    static_cast<std::uint32_t>(part));
        first += size;
    }
    const std::uint64_t total = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    if (total != rings) {
        geometry::refuse_shape("the parts have " + std::to_string(total) +
                               " rings together; there are " + std::to_string(rings));
    }
    return parts;
}

/// The edges with the inside of the region to their left.
std::vector<BoundaryEdge> find_boundary(SnapRounding& rounding, FillRule rule,
                                        std::span<const std::uint32_t> parts) {
    if (rule == FillRule::odd_even) {
        return outline::boundary_edges(rounding.cells, odd_edges(rounding.edges), is_odd);
    }
    if (rule == FillRule::union_of_parts) {
        return outline::boundary_edges(rounding.cells, edges_of_parts(rounding, parts),
                                       [](std::int32_t winding) { return winding > 0; });
    }
    std::vector<PlanarEdge> edges;
    edges.reserve(rounding.edges.size());
    for (const SnappedEdge& edge : rounding.edges) {
        edges.push_back(planar(edge.from, edge.to));
    }
    outline::merge_edges(edges);
    if (rule == FillRule::positive) {
        return outline::boundary_edges(rounding.cells, edges,
                                       [](std::int32_t winding) { return winding > 0; });
    }
    return outline::boundary_edges(rounding.cells, edges,
                                   [](std::int32_t winding) { return winding != 0; });
}

Ring in_units(std::span<const Cell> cells, double side) {
    Ring ring;
    ring.reserve(cells.size());
    for (const Cell& cell : cells) {
        ring.push_back({static_cast<double>(cell.x) * side, static_cast<double>(cell.y) * side});
    }
    return ring;
}

ResolvedFill resolve(std::span<const Ring> rings, FillRule rule, const FillSettings& settings) {
    if (rule > FillRule::union_of_parts) {
        geometry::refuse_shape("the fill rule " + std::to_string(static_cast<int>(rule)) +
                               " does not exist");
    }
    std::vector<std::uint32_t> parts;
    if (rule == FillRule::union_of_parts) {
        parts = parts_of(rings.size(), settings.part_sizes);
    }
    geometry::require_usable(rings);
    const Grid grid = choose_grid(rings, settings.deviation);
    SnapRounding rounding = outline::snap_round(in_cells(rings, grid.side), settings.most);
    const std::vector<BoundaryEdge> boundary = find_boundary(rounding, rule, parts);

    ResolvedFill result;
    result.deviation = half_diagonal * grid.side;
    for (const std::vector<Cell>& cells : outline::join_to_rings(rounding.cells, boundary)) {
        Ring ring = in_units(cells, grid.side);
        if (geometry::strip_width(ring) > grid.thinnest) {
            result.rings.push_back(std::move(ring));
        } else {
            // No point inside is farther from the ring than half the width.
            result.deviation = grid.deviation();
        }
    }
    return result;
}

}  // namespace

Expected<ResolvedFill> resolve_fill(std::span<const Ring> rings, FillRule rule,
                                    const FillSettings& settings) {
    return catch_to_expected([&] { return resolve(rings, rule, settings); });
}

}  // namespace nearfield
