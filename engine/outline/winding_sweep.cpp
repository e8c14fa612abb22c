#include <engine/outline/winding_sweep.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace nearfield::outline {
namespace {

/// A line sweeps over the subdivision from cell to cell, as if slightly inclined, so that of cells
/// with the same x the lower one comes first and no edge is vertical.
class Sweep {
public:
    Sweep(std::span<const Cell> cells, std::span<const PlanarEdge> edges)
        : cells_(cells),
          edges_(edges),
          active_(IsBelow{this}),
          places_(edges.size()),
          right_(edges.size()) {}

    std::vector<std::int32_t> run() {
        const std::vector<std::uint32_t> by_end = edges_by_end();
        std::size_t ended = 0;
        std::size_t begun = 0;
        while (ended < by_end.size()) {
            const std::uint32_t end = edges_[by_end[ended]].high;
            const bool is_end = begun == edges_.size() || end <= edges_[begun].low;
            const std::uint32_t cell = is_end ? end : edges_[begun].low;
            auto above = active_.end();
            if (is_end) {
                above = end_edges(by_end, cell, ended);
            } else {
                above = active_.lower_bound(cells_[cell]);
            }
            begin_edges(cell, above, begun);
        }
        return std::move(right_);
    }

private:
    /// The order of edges along the sweep line, from the bottom to the top.
    struct IsBelow {
        using is_transparent = void;
        const Sweep* sweep;

        bool operator()(std::uint32_t first, std::uint32_t second) const {
            const PlanarEdge& one = sweep->edges_[first];
            const PlanarEdge& other = sweep->edges_[second];
            if (one.low == other.low) {
                return sweep->side_of(one, other.high) > 0;
            }
            return one.low < other.low ? sweep->side_of(one, other.low) > 0
                                       : sweep->side_of(other, one.low) < 0;
        }
        bool operator()(std::uint32_t edge, const Cell& cell) const {
            const PlanarEdge& one = sweep->edges_[edge];
            return orientation(sweep->cells_[one.low], sweep->cells_[one.high], cell) > 0;
        }
    };
    using Active = std::set<std::uint32_t, IsBelow>;

    [[nodiscard]] int side_of(const PlanarEdge& edge, std::uint32_t cell) const {
        return orientation(cells_[edge.low], cells_[edge.high], cells_[cell]);
    }

    [[nodiscard]] std::vector<std::uint32_t> edges_by_end() const {
        std::vector<std::uint32_t> order(edges_.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [this](std::uint32_t first, std::uint32_t second) {
            return edges_[first].high < edges_[second].high;
        });
        return order;
    }

    /// Removes the edges that end at a cell: neighbours on the sweep line. Returns the edge above.
    Active::iterator end_edges(std::span<const std::uint32_t> by_end, std::uint32_t cell,
                               std::size_t& ended) {
        auto above = active_.end();
        for (; ended < by_end.size() && edges_[by_end[ended]].high == cell; ++ended) {
            const auto next = active_.erase(places_[by_end[ended]]);
            // The next one ends here too, except that of the highest.
            if (next == active_.end() || edges_[*next].high != cell) {
                above = next;
            }
        }
        return above;
    }

    /// Inserts the edges that begin at a cell, from the lowest to the highest.
    void begin_edges(std::uint32_t cell, Active::iterator above, std::size_t& begun) {
        const std::size_t first = begun;
        while (begun < edges_.size() && edges_[begun].low == cell) {
            ++begun;
        }
        if (first == begun) {
            return;
        }
        std::vector<std::uint32_t>& beginning = beginning_;
        beginning.clear();
        for (std::size_t i = first; i < begun; ++i) {
            beginning.push_back(static_cast<std::uint32_t>(i));
        }
        std::sort(beginning.begin(), beginning.end(), IsBelow{this});
        std::int32_t winding = 0;
        if (above != active_.begin()) {
            const std::uint32_t below = *std::prev(above);
            winding = right_[below] + edges_[below].weight;
        }
        for (const std::uint32_t edge : beginning) {
            places_[edge] = active_.insert(above, edge);
            right_[edge] = winding;
            winding += edges_[edge].weight;
        }
    }

    std::span<const Cell> cells_;
    std::span<const PlanarEdge> edges_;
    Active active_;
    std::vector<Active::iterator> places_;
    std::vector<std::int32_t> right_;
    std::vector<std::uint32_t> beginning_;
};

/// One end of a boundary edge at a cell where several meet.
struct EdgeEnd {
    Cell direction;      // from the cell to the other end
    std::uint32_t edge;  // index into the boundary
    bool leaves;         // the edge begins here
};

/// True for the half of the directions from 0 (included) to 180 degrees.
bool is_upper(const Cell& direction) {
    return direction.y > 0 || (direction.y == 0 && direction.x > 0);
}

/// True if the first direction has the smaller angle, from 0 up to 360 degrees.
bool has_smaller_angle(const EdgeEnd& first, const EdgeEnd& second) {
    if (is_upper(first.direction) != is_upper(second.direction)) {
        return is_upper(first.direction);
    }
    return orientation({}, first.direction, second.direction) > 0;
}

/// Finds the edge that follows each boundary edge, and where rings touch.
class Successors {
public:
    Successors(std::span<const Cell> cells, std::span<const BoundaryEdge> boundary)
        : cells_(cells),
          boundary_(boundary),
          next_(boundary.size()),
          begins_at_touch_(boundary.size()) {
        find();
    }

    [[nodiscard]] std::uint32_t next(std::uint32_t edge) const { return next_[edge]; }
    /// True if other edges than the one before meet the edge where it begins.
    [[nodiscard]] bool begins_at_touch(std::uint32_t edge) const { return begins_at_touch_[edge]; }

private:
    void find() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> at_cells;  // cell and edge
        at_cells.reserve(2 * boundary_.size());
        for (std::uint32_t i = 0; i < boundary_.size(); ++i) {
            at_cells.emplace_back(boundary_[i].from, i);
            at_cells.emplace_back(boundary_[i].to, i);
        }
        std::sort(at_cells.begin(), at_cells.end());
        for (std::size_t first = 0; first < at_cells.size();) {
            std::size_t end = first;
            ends_.clear();
            for (; end < at_cells.size() && at_cells[end].first == at_cells[first].first; ++end) {
                add_end(at_cells[end].first, at_cells[end].second);
            }
            join_ends();
            first = end;
        }
    }

    void add_end(std::uint32_t cell, std::uint32_t edge) {
        const bool leaves = boundary_[edge].from == cell;
        const Cell& here = cells_[cell];
        const Cell& there = cells_[leaves ? boundary_[edge].to : boundary_[edge].from];
        ends_.push_back({{there.x - here.x, there.y - here.y}, edge, leaves});
    }

    /// The inside lies clockwise of an edge that arrives, seen from its end, and reaches to one
    /// that leaves. So around a cell, edges that leave and edges that arrive alternate.
    void join_ends() {
        if (ends_.size() > 2) {
            std::sort(ends_.begin(), ends_.end(), has_smaller_angle);
        }
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            if (ends_[i].leaves) {
                begins_at_touch_[ends_[i].edge] = ends_.size() > 2;
            } else {
                next_[ends_[i].edge] = ends_[i == 0 ? ends_.size() - 1 : i - 1].edge;
            }
        }
    }

    std::span<const Cell> cells_;
    std::span<const BoundaryEdge> boundary_;
    std::vector<std::uint32_t> next_;
    std::vector<bool> begins_at_touch_;
    std::vector<EdgeEnd> ends_;
};

/// A ring as the boundary edges that begin at its vertices, without those on straight lines. Where
/// rings touch, vertices stay, so that edges meet at ends only.
std::vector<Cell> straightened(std::span<const Cell> cells, std::span<const BoundaryEdge> boundary,
                               const Successors& successors, std::span<const std::uint32_t> edges) {
    std::vector<Cell> ring;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const BoundaryEdge& before = boundary[edges[i == 0 ? edges.size() - 1 : i - 1]];
        const BoundaryEdge& after = boundary[edges[i]];
        // All vertices on a straight line vanish together, so neighbours decide.
        if (successors.begins_at_touch(edges[i]) ||
            orientation(cells[before.from], cells[after.from], cells[after.to]) != 0) {
            ring.push_back(cells[after.from]);
        }
    }
    return ring;
}

}  // namespace

void merge_edges(std::vector<PlanarEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const PlanarEdge& first, const PlanarEdge& second) {
        return std::pair(first.low, first.high) < std::pair(second.low, second.high);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size();) {
        PlanarEdge merged = edges[i++];
        for (; i < edges.size() && edges[i].coincides(merged); ++i) {
            merged.weight += edges[i].weight;
        }
        if (merged.weight != 0) {
            edges[kept++] = merged;
        }
    }
    edges.resize(kept);
}

std::vector<std::int32_t> windings_to_the_right(std::span<const Cell> cells,
                                                std::span<const PlanarEdge> edges) {
    return Sweep(cells, edges).run();
}

std::vector<std::vector<Cell>> join_to_rings(std::span<const Cell> cells,
                                             std::span<const BoundaryEdge> boundary) {
    const Successors successors(cells, boundary);
    std::vector<bool> done(boundary.size());
    std::vector<std::vector<Cell>> rings;
    std::vector<std::uint32_t> edges;
    for (std::uint32_t first = 0; first < boundary.size(); ++first) {
        edges.clear();
        for (std::uint32_t edge = first; !done[edge]; edge = successors.next(edge)) {
            done[edge] = true;
            edges.push_back(edge);
        }
        if (!edges.empty()) {
            rings.push_back(straightened(cells, boundary, successors, edges));
        }
    }
    return rings;
}

}  // namespace nearfield::outline
